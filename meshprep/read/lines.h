// The lines of a text file and the words and numbers in them, for the scans of the mesh formats.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace malus::prep {

// The lines of a text, one after the other, without their ends (LF or CR LF) and outer blanks. A line that
// holds a control character, as binary files and UTF-16 do, is an error.
class Lines {
 public:
  Lines(std::string& text, std::string_view where, std::size_t begin = 0, std::size_t number = 1)
      : text_(text), where_(where), end_(begin), nextNumber_(number) {}

  bool next();  // to the next line; false at the end
  // To the next line that is not empty and does not start with `comment`; blanks comments.
  bool nextStatement(char comment);
  // Where the line ends in a backslash, adds the next one to it, and so on; backslash and line end become blanks, so
  // that words do not grow together.
  void joinContinued();

  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }          // of the line, or the first one of those joined, from 1
  std::size_t nextNumber() const { return nextNumber_; }  // of the line after it
  std::size_t endOffset() const { return end_; }          // of the byte after the line and its end

  // Replaces the line, or what follows the first `keep` characters of it, by blanks.
  void blank(std::size_t keep = 0);
  // Replaces a word of the line by the number 0.
  void zero(std::string_view word);

  [[noreturn]] void fail(std::string_view problem, std::string_view expected = {}, std::string_view found = {}) const;

 private:
  std::string_view takeRaw();  // to the end of the line; moves end_ past it

  std::string& text_;
  std::string_view where_;
  std::string_view raw_;  // with outer blanks
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t end_ = 0;
  std::size_t nextNumber_ = 1;
};

// Takes the next word off the front of `rest`; empty at the end.
std::string_view takeWord(std::string_view& rest);

// A coordinate: a finite decimal number that a float holds. Anything else is an error at the line.
double coordinate(std::string_view word, const Lines& at);

// A whole number in decimal. Anything else is an error at the line that says what was expected.
long long wholeNumber(std::string_view word, std::string_view what, const Lines& at);

// What follows a keyword, without outer blanks, as a name in UTF-8. Bytes that are no UTF-8 are taken for Latin-1, as
// old exporters write it. Longer than kMaxNameBytes is an error at the line.
constexpr std::size_t kMaxNameBytes = 255;
constexpr std::size_t kMaxPathBytes = 4096;  // of a mtllib statement
std::string nameOf(std::string_view rest, const Lines& at, std::size_t maxBytes = kMaxNameBytes);

// A word for messages: shortened, never empty.
std::string quoted(std::string_view word);

}  // namespace malus::prep

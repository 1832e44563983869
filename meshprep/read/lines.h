// Lines of a text file, and the words and numbers in them, for the scans of the mesh formats.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace malus::prep {

// Iterates over the lines of a text, without line ends (LF, CR LF or CR) and outer blanks (spaces and tabs). Replaces a
// CR by LF. A control character, as in binary files and UTF-16, is an error. `where` is the path for messages; text and
// where must outlive this object.
class Lines {
 public:
  Lines(std::string& text, std::string_view where, std::size_t begin = 0, std::size_t number = 1)
      : text_(text), where_(where), end_(begin), nextNumber_(number) {}

  // Advances to the next line. Returns false at the end.
  bool next();
  // Advances to the next line that is not empty and does not start with `comment`. Replaces comments by blanks.
  bool nextStatement(char comment);
  // Appends the next line while the line ends in a backslash. Replaces backslash and line end by blanks, so that words
  // stay separate. With `comment`, removes the comment of each line, as cutComment() does.
  void joinContinued(char comment = 0);
  // Replaces the text from the first `comment` of the line on by blanks. A backslash there does not continue the line.
  void cutComment(char comment);
  // The same, but the comment must be between blanks, because a name may contain the character.
  void cutSeparateComment(char comment);

  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }          // of the line, or of the first joined one, from 1
  std::size_t nextNumber() const { return nextNumber_; }  // of the following line
  std::size_t endOffset() const { return end_; }          // of the first byte after the line end
  bool hasCutComments() const { return hasCutComments_; }
  bool hasCrLineEnds() const { return hasCrLineEnds_; }  // of lines so far: CR without LF
  bool hasCrLfLineEnds() const { return hasCrLfLineEnds_; }

  // Replaces the line after its first `keep` characters by blanks.
  void blank(std::size_t keep = 0);
  // Replaces a word of the line by the number 0, or by blanks.
  void zero(std::string_view word);
  void blankWord(std::string_view word);

  // Throws Error at "WHERE:LINE".
  [[noreturn]] void fail(std::string_view problem, std::string_view expected = {}, std::string_view found = {}) const;

 private:
  std::string_view takeRaw();  // up to the line end; advances end_
  void cutFrom(std::size_t begin);

  std::string& text_;
  std::string_view where_;
  std::string_view raw_;  // including outer blanks
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t end_ = 0;
  std::size_t nextNumber_ = 1;
  bool hasCutComments_ = false, hasCrLineEnds_ = false, hasCrLfLineEnds_ = false, hasLfLineEnds_ = false;
};

// Returns the length of a name, or of a list of names, without a comment: up to the first '#' between blanks, or
// between a blank and the end.
std::size_t lengthWithoutComment(std::string_view names, char comment = '#');

// Removes zero bytes, blanks, line ends and DOS end-of-file characters from the end of a text. Returns true if there
// were zero bytes or DOS end-of-file characters.
bool removePadding(std::string& text);

// Returns true if all bytes are zero, blanks, line ends or DOS end-of-file characters.
bool isPadding(std::string_view bytes);

// Removes the next word from the front of `rest` and returns it; empty at the end.
std::string_view takeWord(std::string_view& rest);

// Parses a finite decimal number within the range of float. Throws Error at the line.
double coordinate(std::string_view word, const Lines& at);

// Parses a decimal integer. Throws Error at the line, with `expected`.
long long wholeNumber(std::string_view word, std::string_view expected, const Lines& at);

// Returns the text after a keyword, without outer blanks, in UTF-8. Invalid UTF-8 is read as Latin-1, which old
// exporters write. Throws Error at the line if the text is longer than maxBytes.
constexpr std::size_t kMaxNameBytes = 255;
constexpr std::size_t kMaxPathBytes = 4096;  // of a mtllib statement
std::string parseName(std::string_view rest, const Lines& at, std::size_t maxBytes = kMaxNameBytes);

// Returns the word in quotes for messages, at most 40 characters of it; "nothing" if it is empty.
std::string quoted(std::string_view word);

}  // namespace malus::prep

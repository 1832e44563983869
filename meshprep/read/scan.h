// A strict look at a mesh file before OpenMesh sees it: every number finite, every index in range, every
// count backed by bytes. What OpenMesh is known to misread without a word (continuation lines, UTF-16,
// triangle strips, odd list types) is an error here that names the place.
//
// Each scan returns what the file says. It also blanks, in place, what OpenMesh has no need for and what
// could confuse it (materials, texture coordinates, names, colours of OFF faces): what is left is geometry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// `where` is the path for messages. All throw Error that names where:line or a byte.
Polygons scanObj(std::string& bytes, std::string_view where);
Polygons scanPly(std::string& bytes, std::string_view where);
Polygons scanOff(std::string& bytes, std::string_view where);

// STL: three positions a face, nothing shared. Binary is told by its size, 84 + 50 n bytes.
Polygons scanStl(std::string& bytes, std::string_view where, bool& isBinary);

// The lines of a text, one after the other, without their ends (LF or CR LF) and outer blanks. A line that
// holds a control character, as binary files and UTF-16 do, is an error.
class Lines {
 public:
  Lines(std::string& text, std::string_view where, std::size_t begin = 0) : text_(text), where_(where), end_(begin) {}

  bool next();  // to the next line; false at the end
  // To the next line that is not empty and does not start with `comment`; blanks comments.
  bool nextStatement(char comment);
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  // of the line, from 1
  std::size_t endOffset() const { return end_; }  // of the byte after the line and its end

  // Replaces the line, or what follows the first `keep` characters of it, by spaces.
  void blank(std::size_t keep = 0);

  [[noreturn]] void fail(std::string_view problem, std::string_view expected = {}, std::string_view found = {}) const;

 private:
  std::string& text_;
  std::string_view where_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t end_ = 0;
};

// Takes the next word off the front of `rest`; empty at the end.
std::string_view takeWord(std::string_view& rest);

// A coordinate: a finite decimal number that a float holds. Anything else is an error at the line.
double coordinate(std::string_view word, const Lines& at);

// A whole number in decimal. Anything else is an error at the line that says what was expected.
long long wholeNumber(std::string_view word, std::string_view what, const Lines& at);

// A word for messages: shortened, never empty.
std::string quoted(std::string_view word);

}  // namespace malus::prep

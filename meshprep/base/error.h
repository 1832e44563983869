// The exception for invalid inputs, options and outputs. Commands print its text, one line, and exit with code 1.
// Violated invariants of the program are assertions, not errors.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace malus {

class Error : public std::runtime_error {
 public:
  // what() is "LOCATION: PROBLEM; expected EXPECTED, found FOUND"; an empty argument is left out with its separator
  // ("LOCATION: PROBLEM; found FOUND"). Control characters are escaped, so the text is always one line.
  //
  // location: "FILE", "FILE:LINE", "FILE, byte N", a key of a document, or the option ("--depth").
  // problem: clause without a full stop ("is not a regular file", "unknown key 'colour'").
  // expected: valid values, or the option or key that fixes the problem. found: the offending value.
  Error(std::string_view location, std::string_view problem, std::string_view expected = {},
        std::string_view found = {});
};

}  // namespace malus

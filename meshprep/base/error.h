// The one exception of malus: an input or an output that is not what it should be. Its text is one line
// for a person: where (a file, with line or byte), what is wrong, what was expected, what was found.
// Commands print it and end with exit code 1. Broken invariants are assertions, not errors.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace malus {

class Error : public std::runtime_error {
 public:
  // where: path, "path:line" or "path, byte N". problem: what is wrong. expected, found: may be empty.
  Error(std::string_view where, std::string_view problem, std::string_view expected = {}, std::string_view found = {});
};

}  // namespace malus

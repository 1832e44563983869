#include "meshprep/base/error.h"

#include <fmt/format.h>

namespace malus {

namespace {
std::string line(std::string_view where, std::string_view problem, std::string_view expected, std::string_view found) {
  std::string text = where.empty() ? std::string(problem) : fmt::format("{}: {}", where, problem);
  if (!expected.empty()) text += fmt::format("; expected {}", expected);
  if (!found.empty()) text += fmt::format(", found {}", found);
  // One line, whatever a file name or a parser's message holds.
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}
}  // namespace

Error::Error(std::string_view where, std::string_view problem, std::string_view expected, std::string_view found)
    : std::runtime_error(line(where, problem, expected, found)) {}

}  // namespace malus

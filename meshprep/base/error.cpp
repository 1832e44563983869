#include "meshprep/base/error.h"

#include <fmt/format.h>

#include "meshprep/base/text.h"

namespace malus {

namespace {
std::string compose(std::string_view location, std::string_view problem, std::string_view expected,
                    std::string_view found) {
  std::string text = location.empty() ? std::string(problem) : fmt::format("{}: {}", location, problem);
  if (!expected.empty()) text += fmt::format("; expected {}", expected);
  if (!found.empty()) text += fmt::format("{} found {}", expected.empty() ? ';' : ',', found);
  return printable(text);  // file names and messages of libraries may contain newlines and escape sequences
}
}  // namespace

Error::Error(std::string_view location, std::string_view problem, std::string_view expected, std::string_view found)
    : std::runtime_error(compose(location, problem, expected, found)) {}

}  // namespace malus

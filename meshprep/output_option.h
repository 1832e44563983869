// Options that name an output.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace malus {

// Refuses an empty name, which is what a script with an unset variable passes: commands take it for an option that was
// not given, so that the output would be missing without a word.
inline CLI::Validator outputName() {
  return {[](std::string& name) { return name.empty() ? "expected the name of an output, found ''" : std::string(); },
          ""};
}

}  // namespace malus

// Fuzzes the command line: parses the lines of the input as arguments, without running the command. A message about a
// wrong command line is one line of printable text.
#include <cstdlib>
#include <string>
#include <vector>

#include "meshprep/base/text.h"
#include "tests/fuzz/target.h"
#include "tools/command_line.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments(1);
  for (std::size_t i = 0; i < size && arguments.size() < 50; ++i) {
    if (data[i] == '\n')
      arguments.emplace_back();
    else if (data[i] != 0)  // which no argument contains
      arguments.back().push_back(static_cast<char>(data[i]));
  }
  malus::CommandLine line;
  try {
    line.parse(arguments);
  } catch (const CLI::Success&) {  // --help, --version
  } catch (const CLI::ParseError& error) {
    const std::string message = line.describe(error);
    if (message.empty() || malus::printable(message) != message) std::abort();
  }
  return 0;
}

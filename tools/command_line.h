// The command line of `malus`: its commands and options, and the messages about wrong ones.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace malus {

class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // Parses the arguments without the name of the program, and runs the command or prints the lists. Returns false if
  // there was nothing to do. Throws CLI::ParseError, and everything that the command throws.
  bool run(std::vector<std::string> arguments);

  // Parses the arguments; the command does not run. Throws CLI::ParseError.
  void parse(std::vector<std::string> arguments);

  // One line about a parse error: an unknown command or option with the nearest one first, because a misspelt option is
  // also missing.
  std::string describe(const CLI::ParseError& error) const;

  CLI::App& app() { return app_; }

 private:
  std::string describeUnknown() const;

  CLI::App app_;
  bool listsMethods_ = false, listsEffects_ = false, listsMaterials_ = false, listsDevices_ = false;
};

}  // namespace malus

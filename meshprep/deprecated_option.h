// Former names of command-line options. They stay accepted and print a note with -v, unless their meaning differs
// between commands. They are not shown in the help.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace malus {

// Adds `former` as another name of option `name`, which must exist and take one value. Both exclude each other.
void addFormerOption(CLI::App& app, const std::string& former, const std::string& name);

// The same for a flag.
void addFormerFlag(CLI::App& app, const std::string& former, const std::string& name);

// Refuses `former`, with or without a value, by an error that names `name`: for a former name that another command uses
// with another meaning.
void addRemovedOption(CLI::App& app, const std::string& former, const std::string& name);

}  // namespace malus

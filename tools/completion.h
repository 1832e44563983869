// Completion of the command line for shells, generated from the definition of the command line.
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace malus {

// Returns a script for bash that completes the subcommands of an application, their options, and the values of options
// that have a fixed set. Hidden subcommands and options are left out. File names complete everything else.
std::string bashCompletion(const CLI::App& app);

// Adds the hidden command `completion bash`, which prints the script. The application must outlive its parsing.
void addCompletionCommand(CLI::App& app);

}  // namespace malus

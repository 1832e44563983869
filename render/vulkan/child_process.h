// This program as a child process whose output is kept.
#pragma once

#include <string>
#include <vector>

namespace malus::vulkan {

struct ChildResult {
  bool succeeded = false;
  std::string status;  // "exit code 1" or "signal 6"
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs this program with these arguments (the first is its name) and environment ("NAME=value"), without standard
// input, and waits for its end. option: for messages. Throws Error: the process cannot be started.
ChildResult runThisProgram(const std::string& option, std::vector<std::string> arguments,
                           std::vector<std::string> environment);

}  // namespace malus::vulkan

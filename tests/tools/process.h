// Starts a program, waits for it and returns its output and its exit status.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace malus::test {

struct Finished {
  int exitCode = -1;  // -1: ended by a signal
  int signal = 0;
  std::string out, err;
  double seconds = 0;
};

struct Start {
  std::vector<std::pair<std::string, std::string>> environment{};  // added to the environment of this process
  std::filesystem::path standardOutput{};                          // a file in place of Finished::out
  std::filesystem::path workingFolder{};                           // empty: that of this process
  // Called with all of stderr so far whenever it grows; sendSignal is sent once, when it first returns true.
  std::function<bool(std::string_view)> sendSignalWhen{};
  int sendSignal = 0;
  double timeoutSeconds = 60;  // after which the program is killed
};

// command[0] is a path or a name to be found on PATH. Throws std::runtime_error if the program cannot be started.
Finished run(const std::vector<std::string>& command, const Start& start = {});

}  // namespace malus::test

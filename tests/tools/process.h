// Starts a program and waits for it: what it prints and how it ends.
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
  std::vector<std::pair<std::string, std::string>> environment{};  // set on top of this process's own
  std::filesystem::path standardOutput{};                          // a file instead of Finished::out
  std::filesystem::path workingFolder{};                           // empty: this process's own
  // Called with everything that stderr has said so far, whenever it says more: true sends sendSignal, once.
  std::function<bool(std::string_view)> sendSignalWhen{};
  int sendSignal = 0;
  double timeoutSeconds = 60;  // then it is killed
};

// command[0] is a path, or a name to be found on PATH. Throws std::runtime_error where it cannot be started.
Finished run(const std::vector<std::string>& command, const Start& start = {});

}  // namespace malus::test

// Ends the program in time although a thread is inside of a library, for example while a driver compiles shaders.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace malus::viewer {

// From construction to destruction: after kLongestMs, the process ends at once with the exit code.
class ExitLimit {
 public:
  // The rest of a second is for the frame that is drawn when the key is pressed, and for the end of the process.
  static constexpr int kLongestMs = 400;

  explicit ExitLimit(int exitCode);
  ~ExitLimit();
  ExitLimit(const ExitLimit&) = delete;
  ExitLimit& operator=(const ExitLimit&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool isEnded_ = false;
  std::thread thread_;
};

}  // namespace malus::viewer

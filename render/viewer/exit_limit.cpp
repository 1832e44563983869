#include "render/viewer/exit_limit.h"

#include <chrono>
#include <cstdlib>

namespace malus::viewer {

ExitLimit::ExitLimit(int exitCode)
    : thread_([this, exitCode] {
        std::unique_lock lock(mutex_);
        if (!ended_.wait_for(lock, std::chrono::milliseconds(kLongestMs), [this] { return isEnded_; }))
          std::_Exit(exitCode);
      }) {}

ExitLimit::~ExitLimit() {
  {
    const std::scoped_lock lock(mutex_);
    isEnded_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

}  // namespace malus::viewer

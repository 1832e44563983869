#include "meshprep/base/console.h"

#include <unistd.h>

#include <cstdio>
#include <mutex>

#include <fmt/format.h>

namespace malus::console {

namespace {
Verbosity gVerbosity = Verbosity::normal;
bool gProgressShown = false;
std::mutex gMutex;

bool onTerminal() {
  static const bool kTerminal = ::isatty(STDERR_FILENO) == 1;
  return kTerminal;
}
void eraseProgress() {
  if (gProgressShown) fmt::print(stderr, "\r\033[K");
  gProgressShown = false;
}
}  // namespace

void setVerbosity(Verbosity verbosity) { gVerbosity = verbosity; }

void progress(std::string_view text) {
  const std::lock_guard lock(gMutex);
  if (gVerbosity == Verbosity::verbose) {
    fmt::print(stderr, "{}\n", text);
  } else if (gVerbosity == Verbosity::normal && onTerminal()) {
    eraseProgress();
    fmt::print(stderr, "{}", text);
    std::fflush(stderr);
    gProgressShown = true;
  }
}

void progressDone() {
  const std::lock_guard lock(gMutex);
  eraseProgress();
}

void note(std::string_view text) {
  if (gVerbosity != Verbosity::verbose) return;
  const std::lock_guard lock(gMutex);
  eraseProgress();
  fmt::print(stderr, "{}\n", text);
}

void warn(std::string_view text) {
  if (gVerbosity == Verbosity::quiet) return;
  const std::lock_guard lock(gMutex);
  eraseProgress();
  fmt::print(stderr, "malus: warning: {}\n", text);
}

}  // namespace malus::console

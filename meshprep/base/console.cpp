#include "meshprep/base/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <string>

#include "meshprep/base/text.h"

namespace malus::console {

namespace {

using Clock = std::chrono::steady_clock;

// Lines of a step that lasts are this far apart. Less than the 30 s that are promised, for machines under load.
constexpr std::chrono::seconds kPeriod{20};

Verbosity gVerbosity = Verbosity::normal;
bool gProgressShown = false;
std::mutex gMutex;  // guards everything below
std::string gStep;
Clock::time_point gStepSince;
bool gIsPeriodic = false;
std::condition_variable gPeriodicEnds;

bool onTerminal() {
  static const bool kTerminal = ::isatty(STDERR_FILENO) == 1;
  return kTerminal;
}

// Columns of the terminal, which may change at any time.
std::size_t columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void eraseProgress() {
  if (gProgressShown) fmt::print(stderr, "\r\033[K");
  gProgressShown = false;
}

void printMessage(std::string_view prefix, std::string_view text) {
  const std::lock_guard lock(gMutex);
  eraseProgress();
  const std::string line = fmt::format("{}{}\n", prefix, printable(text));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void printStep() {
  fmt::print(stderr, "malus: {} ({} s)\n", printable(gStep),
             std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - gStepSince).count());
  std::fflush(stderr);
}

}  // namespace

void setVerbosity(Verbosity verbosity) { gVerbosity = verbosity; }

// A failed write is reported at the end of the program, by the state of stdout.
void printText(std::string_view text) {
  const std::lock_guard lock(gMutex);
  eraseProgress();
  const std::string shown = printable(text, true);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
}

void printOneLine(std::string_view text) { printText(printable(text) + "\n"); }

void progress(std::string_view text) {
  const std::lock_guard lock(gMutex);
  if (gVerbosity == Verbosity::verbose) {
    fmt::print(stderr, "{}\n", printable(text));
  } else if (gVerbosity == Verbosity::normal && onTerminal()) {
    eraseProgress();
    // The last column stays free: some terminals wrap when it is written, and then a line would remain.
    fmt::print(stderr, "{}", shortened(printable(text), columns() - 1));
    std::fflush(stderr);
    gProgressShown = true;
  }
  gStep = text;
  gStepSince = Clock::now();
}

void progressDone() {
  const std::lock_guard lock(gMutex);
  eraseProgress();
}

void note(std::string_view text) {
  if (gVerbosity == Verbosity::verbose) printMessage("", text);
}

void inform(std::string_view text) {
  if (gVerbosity != Verbosity::quiet) printMessage("malus: ", text);
}

void warn(std::string_view text) {
  if (gVerbosity != Verbosity::quiet) printMessage("malus: warning: ", text);
}

void error(std::string_view text) { printMessage("malus: ", text); }

PeriodicProgress::PeriodicProgress() {
  if (gVerbosity != Verbosity::normal || onTerminal()) return;
  {
    const std::lock_guard lock(gMutex);
    gIsPeriodic = true;
  }
  // Signals are for the thread that works.
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([] {
    std::unique_lock lock(gMutex);
    while (!gPeriodicEnds.wait_for(lock, kPeriod, [] { return !gIsPeriodic; }))
      if (!gStep.empty()) printStep();
  });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

PeriodicProgress::~PeriodicProgress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(gMutex);
    gIsPeriodic = false;
  }
  gPeriodicEnds.notify_all();
  thread_.join();
}

}  // namespace malus::console

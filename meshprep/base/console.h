// Output of the commands. Results go to stdout; messages beside them go to stderr, so that stdout can be piped.
// Thread-safe, except setVerbosity. Every text passes printable() (meshprep/base/text.h): names from files cannot
// control the terminal. Texts have no trailing newline unless stated.
#pragma once

#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace malus::console {

// quiet: -q, errors only. normal: warnings, and progress on a terminal. verbose: -v, everything, one line each.
enum class Verbosity { quiet, normal, verbose };

// Sets the verbosity of all later messages. Call it before any thread prints.
void setVerbosity(Verbosity verbosity);

// Prints text of several lines to stdout; newlines are kept, so names in it must be printable already.
void printText(std::string_view text);
// Prints one line to stdout; newlines in the arguments are escaped.
void printOneLine(std::string_view text);

template <class... T>
void printLine(fmt::format_string<T...> format, T&&... arguments) {
  printOneLine(fmt::format(format, std::forward<T>(arguments)...));
}

// Reports the current step. Normal: one line that the next message replaces, shortened to the width of the terminal,
// and only if stderr is a terminal. Verbose: a line per call.
void progress(std::string_view text);
// Erases the progress line.
void progressDone();
// Prints a detail. Verbose only.
void note(std::string_view text);
// Prints "malus: TEXT" to stderr: a fact that the user did not ask for. Not printed if quiet.
void inform(std::string_view text);
// Prints "malus: warning: TEXT". Not printed if quiet.
void warn(std::string_view text);
// Prints "malus: TEXT", always.
void error(std::string_view text);

// Prints the current step to stderr at least every 30 seconds while it exists, unless stderr is a terminal or the
// verbosity is not normal: for long commands in a pipe or a batch job. At most one may exist at a time.
class PeriodicProgress {
 public:
  PeriodicProgress();
  ~PeriodicProgress();
  PeriodicProgress(const PeriodicProgress&) = delete;
  PeriodicProgress& operator=(const PeriodicProgress&) = delete;

 private:
  std::thread thread_;
};

}  // namespace malus::console

// Messages of the commands beside their results. All of them go to stderr, so that stdout can be piped.
// Thread-safe, except setVerbosity. Texts have no trailing newline.
#pragma once

#include <string_view>

namespace malus::console {

// quiet: -q, errors only. normal: warnings, and progress on a terminal. verbose: -v, everything, one line each.
enum class Verbosity { quiet, normal, verbose };

// Sets the verbosity of all later messages. Call it before any thread prints.
void setVerbosity(Verbosity verbosity);

// Reports the current step. Normal: one line that the next message replaces, and only if stderr is a terminal.
// Verbose: a line per call.
void progress(std::string_view text);
// Erases the progress line.
void progressDone();
// Prints a detail. Verbose only.
void note(std::string_view text);
// Prints "malus: warning: TEXT". Not printed if quiet.
void warn(std::string_view text);

}  // namespace malus::console

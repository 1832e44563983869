// What commands tell a person beside their results: on stderr, never in the way of a pipe.
#pragma once

#include <string_view>

namespace malus::console {

enum class Verbosity { quiet, normal, verbose };
void setVerbosity(Verbosity verbosity);

// What is being done: one line that is replaced on a terminal; with -v a line of its own; silent in a pipe.
void progress(std::string_view text);
// Ends the progress line.
void progressDone();
// Details, with -v only.
void note(std::string_view text);
// Something the person should know; not with -q.
void warn(std::string_view text);

}  // namespace malus::console

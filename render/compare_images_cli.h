// malus compare-images A B [--channels R G B] [--threshold T] [--fail-over VALUE] [--difference OUT [--gain G]]
// [--json]
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Thrown by compare-images if the images differ by more than --fail-over: exit code 3.
struct ImagesDiffer {};

// Adds the subcommand `compare-images`. Its callback throws malus::Error: an image that cannot be read, sizes that
// differ, a channel that is missing.
void addCompareImagesCommand(CLI::App& app);

}  // namespace malus::render

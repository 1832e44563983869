// `malus merge`.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Joins the folders of the shards of a batch.
void addMergeCommand(CLI::App& app);

}  // namespace malus::render

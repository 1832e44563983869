// The command line of a polarizer that is turned:
//   malus sweep PACK -o FOLDER [--frames 36] [--backend B] [--method M] [--width W] [--exposure EV] [--json] ...
//
// Renders one Stokes picture and writes frame-000.png, frame-001.png, ...: what a camera sees behind a linear
// polarizer at i * 180 / frames degrees from the picture's x, counter-clockwise, all at one exposure (8-bit sRGB,
// render/image/output.h). sweep.json is written last, so that it lists whole frames only:
//   {"scene", "renderer", "method", "device", "width", "height", "depth", "samples", "exposureEv",
//    "frames": [{"file", "degrees"}, ...]}
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `sweep`. Its callback throws malus::Error (a folder that cannot be written, a pack that
// cannot be read); a usage error, such as a method without Stokes vectors, is CLI11's.
void addSweepCommand(CLI::App& app);

}  // namespace malus::render

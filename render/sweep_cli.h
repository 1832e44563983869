// malus sweep PACK -o FOLDER [--frames 36] [--backend B] [--method M] [--width W] [--exposure EV] [--json] ...
//
// Renders one image with Stokes vectors and writes frame-000.png, frame-001.png, ...: the image behind a linear
// polarizer at i * 180 / frames degrees from the image's x axis, counter-clockwise, all at one exposure (8-bit sRGB,
// render/image/output.h). sweep.json is written last, so that it lists complete frames only:
//   {"scene", "renderer", "method", "substitutedFor", "device", "width", "height", "depth", "samples", "exposureEv",
//    "frames": [{"file", "degrees"}, ...]}
// substitutedFor: the method that was asked for and the reason for a cheaper, exact one; else null.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `sweep`. Its callback throws malus::Error (a folder that cannot be written, a pack that cannot be
// read); a usage error, such as a method without Stokes vectors, is CLI11's.
void addSweepCommand(CLI::App& app);

}  // namespace malus::render

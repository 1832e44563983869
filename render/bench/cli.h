// malus bench rays PACK [--methods M,...] [--width N] [--height N] [--depth N] [--backends B,...] [--device D]
//                       [--threads N] [--rounds N] [--json] [--write-rays FILE]
//
// --json prints what toJson (rays.h) describes. --write-rays writes the rays of the first method: the line
// "malus-rays 1", then for each class the line "BOUNCE SHADOW COUNT" (SHADOW: 1 or 0) and 6 arrays of COUNT floats in
// the byte order of the machine: the origins' x, y, z and the directions' x, y, z. A shadow ray ends at the direction
// times 1; the others do not end.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `bench`. Its callback throws malus::Error for packs that cannot be read, rays that do not fit
// into half of the memory, and Vulkan without a device.
void addBenchCommand(CLI::App& app);

}  // namespace malus::render

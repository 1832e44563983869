// malus devices [--json]
//
// --json prints a list of objects: number, name, driver, problem (null: usable), type, rayTracingCores, vulkan,
// isDefault, values (features, limits and memoryHeapSize by the names of the Vulkan specification).
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `devices`. Its callback throws malus::Error if there is no Vulkan driver or no device.
void addDevicesCommand(CLI::App& app);

// Prints a line per Vulkan device. Throws Error if there is none.
void listDevices();

}  // namespace malus::render

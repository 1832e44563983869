// Order in which a comparison measures renderers.
#pragma once

#include <string>
#include <vector>

#include "render/backend.h"

namespace malus::render {

// Whether a renderer is Vulkan on a CPU, which compiles a row for minutes. False if there is no such device: its rows
// report it.
bool isOnCpu(Backend backend, const std::string& device);

// Renderers with those for which isOnCpu() is true last, because they may use up the time. device: as in --device.
std::vector<Backend> fastestToStartFirst(std::vector<Backend> backends, const std::string& device);

}  // namespace malus::render

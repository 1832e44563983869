// The renderers that a user can choose from, in one table.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/render_parameters.h"

namespace malus::render {

enum class Backend : std::uint8_t { vulkan, embree, reference };

struct BackendInfo {
  Backend backend;
  const char* name;  // on the command line, in JSON and in image metadata
  // Renders by any method of render/scene/methods.h. False for the reference, which traces full Stokes vectors in
  // double precision and ignores the method.
  bool hasMethods;
};

// In the order of the enumeration.
inline constexpr std::array<BackendInfo, 3> kBackends = {
    {{Backend::vulkan, "vulkan", true}, {Backend::embree, "embree", true}, {Backend::reference, "reference", false}}};

constexpr const BackendInfo& backendInfo(Backend backend) { return kBackends[static_cast<std::size_t>(backend)]; }

// Throws Error for an unknown name.
Backend backendNamed(std::string_view name);

std::vector<std::string> backendNames();
// Names of the backends that render by methods and can be compared with the reference.
std::vector<std::string> methodBackendNames();

// The name that results carry for `method` rendered by `backend`: "reference" if the backend has no methods.
std::string methodName(Backend backend, std::string_view method);

// Whether an image has Stokes channels. Throws Error for an unknown method.
bool hasStokes(Backend backend, std::string_view method, const RenderParameters& parameters);

}  // namespace malus::render

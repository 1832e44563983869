// Measurement of the light that paths of a scene carry beyond its depth, and of emitters that are seen from behind. The
// renderer that measures is handed in by the program (tools/malus.cpp), because baking does not depend on renderers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/scene.h"

namespace malus::bake {

// A light that a closed body of glass keeps from a surface.
struct BlockedLight {
  std::string kind;        // "light", "emitter" or "environment"
  std::size_t number = 0;  // index of the light, or of the emitter among pack::placements()
  std::uint32_t body = 0;  // index of the glass there
  auto operator<=>(const BlockedLight&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 is wrong here
};

struct DepthProbe {
  // Share of the image's light that arrives after more than i specular interactions, for i from 0 on until it is 0, at
  // most pack::kMaxDepth + 1 values. Empty: the image is black.
  std::vector<double> beyond;
  std::vector<double> pixelRadiance;        // mean of the colours, per pixel of the small image
  std::vector<std::uint32_t> darkEmitters;  // materials: one-sided emitters of which a path meets the back
  std::set<BlockedLight> blockedLights;
  std::uint64_t rays = 0;
  std::uint64_t unfollowed = 0;  // paths that were left because a pixel had used its rays
  double milliseconds = 0;
};
using MeasureDepth = std::function<DepthProbe(const pack::Scene&)>;

// The share beyond a depth by a list as DepthProbe::beyond.
double shareBeyond(const std::vector<double>& beyond, std::size_t depth);

// Share of the light above which the depth of an image is reported.
inline constexpr double kLostLight = 1e-3;

// Returns a sentence about the light beyond a depth, or nothing if it is at most kLostLight or was not measured.
// option: the key or the option that sets the depth.
std::string lostLightNote(const std::vector<double>& beyond, std::uint32_t depth, std::string_view option);

// Stores the measurement in the scene. Returns sentences for the user.
std::vector<std::string> applyProbe(const DepthProbe& probe, pack::Scene& scene);

}  // namespace malus::bake

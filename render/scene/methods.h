// The rendering methods and their traits, from shaders/methods.def.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/render_parameters.h"
#include "render/scene/vulkan_path.h"

namespace malus::render {

// Polarization that a method carries from surface to surface: none, S1 and S2, or S1, S2 and S3.
enum class CarriedPolarization { none, linear, full };

// approximate: a simplified model. exact: the intensity is exact where the components that are not carried are 0.
// packed: as exact, rounded to 16 bits.
enum class Accuracy { approximate, packed, exact };

struct MethodInfo {
  std::string name;
  std::size_t payloadBytes;  // per ray of a recursive method: its result; 0 for an iterative one
  bool hasStokes;            // images can have Stokes channels; those of an iterative method on request (--stokes)
  bool isIterative;          // a loop along the camera path; else recursive
  std::size_t pathBytes;     // per path of an iterative method: origin, direction, depth and throughput; else 0
  CarriedPolarization polarization;
  Accuracy accuracy;
  std::string withoutLinear;    // cheaper method if no linear polarization is needed; may be itself
  std::string withoutCircular;  // the same for circular polarization
  std::string alias;            // earlier name that is still accepted; may be empty

  bool carriesLinear() const { return polarization != CarriedPolarization::none; }
  bool carriesCircular() const { return polarization == CarriedPolarization::full; }
  // Exact and with the whole Stokes vector: the reference of the other methods.
  bool isComplete() const { return accuracy == Accuracy::exact && carriesCircular(); }
};

// Whether an image of the method has Stokes channels.
bool hasStokes(const MethodInfo& method, const RenderParameters& parameters);

// Payload of a ray by a path of the Vulkan renderer, or by another renderer (automatic): the method's, or a hit record.
std::size_t payloadBytes(const MethodInfo& method, VulkanPath path);

const std::vector<MethodInfo>& methods();
const MethodInfo& methodNamed(std::string_view name);  // name or alias; throws Error for any other name
std::vector<std::string> methodNames();
std::vector<std::string> methodAliases();

const MethodInfo& baselineMethod();           // baseline of the times of `malus compare`: the first
const MethodInfo& completeRecursiveMethod();  // the first recursive method that is complete: stokes
const MethodInfo& completeIterativeMethod();  // the first iterative one: importance

}  // namespace malus::render

// Unphysical values in an image, found by --check-numerics.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bake/pack/scene.h"
#include "shaders/gpu/fault.h"

namespace malus::render {

struct Faults {
  std::uint64_t count = 0;          // unphysical values
  std::optional<gpu::Fault> first;  // the first to occur in the first pixel, row by row

  // Adds a fault; those of one pixel must be added in the order of their occurrence. width: of the whole image.
  void note(const gpu::Fault& fault, std::uint32_t width);
  void add(const Faults& others, std::uint32_t width);  // adds those of other pixels
};

// One line: pixel, bounce, material, the kind of fault and the inputs of the surface.
std::string describe(const Faults& faults, const pack::Scene& scene);

}  // namespace malus::render

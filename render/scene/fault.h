// What --check-numerics found in a picture: values that no light can have.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bake/pack/scene.h"
#include "shaders/gpu/fault.h"

namespace malus::render {

struct Faults {
  std::uint64_t count = 0;          // values at fault
  std::optional<gpu::Fault> first;  // of the first pixel in reading order; there, the first that arose

  // Takes a fault in; those of one pixel in the order in which they arose. width: of the whole picture.
  void note(const gpu::Fault& fault, std::uint32_t width);
  void add(const Faults& others, std::uint32_t width);  // of other pixels
};

// One line: pixel, bounce, material, what is wrong, and what the surface was given.
std::string describe(const Faults& faults, const pack::Scene& scene);

}  // namespace malus::render

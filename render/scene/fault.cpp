#include "render/scene/fault.h"

#include <fmt/format.h>

namespace malus::render {

namespace {

std::uint64_t pixelIndex(const gpu::Fault& fault, std::uint32_t width) {
  return std::uint64_t{fault.y} * width + fault.x;
}

std::string text(const glm::vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

}  // namespace

void Faults::note(const gpu::Fault& fault, std::uint32_t width) {
  ++count;
  if (!first || pixelIndex(fault, width) < pixelIndex(*first, width)) first = fault;
}

void Faults::add(const Faults& others, std::uint32_t width) {
  count += others.count;
  if (others.first && (!first || pixelIndex(*others.first, width) < pixelIndex(*first, width))) first = others.first;
}

std::string describe(const Faults& faults, const pack::Scene& scene) {
  if (!faults.first) return "all values are finite and physical";
  const gpu::Fault& f = *faults.first;
  constexpr const char* kProblems[] = {"is physical", "is not finite", "is negative", "is more than fully polarized"};
  constexpr const char* kColours[] = {"red", "green", "blue"};
  std::string where = "the environment", optics;
  if (f.material < scene.materials.size()) {
    const pack::Material& m = scene.materials[f.material];
    const int colour = static_cast<int>(f.colour);
    where = fmt::format("material '{}' ({})", m.name, pack::materialKindName(m.kind));
    optics = fmt::format(", cosine {:.9g}, index {:.9g} - i {:.9g} against {:.9g}, normal {}, at {}", f.cosine,
                         m.eta[colour], m.k[colour], m.outsideEta, text(f.normal), text(f.position));
  }
  return fmt::format(
      "pixel ({}, {}), bounce {}, {}: {} light {}: Stokes vector ({:.9g}, {:.9g}, {:.9g}, {:.9g}), rounding explains "
      "{:.3g}; ray direction {}{}; unphysical values in the image: {}",
      f.x, f.y, f.bounce, where, kColours[f.colour % 3], kProblems[f.kind % 4], f.stokes.x, f.stokes.y, f.stokes.z,
      f.stokes.w, f.slack, text(f.direction), optics, faults.count);
}

}  // namespace malus::render

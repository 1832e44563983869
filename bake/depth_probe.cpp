#include "bake/depth_probe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "bake/pack/instances.h"

namespace malus::bake {

namespace {

// Keeps four digits, so that the last bits of a sum do not change a pack.
double rounded(double share) {
  if (!(share > 0)) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(share)) - 3);
  return std::min(std::round(share / unit) * unit, 1.0);
}

std::string blockedNote(const BlockedLight& blocked, const pack::Scene& scene) {
  const std::vector<pack::Placement> placements = pack::placements(scene);
  std::string light = fmt::format("the {}", blocked.kind);
  if (blocked.kind == "light") light = fmt::format("light {}", blocked.number);
  if (blocked.kind == "emitter") light = fmt::format("emitter '{}'", placements[blocked.number].name());
  return fmt::format(
      "{}: the glass body '{}' blocks {}: closed bodies of glass cast the shadow of an opaque body; a surface of "
      "'thin-glass' lets light pass",
      scene.name, placements[blocked.body].name(), light);
}

}  // namespace

double shareBeyond(const std::vector<double>& beyond, std::size_t depth) {
  return depth < beyond.size() ? beyond[depth] : 0;
}

std::string lostLightNote(const std::vector<double>& beyond, std::uint32_t depth, std::string_view option) {
  const double share = shareBeyond(beyond, depth);
  if (share <= kLostLight) return {};
  // The smallest depth that keeps what the largest one keeps, or enough.
  const double least = std::max(shareBeyond(beyond, pack::kMaxDepth), kLostLight);
  std::uint32_t needed = depth;
  while (shareBeyond(beyond, needed) > least) ++needed;
  return fmt::format(
      "{:.3g} % of the light of a small image arrives after more than {} interactions and is lost; {}", 100 * share,
      depth,
      needed > depth ? fmt::format("{} {} keeps all but {:.2g} %", option, needed, 100 * shareBeyond(beyond, needed))
                     : fmt::format("no {} up to {} keeps more", option, pack::kMaxDepth));
}

std::vector<std::string> applyProbe(const DepthProbe& probe, pack::Scene& scene) {
  scene.lightBeyond.clear();
  for (const double share : probe.beyond) scene.lightBeyond.push_back(rounded(share));
  std::vector<std::string> notes;
  if (std::string note = lostLightNote(scene.lightBeyond, scene.depth, "'depth'"); !note.empty())
    notes.push_back(fmt::format("{}: {}", scene.name, note));
  for (const std::uint32_t material : probe.darkEmitters)
    notes.push_back(
        fmt::format("{}: emitter '{}' is seen from behind, where it is black; set 'twoSided', or flip its "
                    "faces if this is its front",
                    scene.name, scene.materials[material].name));
  for (const BlockedLight& blocked : probe.blockedLights) notes.push_back(blockedNote(blocked, scene));
  return notes;
}

}  // namespace malus::bake

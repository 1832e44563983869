#include "bake/effects/query.h"

#include <algorithm>

#include <fmt/format.h>

namespace malus::bake {
using pack::Material;

EffectQuery::EffectQuery(const pack::Scene& queriedScene, const ImageRequest& queriedRequest)
    : scene(queriedScene), request(queriedRequest) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const pack::Mesh& mesh : scene.meshes) used[mesh.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) used_.push_back(&scene.materials[i]);
}

bool EffectQuery::any(const Predicate& predicate) const {
  return std::any_of(used_.begin(), used_.end(), [&](const Material* m) { return predicate(*m); });
}

std::string EffectQuery::names(const Predicate& predicate) const {
  std::vector<std::string_view> names;
  for (const Material* m : used_)
    if (predicate(*m)) names.emplace_back(m->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

const PolarizingPaths& EffectQuery::paths() const {
  if (!paths_) paths_ = findPolarizingPaths(*this);
  return *paths_;
}

bool isPolarizedEmitter(const Material& m) {
  return pack::isEmitter(m.kind) && m.polarization > 0 && isPositive(m.radiance);
}

bool isCoated(const Material& m) { return m.coating.thicknessNm > 0; }

bool hasDenserSide(const pack::Scene& scene, const Material& m) {
  if (pack::hasInside(m.kind)) return m.eta.y != m.outsideEta;
  if (!pack::isDielectric(m.kind)) return false;
  double least = std::min({m.eta.x, m.eta.y, m.eta.z});
  if (m.maps.eta >= 0)
    for (const glm::vec3& texel : scene.textures[static_cast<std::size_t>(m.maps.eta)].texels)
      least = std::min(least, static_cast<double>(texel.y));
  return m.outsideEta > least;
}

}  // namespace malus::bake

#include "bake/effects/polarization_bound.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "bake/effects/diattenuation.h"
#include "bake/effects/interface_patches.h"
#include "bake/effects/mutual_visibility.h"
#include "bake/effects/query.h"

namespace malus::bake {

namespace {

// Larger bounds are cut off.
constexpr double kLargest = 1e6;

// A chain of diattenuating elements: (prod(1 + D) + prod(1 - D))/2 and (prod(1 + D) - prod(1 - D))/2, which both grow
// with every D. The maxima over several chains bound each of them.
struct Chain {
  double even = 0, odd = 0;  // 0: there is none
  Chain with(double d) const { return {even + d * odd, odd + d * even}; }
  void include(const Chain& other) {
    even = std::max(even, other.even);
    odd = std::max(odd, other.odd);
  }
};

// Angles of incidence on the patches: from the camera, and from each other.
struct Angles {
  std::vector<CosineRange> fromCamera;
  std::vector<std::vector<CosineRange>> between;  // [from][to]
};

Angles findAngles(const pack::Scene& scene, const std::vector<InterfacePatch>& patches, bool several) {
  Angles angles;
  const double flat = flatness(scene);
  const std::vector<glm::dvec3> camera =
      scene.camera.isOrthographic() ? std::vector<glm::dvec3>() : std::vector<glm::dvec3>{scene.camera.position};
  for (const InterfacePatch& to : patches) angles.fromCamera.push_back(incidence(camera, to, 0));
  for (const InterfacePatch& from : patches) {
    std::vector<CosineRange>& row = angles.between.emplace_back();
    for (const InterfacePatch& to : patches)
      row.push_back(!several || (&from == &to && to.isFlat) ? CosineRange{1, 0} : incidence(from.hull, to, flat));
  }
  return angles;
}

// Largest degree of polarization of a source.
double largestSource(const pack::Scene& scene, int colour) {
  double result = 0;
  if (scene.environment.size > 0 || scene.environment.radiance[colour] > 0) result = scene.environment.skyDegree;
  for (const pack::Mesh& mesh : scene.meshes) {
    const pack::Material& m = scene.materials[mesh.material];
    if (pack::isEmitter(m.kind) && m.radiance[colour] > 0) result = std::max(result, m.polarization);
  }
  return result;
}

// The chains that end at each patch, from the camera on.
class Chains {
 public:
  Chains(const std::vector<InterfacePatch>& patches, const Angles& angles,
         const std::map<std::uint32_t, Diattenuation>& materials, double filter)
      : first_{1, filter} {
    const std::size_t count = patches.size();
    for (std::size_t j = 0; j < count; ++j) {
      const Diattenuation& d = materials.at(patches[j].material);
      start_.push_back({d.interaction.over(angles.fromCamera[j]), d.leaving.over(angles.fromCamera[j]), true});
      for (std::size_t i = 0; i < count; ++i) {
        const CosineRange& range = angles.between[i][j];
        steps_.push_back({d.interaction.over(range), d.leaving.over(range), !range.isEmpty()});
      }
    }
  }

  // The largest chain of `depth` interactions, each followed by a source or by diffuse light from below an interface.
  double largest(std::uint32_t depth, double source) const {
    Chain most = first_.with(source);
    for (const Step& step : start_) most.include(first_.with(step.leaving));
    std::vector<Chain> now;
    for (std::uint32_t n = 1; n <= depth && !start_.empty() && most.even < kLargest; ++n) {
      std::vector<Chain> next(start_.size());
      for (std::size_t j = 0; j < start_.size(); ++j) {
        if (n == 1) next[j] = first_.with(start_[j].interaction);
        for (std::size_t i = 0; i < now.size(); ++i) {
          const Step& step = steps_[j * start_.size() + i];
          if (!step.exists) continue;
          next[j].include(now[i].with(step.interaction));
          most.include(now[i].with(step.leaving));
        }
        most.include(next[j].with(source));
      }
      now = std::move(next);
    }
    for (std::size_t k = 0; k < steps_.size() && !now.empty(); ++k)
      if (steps_[k].exists) most.include(now[k % start_.size()].with(steps_[k].leaving));
    return most.even;
  }

 private:
  struct Step {
    double interaction, leaving;
    bool exists;
  };
  Chain first_;              // without an interaction: the filter
  std::vector<Step> start_;  // from the camera
  std::vector<Step> steps_;  // [to * count + from]
};

}  // namespace

glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const ImageRequest& request) {
  const auto& a = request.analyser;
  const double filter = a[0] > 0 ? std::min(1.0, std::sqrt(a[1] * a[1] + a[2] * a[2] + a[3] * a[3]) / a[0]) : 0;
  const bool several = interfacesMutuallyVisible(scene);
  const bool polarizedEntry = EffectQuery(scene, request).lightsPolarized();
  const std::vector<InterfacePatch> patches = interfacePatches(scene);
  const Angles angles = findAngles(scene, patches, several);
  glm::dvec3 bound(0.0);
  for (int colour = 0; colour < 3; ++colour) {
    std::map<std::uint32_t, Diattenuation> materials;
    double leaving = 0;
    for (const InterfacePatch& patch : patches)
      if (!materials.contains(patch.material)) {
        const Diattenuation d = diattenuation(scene.materials[patch.material], colour);
        leaving = std::max(leaving, d.leaving.over({0, 1}));
        materials.emplace(patch.material, d);
      }
    // If interfaces are not mutually visible, a path has one interaction, or diffuse light from below one.
    const std::uint32_t depth = several ? request.depth : std::min(request.depth, 1u);
    bound[colour] = Chains(patches, angles, materials, filter).largest(depth, largestSource(scene, colour)) - 1;
    // Polarized light of lamps into a diffuse layer: its transmittance is between T_s and T_p.
    if (polarizedEntry) bound[colour] = (1 + bound[colour]) * (1 + leaving) - 1;
  }
  return bound;
}

bool isUseful(const glm::dvec3& polarizationErrorBound) {
  return polarizationErrorBound.x <= 1 && polarizationErrorBound.y <= 1 && polarizationErrorBound.z <= 1;
}

}  // namespace malus::bake

#include "render/viewer/probe.h"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

#include "bake/pack/material_kinds.h"
#include "render/image/polarization.h"
#include "render/material/surface_response.h"
#include "render/scene/render_result.h"

namespace malus::viewer {

namespace {

// The values of a pixel of the window; empty: none.
std::vector<float> pixelValues(const ImageRows& image, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                               std::uint32_t height) {
  if (!image.store || image.channels != render::kStokesChannels || width == 0 || height == 0) return {};
  const std::uint64_t column = std::uint64_t{x} * image.width / width, row = std::uint64_t{y} * image.height / height;
  if (column >= image.width || row >= image.rows) return {};
  std::vector<float> copy;
  const std::span<const float> values =
      hostValues(*image.store, image.channels * (row * image.width + column), image.channels, copy);
  return {values.begin(), values.end()};
}

}  // namespace

std::optional<ProbedLight> probeLight(const PublishedSide& side, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                      std::uint32_t height) {
  std::vector<float> values = pixelValues(side.fine, x, y, width, height);
  if (values.empty()) values = pixelValues(side.coarse, x, y, width, height);
  if (values.empty()) return std::nullopt;
  ProbedLight light;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t s = 0; s < 4; ++s) {
      light.stokes[c][s] = static_cast<double>(values[3 + 3 * s + c]);
      light.luminance[s] += render::kLuminanceWeights[c] * light.stokes[c][s];
    }
    light.dolp[c] = render::degreeOfLinearPolarization(light.stokes[c][0], light.stokes[c][1], light.stokes[c][2]);
    light.aolpDegrees[c] = glm::degrees(render::angleOfLinearPolarization(light.stokes[c][1], light.stokes[c][2]));
  }
  return light;
}

Ellipse ellipse(const std::array<double, 4>& stokes) {
  const double linear = std::hypot(stokes[1], stokes[2]), polarized = std::hypot(linear, stokes[3]);
  if (!(stokes[0] > 0) || !(polarized > 0)) return {};
  return {std::atan2(stokes[2], stokes[1]) / 2, std::atan2(stokes[3], linear) / 2,
          std::min(polarized / stokes[0], 1.0)};
}

std::optional<ProbedSurface> probeSurface(const render::PixelTruth& truth, const pack::Scene& scene) {
  if (!truth.isValid || truth.material >= scene.materials.size()) return std::nullopt;
  const pack::Material& material = scene.materials[truth.material];
  ProbedSurface surface{material.name,
                        std::string(pack::materialKindName(material.kind)),
                        truth.interactions,
                        truth.rayDistance,
                        glm::degrees(truth.incidence),
                        std::nullopt};
  if (!pack::hasIndex(material.kind)) return surface;
  surface.diattenuation.emplace();
  for (int c = 0; c < 3; ++c) {
    const bool isMetal = pack::isConductor(material.kind);
    const render::Interface interface { scene.camera.mediumEta, material.eta[c], isMetal ? material.k[c] : 0 };
    surface.diattenuation->at(static_cast<std::size_t>(c)) =
        render::surfaceResponse(interface, std::clamp(surface.incidenceDegrees, 0.0, 90.0),
                                render::Precision::doublePrecision)
            .diattenuation;
  }
  return surface;
}

}  // namespace malus::viewer

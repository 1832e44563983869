#include "meshprep/read/gltf_views.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

struct Axes {
  glm::dvec3 position, forward, up;
};

// Throws Error if the transform has no direction along -z, or none along +y at a right angle to it.
Axes viewAxes(const GltfPlacement& placement, const std::string& location) {
  const glm::dmat4& m = placement.worldFromObject;
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(m[i / 4][i % 4])) throw Error(location, "transform is not finite", "finite numbers");
  const glm::dvec3 back(m[2]), up(m[1]);
  const double length = glm::length(back);
  const glm::dvec3 forward = length > 0 ? -back / length : glm::dvec3(0.0);
  const glm::dvec3 across = up - forward * glm::dot(up, forward);
  if (!(length > 0) || !(glm::length(across) > 1e-9 * glm::length(up)))
    throw Error(location, "transform is singular", "independent axes y and z");
  return {glm::dvec3(m[3]), forward, glm::normalize(across)};
}

void requireAbove(double value, double low, double most, const std::string& location) {
  if (!(value > low) || !(value < most))
    throw Error(location, "is out of range", fmt::format("over {:g}, below {:g}", low, most), fmt::format("{}", value));
}

constexpr double kMaxLength = 1e12;  // metres
constexpr double kMaxRatio = 1e6;
constexpr double kMaxIntensity = 1e30;

template <class Object>
const Object& find(const std::vector<Object>& objects, const char* list, const GltfPlacement& placement,
                   const std::string& where) {
  if (placement.object >= objects.size())
    throw Error(fmt::format("{}: node '{}'", where, placement.name),
                fmt::format("refers to a missing element of {}", list),
                fmt::format("an index below {}", objects.size()), fmt::to_string(placement.object));
  return objects[placement.object];
}

SourceCamera toCamera(const gltf::Camera& source, const GltfPlacement& placement, const std::string& where) {
  const std::string location = fmt::format("{}: cameras[{}]", where, placement.object);
  const Axes axes = viewAxes(placement, fmt::format("{}: node '{}'", where, placement.name));
  SourceCamera camera;
  camera.name = placement.name;
  camera.objectName = source.name;
  camera.position = axes.position;
  camera.forward = axes.forward;
  camera.up = axes.up;
  if (source.type == "orthographic") {
    requireAbove(std::abs(source.xmag), 0, kMaxLength, location + ".orthographic.xmag");
    requireAbove(std::abs(source.ymag), 0, kMaxLength, location + ".orthographic.ymag");
    camera.isOrthographic = true;
    camera.height = 2 * std::abs(source.ymag);
    camera.aspect = std::abs(source.xmag / source.ymag);
  } else if (source.type == "perspective") {
    requireAbove(source.yfov, 0, std::numbers::pi, location + ".perspective.yfov");
    camera.verticalFov = source.yfov;
    camera.aspect = source.aspectRatio;
  } else {
    throw Error(location + ".type", "unknown type of camera", "'perspective' or 'orthographic'",
                fmt::format("'{}'", source.type.substr(0, 40)));
  }
  if (camera.aspect) requireAbove(*camera.aspect, 1 / kMaxRatio, kMaxRatio, location + ": width / height");
  return camera;
}

SourceLight toLight(const gltf::Light& source, const GltfPlacement& placement, const std::string& where) {
  const std::string location = fmt::format("{}: extensions.KHR_lights_punctual.lights[{}]", where, placement.object);
  SourceLight light;
  light.name = placement.name;
  light.position = glm::dvec3(placement.worldFromObject[3]);
  if (source.type == "point") {
    light.kind = SourceLight::Kind::point;
  } else if (source.type == "spot" || source.type == "directional") {
    light.kind = source.type == "spot" ? SourceLight::Kind::spot : SourceLight::Kind::directional;
    light.direction = viewAxes(placement, fmt::format("{}: node '{}'", where, placement.name)).forward;
  } else {
    throw Error(location + ".type", "unknown type of light", "'point', 'spot' or 'directional'",
                fmt::format("'{}'", source.type.substr(0, 40)));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    light.intensity[static_cast<int>(c)] = source.color[c] * source.intensity;
    if (!(light.intensity[static_cast<int>(c)] >= 0 && light.intensity[static_cast<int>(c)] <= kMaxIntensity))
      throw Error(location, "color or intensity is out of range", fmt::format("0 to {:g}", kMaxIntensity),
                  fmt::format("{}", source.color[c] * source.intensity));
  }
  if (light.kind == SourceLight::Kind::spot) {
    const double inner = source.innerConeAngle, outer = source.outerConeAngle;
    if (!(inner >= 0 && inner < outer && outer <= std::numbers::pi / 2 + 1e-6))
      throw Error(location + ".spot", "invalid cone angles", "0 <= innerConeAngle < outerConeAngle <= pi / 2",
                  fmt::format("{} and {}", inner, outer));
    light.innerConeAngle = inner;
    light.outerConeAngle = std::min(outer, std::numbers::pi / 2);
  }
  return light;
}

}  // namespace

std::vector<SourceCamera> gltfCameras(const gltf::Document& document, const std::vector<GltfPlacement>& placements,
                                      const std::string& where, GltfLeftOut& leftOut) {
  std::vector<SourceCamera> cameras;
  for (const GltfPlacement& placement : placements) try {
      cameras.push_back(toCamera(find(document.cameras, "cameras", placement, where), placement, where));
    } catch (const Error& error) {
      leftOut.addValue(error);
    }
  return cameras;
}

std::vector<SourceLight> gltfLights(const gltf::Document& document, const std::vector<GltfPlacement>& placements,
                                    const std::string& where, GltfLeftOut& leftOut) {
  std::vector<SourceLight> lights;
  for (const GltfPlacement& placement : placements) try {
      lights.push_back(
          toLight(find(document.lights, "KHR_lights_punctual.lights", placement, where), placement, where));
    } catch (const Error& error) {
      leftOut.addValue(error);
    }
  return lights;
}

}  // namespace malus::prep

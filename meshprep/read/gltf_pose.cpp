#include "meshprep/read/gltf_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_accessor.h"

namespace malus::prep {

namespace {

using gltf::ComponentType;

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// The cofactors of a transform, which takes normals to normals of the mapped surface, also if it is singular.
glm::dmat3 normalTransform(const glm::dmat4& m) {
  const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
  return {glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)};
}

void requireCount(const GltfAccessor& accessor, std::size_t count) {
  if (accessor.count() != count)
    throw Error(accessor.location(), "numbers of values and positions differ", fmt::to_string(count),
                fmt::to_string(accessor.count()));
}

}  // namespace

GltfPose::GltfPose(const gltf::Document& document, GltfBuffers& buffers, const GltfPlacement& placement,
                   const std::vector<std::optional<glm::dmat4>>& worldFromNode, const std::string& where)
    : document_(document), buffers_(buffers), where_(where), weights_(placement.morphWeights) {
  if (!placement.skin) return;
  const gltf::Skin& skin = document.skins[*placement.skin];
  const std::string location = fmt::format("{}: skins[{}]", where, *placement.skin);
  if (skin.joints.empty()) throw Error(location + ".joints", "no joints", "1 or more");
  std::optional<GltfAccessor> inverse;
  if (skin.inverseBindMatrices) {
    inverse.emplace(document, buffers, *skin.inverseBindMatrices, where);
    inverse->requireElements(16, {ComponentType::float32});
    if (inverse->count() < skin.joints.size())
      throw Error(inverse->location(), "too few inverse bind matrices", fmt::to_string(skin.joints.size()),
                  fmt::to_string(inverse->count()));
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const std::size_t node = skin.joints[i];
    if (node >= worldFromNode.size() || !worldFromNode[node])
      throw Error(fmt::format("{}.joints[{}]", location, i), "joint is not in the scene", "a node of the scene",
                  fmt::to_string(node));
    glm::dmat4 bind(1.0);
    if (inverse)
      for (std::size_t e = 0; e < 16; ++e)
        bind[static_cast<int>(e / 4)][static_cast<int>(e % 4)] = inverse->number(i, e);
    joints_.push_back(*worldFromNode[node] * bind);
  }
}

std::size_t GltfPose::passes(const gltf::Primitive& primitive) const {
  return std::min(weights_.size(), primitive.targets.size()) + (joints_.empty() ? 0 : 1);
}

void GltfPose::apply(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, const std::string& location,
                     Polygons& polygons, std::vector<glm::vec4>& tangents) const {
  if (!weights_.empty()) morph(primitive, kept, polygons, tangents);
  if (!joints_.empty()) skin(primitive, kept, location, polygons, tangents);
  for (const glm::dvec3& p : polygons.positions)
    if (!isFinite(p)) throw Error(location, "the pose has a position that is not finite", "finite numbers");
}

// Source: glTF 2.0 Specification, section 3.7.2.2, "Morph Targets".
void GltfPose::morph(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, Polygons& polygons,
                     std::vector<glm::vec4>& tangents) const {
  const std::size_t count = document_.accessors[*primitive.position].count;
  const auto add = [&](std::optional<std::size_t> index, double weight, auto& values) {
    if (!index || values.empty()) return;
    const GltfAccessor accessor(document_, buffers_, *index, where_);
    accessor.requireVectors(document_.quantized);
    requireCount(accessor, count);
    using Vector = std::decay_t<decltype(values[0])>;
    for (std::size_t v = 0; v < kept.size(); ++v) {
      const glm::dvec3 displacement = weight * accessor.vector(kept[v]);
      if constexpr (std::is_same_v<Vector, glm::vec4>)
        values[v] += glm::vec4(glm::vec3(displacement), 0);  // keeps the sign of the bitangent
      else
        values[v] += Vector(displacement);
    }
  };
  for (std::size_t t = 0; t < std::min(weights_.size(), primitive.targets.size()); ++t) {
    if (weights_[t] == 0) continue;
    add(primitive.targets[t].position, weights_[t], polygons.positions);
    add(primitive.targets[t].normal, weights_[t], polygons.normals);
    add(primitive.targets[t].tangent, weights_[t], tangents);
  }
}

// Source: glTF 2.0 Specification, section 3.7.3.3, "Skinned Mesh Attributes".
void GltfPose::skin(const gltf::Primitive& primitive, std::span<const std::uint32_t> kept, const std::string& location,
                    Polygons& polygons, std::vector<glm::vec4>& tangents) const {
  const std::size_t count = document_.accessors[*primitive.position].count;
  std::vector<glm::dmat4> transforms(kept.size(), glm::dmat4(0.0));
  std::vector<double> sums(kept.size(), 0);
  for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
    if (!primitive.joints[set] && !primitive.weights[set]) continue;
    if (!primitive.joints[set] || !primitive.weights[set])
      throw Error(location, "joints without weights, or weights without joints", "both");
    const GltfAccessor joints(document_, buffers_, *primitive.joints[set], where_),
        weights(document_, buffers_, *primitive.weights[set], where_);
    joints.requireElements(4, {ComponentType::uint8, ComponentType::uint16});
    weights.requireElements(4, {ComponentType::float32, ComponentType::uint8, ComponentType::uint16}, true);
    requireCount(joints, count);
    requireCount(weights, count);
    for (std::size_t v = 0; v < kept.size(); ++v)
      for (std::size_t c = 0; c < 4; ++c) {
        const double weight = weights.number(kept[v], c);
        if (weight == 0) continue;
        const auto joint = static_cast<std::size_t>(joints.number(kept[v], c));
        if (joint >= joints_.size())
          throw Error(joints.location(), fmt::format("joint of vertex {} does not exist", kept[v]),
                      fmt::format("below {}", joints_.size()), fmt::to_string(joint));
        transforms[v] += weight * joints_[joint];
        sums[v] += weight;
      }
  }

  std::size_t mirrored = 0;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (!(sums[v] > 0))
      throw Error(location, fmt::format("vertex {} has no weight of a joint", kept[v]), "weights with the sum 1");
    const glm::dmat4 m = transforms[v] / sums[v];  // rounded weights do not move a vertex
    polygons.positions[v] = glm::dvec3(m * glm::dvec4(polygons.positions[v], 1));
    if (!polygons.normals.empty()) {
      const glm::dvec3 n = normalTransform(m) * glm::dvec3(polygons.normals[v]);
      const double length = glm::length(n);
      polygons.normals[v] = glm::vec3(length > 0 ? n / length : n);
    }
    if (!tangents.empty()) {
      const glm::dvec3 t = glm::dmat3(m) * glm::dvec3(tangents[v]);
      const double length = glm::length(t);
      tangents[v] = glm::vec4(glm::vec3(length > 0 ? t / length : t), tangents[v].w);
    }
    if (glm::determinant(glm::dmat3(m)) < 0) ++mirrored;
  }
  if (2 * mirrored <= kept.size()) return;
  for (std::size_t f = 0; f < polygons.faceCount(); ++f)
    std::reverse(polygons.corners.begin() + static_cast<std::ptrdiff_t>(polygons.firstCorner[f]),
                 polygons.corners.begin() + static_cast<std::ptrdiff_t>(polygons.firstCorner[f + 1]));
  for (glm::vec3& n : polygons.normals) n = -n;
  for (glm::vec4& t : tangents) t.w = -t.w;  // the bitangent is that of the file, mirrored
}

}  // namespace malus::prep

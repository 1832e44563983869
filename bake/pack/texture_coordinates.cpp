#include "bake/pack/texture_coordinates.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/pack/format.h"

namespace malus::pack {

namespace {

constexpr std::uint32_t kSet0Flag = 1, kSet1Flag = 2, kTangentsFlag = 4;
constexpr float kLengthTolerance = 1e-3f;

// Allocates one value of this number of floats per vertex.
template <class Vector>
void allocate(ByteReader& r, const Mesh& mesh, std::string_view what, std::vector<Vector>& values) {
  const std::size_t count = mesh.positions.size();
  if (count > r.left() / sizeof(Vector))
    r.fail(fmt::format("{} of mesh '{}' end early", what, mesh.name), fmt::format("{} values", count),
           fmt::format("{} bytes", r.left()));
  values.resize(count);
}

void readCoordinates(ByteReader& r, const Mesh& mesh, std::vector<glm::vec2>& coordinates) {
  allocate(r, mesh, "texture coordinates", coordinates);
  for (glm::vec2& uv : coordinates)
    for (int axis = 0; axis < 2; ++axis) {
      uv[axis] = r.f32();
      if (!(std::abs(uv[axis]) <= static_cast<float>(kMaxTextureCoordinate)))
        r.fail(fmt::format("texture coordinate of mesh '{}' is out of range", mesh.name),
               fmt::format("-{0:g} to {0:g}", kMaxTextureCoordinate), fmt::format("{}", uv[axis]));
    }
}

void readTangents(ByteReader& r, const Mesh& mesh, std::vector<glm::vec4>& tangents) {
  allocate(r, mesh, "tangents", tangents);
  for (glm::vec4& t : tangents) {
    for (int axis = 0; axis < 4; ++axis) t[axis] = r.f32();
    const float length = glm::length(glm::vec3(t));
    if (!(std::abs(length - 1) <= kLengthTolerance))
      r.fail(fmt::format("tangent of mesh '{}'", mesh.name), "a unit vector", fmt::format("length {}", length));
    if (std::abs(t.w) != 1)
      r.fail(fmt::format("sign of a tangent of mesh '{}'", mesh.name), "1 or -1", fmt::format("{}", t.w));
  }
}

}  // namespace

void writeTextureAttributes(ByteWriter& w, const Mesh& mesh, std::span<const std::uint32_t> order) {
  w.u32((mesh.textureCoordinates[0].empty() ? 0 : kSet0Flag) | (mesh.textureCoordinates[1].empty() ? 0 : kSet1Flag) |
        (mesh.tangents.empty() ? 0 : kTangentsFlag));
  for (const std::vector<glm::vec2>& set : mesh.textureCoordinates)
    if (!set.empty())
      for (const std::uint32_t v : order) w.f32(set[v].x), w.f32(set[v].y);
  if (!mesh.tangents.empty())
    for (const std::uint32_t v : order)
      for (int axis = 0; axis < 4; ++axis) w.f32(mesh.tangents[v][axis]);
}

void readTextureAttributes(ByteReader r, std::vector<Mesh>& meshes) {
  for (Mesh& mesh : meshes) {
    const std::uint32_t flags = r.u32AtMost(kSet0Flag | kSet1Flag | kTangentsFlag, "texture attributes of a mesh");
    if ((flags & kSet0Flag) != 0) readCoordinates(r, mesh, mesh.textureCoordinates[0]);
    if ((flags & kSet1Flag) != 0) readCoordinates(r, mesh, mesh.textureCoordinates[1]);
    if ((flags & kTangentsFlag) != 0) readTangents(r, mesh, mesh.tangents);
  }
  r.end();
}

}  // namespace malus::pack

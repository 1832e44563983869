#include "meshprep/textures/texture_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "meshprep/clean/select.h"
#include "meshprep/normals/piece_normals.h"

namespace malus::prep {

namespace {

// Bits of all attributes of a corner. Adding zero makes -0 and 0 equal.
using AttributeBits = std::array<std::uint32_t, 8>;
AttributeBits attributeBits(const CornerTexture& corner) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value + 0.0f); };
  const auto& [uv, t, isMissing] = corner;
  return {bits(uv[0].x), bits(uv[0].y), bits(uv[1].x), bits(uv[1].y), bits(t.x), bits(t.y), bits(t.z), bits(t.w)};
}

class TextureVertices {
 public:
  explicit TextureVertices(Mesh& mesh) : mesh_(mesh) {}

  TextureVertexCounts run() {
    fillMissing();
    if (mesh_.hasTangents)
      for (std::size_t corner = 0; corner < mesh_.cornerTextures.size(); ++corner) finishTangent(corner);
    split();
    mesh_.cornerTextures.clear();
    return counts_;
  }

 private:
  std::uint32_t vertexAt(std::size_t corner) const { return mesh_.triangles[corner / 3][static_cast<int>(corner % 3)]; }

  // Gives a corner without attributes those of another corner of its vertex: the first of its source face, or else the
  // first of all. Without any they are zero.
  void fillMissing() {
    std::map<std::uint32_t, std::vector<std::size_t>> missing;  // by vertex
    for (std::size_t corner = 0; corner < mesh_.cornerTextures.size(); ++corner)
      if (mesh_.cornerTextures[corner].isMissing) missing[vertexAt(corner)].push_back(corner);
    if (missing.empty()) return;
    std::map<std::uint32_t, std::vector<std::size_t>> known;
    for (std::size_t corner = 0; corner < mesh_.cornerTextures.size(); ++corner)
      if (!mesh_.cornerTextures[corner].isMissing && missing.contains(vertexAt(corner)))
        known[vertexAt(corner)].push_back(corner);
    for (const auto& [vertex, corners] : missing)
      for (const std::size_t corner : corners) {
        ++counts_.filled;
        const std::vector<std::size_t>& others = known[vertex];
        std::size_t best = others.empty() ? corner : others.front();
        for (const std::size_t other : others)
          if (sourceFaceAt(other / 3) == sourceFaceAt(corner / 3)) {
            best = other;
            break;
          }
        mesh_.cornerTextures[corner] = mesh_.cornerTextures[best];
        mesh_.cornerTextures[corner].isMissing = false;
      }
  }

  std::uint32_t sourceFaceAt(std::size_t triangle) const {
    return mesh_.sourceFaces.empty() ? static_cast<std::uint32_t>(triangle) : mesh_.sourceFaces[triangle];
  }

  glm::dvec3 normalOfFace(std::size_t triangle) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    return faceNormal(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
  }

  // Tangent by the derivatives of the coordinates of a triangle: the unit vector in which u grows, and the sign of the
  // bitangent. v grows downward, so that coordinates that are not mirrored turn clockwise. Zero without a direction.
  glm::dvec4 tangentByCoordinates(std::size_t triangle) const {
    const std::size_t set = mesh_.hasCoordinates[0] ? 0 : 1;
    const auto uv = [&](std::size_t k) { return glm::dvec2(mesh_.cornerTextures[3 * triangle + k].coordinates[set]); };
    const glm::uvec3& t = mesh_.triangles[triangle];
    const glm::dvec3 edge1 = mesh_.positions[t.y] - mesh_.positions[t.x],
                     edge2 = mesh_.positions[t.z] - mesh_.positions[t.x];
    const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const double sign = d1.x * d2.y - d1.y * d2.x < 0 ? 1 : -1;
    const glm::dvec3 direction = -sign * (edge1 * d2.y - edge2 * d1.y);
    const double length = glm::length(direction);
    return length > 0 ? glm::dvec4(direction / length, sign) : glm::dvec4(0);
  }

  // A direction at right angles to a unit vector or to zero.
  static glm::dvec3 anyPerpendicular(const glm::dvec3& n) {
    const glm::dvec3 axis = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - glm::dot(axis, n) * n);
  }

  void finishTangent(std::size_t corner) {
    glm::vec4& stored = mesh_.cornerTextures[corner].tangent;
    const std::size_t triangle = corner / 3;
    const glm::dvec3 tangent(stored);
    const double length = glm::length(tangent);
    if (!(length > 0) || !std::isfinite(length)) {
      ++counts_.tangents;
      const glm::dvec4 derived = tangentByCoordinates(triangle);
      stored = glm::vec4(derived.w != 0 ? derived : glm::dvec4(anyPerpendicular(normalOfFace(triangle)), 1));
      return;
    }

    // The bitangent of the file is sign cross(normal, tangent) with the file's normal, or that of its face.
    const bool flipped = !mesh_.flipped.empty() && mesh_.flipped[triangle] != 0;
    const glm::dvec3 face = normalOfFace(triangle);
    const glm::dvec3 authored(mesh_.cornerNormals.empty() ? glm::vec3(0) : mesh_.cornerNormals[corner]);
    const glm::dvec3 before = authored != glm::dvec3(0) ? authored : face * (flipped ? -1.0 : 1.0);
    const glm::dvec3 after = mesh_.normals.empty() ? face : glm::dvec3(mesh_.normals[vertexAt(corner)]);
    const float sign = glm::dot(before, after) < 0 ? -stored.w : stored.w;
    stored = glm::vec4(glm::vec3(tangent / length), sign);
  }

  void split() {
    // Find the different attributes at each vertex, by their first corners.
    const auto corners = static_cast<std::uint32_t>(mesh_.cornerTextures.size());
    std::map<std::pair<std::uint32_t, AttributeBits>, std::uint32_t> firstCorner;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stored;  // vertex, first corner
    std::vector<std::uint32_t> leader(corners);
    std::vector<char> isUsed(mesh_.positions.size(), 0);
    for (std::uint32_t corner = 0; corner < corners; ++corner) {
      const std::uint32_t v = vertexAt(corner);
      const auto [found, isNew] = firstCorner.try_emplace({v, attributeBits(mesh_.cornerTextures[corner])}, corner);
      if (isNew) stored.emplace_back(v, corner);
      leader[corner] = found->second;
      isUsed[v] = 1;
    }
    for (std::uint32_t v = 0; v < isUsed.size(); ++v)
      if (isUsed[v] == 0) stored.emplace_back(v, kNoSource);
    std::sort(stored.begin(), stored.end());

    // Make a vertex of each.
    std::vector<std::uint32_t> from, newVertex(corners, 0);
    std::vector<CornerTexture> values;
    for (const auto& [v, corner] : stored) {
      if (corner != kNoSource) newVertex[corner] = static_cast<std::uint32_t>(from.size());
      from.push_back(v);
      values.push_back(corner != kNoSource ? mesh_.cornerTextures[corner] : CornerTexture{{}, {1, 0, 0, 1}});
    }
    counts_.added = from.size() - mesh_.positions.size();
    std::vector<glm::uvec3> triangles(mesh_.triangles.size());
    for (std::uint32_t corner = 0; corner < corners; ++corner)
      triangles[corner / 3][static_cast<int>(corner % 3)] = newVertex[leader[corner]];
    selectVertices(mesh_, from, std::vector<std::uint32_t>(mesh_.positions.size(), 0));
    mesh_.triangles = std::move(triangles);
    for (const CornerTexture& value : values) {
      for (std::size_t set = 0; set < value.coordinates.size(); ++set)
        if (mesh_.hasCoordinates[set]) mesh_.textureCoordinates[set].push_back(value.coordinates[set]);
      if (mesh_.hasTangents) mesh_.tangents.push_back(value.tangent);
    }
  }

  Mesh& mesh_;
  TextureVertexCounts counts_;
};

}  // namespace

TextureVertexCounts addTextureVertices(Mesh& mesh) { return TextureVertices(mesh).run(); }

}  // namespace malus::prep

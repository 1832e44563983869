#include "meshprep/normals/authored_normals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "meshprep/clean/select.h"
#include "meshprep/normals/crease_normals.h"

namespace malus::prep {

namespace {

// Unit length; zero where there is no direction.
glm::vec3 unit(const glm::vec3& normal) {
  const glm::dvec3 n(normal);
  const double length = glm::length(n);
  return length > 0 && std::isfinite(length) ? glm::vec3(n / length) : glm::vec3(0);
}

std::array<std::uint32_t, 3> floatBits(const glm::vec3& n) {
  const glm::vec3 oneZero = n + 0.0f;
  return {std::bit_cast<std::uint32_t>(oneZero.x), std::bit_cast<std::uint32_t>(oneZero.y),
          std::bit_cast<std::uint32_t>(oneZero.z)};
}

}  // namespace

AuthoredNormals addAuthoredNormals(Mesh& mesh, double creaseDegrees) {
  // Step 1: unit normals at every corner, the crease angle's where there are none.
  AuthoredNormals result;
  std::vector<glm::vec3> normals;
  normals.reserve(mesh.cornerNormals.size());
  for (const glm::vec3& n : mesh.cornerNormals) {
    normals.push_back(unit(n));
    if (normals.back() == glm::vec3(0)) ++result.missing;
  }
  if (result.missing > 0) {
    Mesh creased = mesh;
    result.counts.undefined = addCreaseNormals(creased, creaseDegrees).undefined;
    for (std::size_t corner = 0; corner < normals.size(); ++corner)
      if (normals[corner] == glm::vec3(0))
        normals[corner] = creased.normals[creased.triangles[corner / 3][static_cast<int>(corner % 3)]];
  }

  // Step 2: sides.
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 face = faceNormal(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    const auto behind = [&] {
      return std::count_if(normals.begin() + static_cast<std::ptrdiff_t>(3 * i),
                           normals.begin() + static_cast<std::ptrdiff_t>(3 * i + 3),
                           [&](const glm::vec3& n) { return glm::dot(glm::dvec3(n), face) < 0; });
    };
    if (!mesh.flipped.empty() && mesh.flipped[i] != 0 && behind() == 3)
      for (std::size_t corner = 3 * i; corner < 3 * i + 3; ++corner) normals[corner] = -normals[corner];
    if (behind() > 0) result.against.add([&] { return findingAt(mesh, centroid(mesh, i), {i}, {t.x, t.y, t.z}); });
  }

  // Step 3: a vertex for every normal at a vertex, in the order of vertices and then of corners.
  std::map<std::pair<std::uint32_t, std::array<std::uint32_t, 3>>, std::uint32_t> firstCorner;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stored;  // vertex, first corner
  std::vector<std::uint32_t> leader(normals.size());
  for (std::uint32_t corner = 0; corner < normals.size(); ++corner) {
    const std::uint32_t v = mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
    const auto [found, isNew] = firstCorner.try_emplace({v, floatBits(normals[corner])}, corner);
    if (isNew) stored.emplace_back(v, corner);
    leader[corner] = found->second;
  }
  std::vector<char> named(mesh.positions.size(), 0);
  for (const auto& [v, corner] : stored) named[v] = 1;
  for (std::uint32_t v = 0; v < named.size(); ++v)
    if (named[v] == 0) stored.emplace_back(v, kNoSource);
  std::sort(stored.begin(), stored.end());
  result.counts.added = stored.size() - mesh.positions.size();
  std::vector<std::uint32_t> from, newVertex(normals.size(), 0);
  std::vector<glm::vec3> vertexNormals;
  for (const auto& [v, corner] : stored) {
    if (corner != kNoSource) newVertex[corner] = static_cast<std::uint32_t>(from.size());
    from.push_back(v);
    vertexNormals.push_back(corner == kNoSource ? glm::vec3(0, 0, 1) : normals[corner]);
  }
  std::vector<glm::uvec3> triangles(mesh.triangles.size());
  for (std::uint32_t corner = 0; corner < normals.size(); ++corner)
    triangles[corner / 3][static_cast<int>(corner % 3)] = newVertex[leader[corner]];
  selectVertices(mesh, from, std::vector<std::uint32_t>(mesh.positions.size(), 0));
  mesh.triangles = std::move(triangles);
  mesh.normals = std::move(vertexNormals);
  return result;
}

}  // namespace malus::prep

#include "meshprep/clean/duplicate_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

// Triangle with sorted vertices.
struct Face {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t triangle = 0;
  bool even = false;  // orientation: smallest, middle, largest
};

std::vector<Face> sortedFaces(const Mesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    Face face{{t.x, t.y, t.z}, i, false};
    std::sort(face.vertices.begin(), face.vertices.end());
    const auto& [a, b, c] = face.vertices;
    face.even = (t.x == a && t.y == b) || (t.y == a && t.z == b) || (t.z == a && t.x == b);
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.triangle < b.triangle;
  });
  return faces;
}

}  // namespace

DuplicateFaces dropDuplicateFaces(Mesh& mesh, bool dropOpposite) {
  // Find the first triangle with the same vertices, for each orientation.
  constexpr std::uint32_t kNone = kNoSource;
  const std::vector<Face> faces = sortedFaces(mesh);
  std::vector<std::uint32_t> same(mesh.triangles.size(), kNone), opposite(mesh.triangles.size(), kNone);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    std::array<std::uint32_t, 2> first{kNone, kNone};  // per orientation
    for (; end < faces.size() && faces[end].vertices == faces[begin].vertices; ++end) {
      const Face& face = faces[end];
      std::uint32_t& earlier = first[face.even ? 1 : 0];
      if (earlier != kNone) {
        same[face.triangle] = earlier;
      } else {
        earlier = face.triangle;
        opposite[face.triangle] = first[face.even ? 0 : 1];
      }
    }
  }

  // Drop and report in the order of the mesh.
  DuplicateFaces result;
  std::vector<char> keep(mesh.triangles.size(), 1);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (same[i] != kNone) {
      result.same.add([&] { return findingAt(mesh, centroid(mesh, i), {i, same[i]}); });
      keep[i] = 0;
    } else if (opposite[i] != kNone) {
      result.opposite.add([&] { return findingAt(mesh, centroid(mesh, i), {i, opposite[i]}); });
      keep[i] = dropOpposite ? 0 : 1;
    }
  }
  keepTriangles(mesh, [&](std::size_t i) { return keep[i] != 0; });
  return result;
}

}  // namespace malus::prep

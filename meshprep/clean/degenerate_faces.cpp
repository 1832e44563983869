#include "meshprep/clean/degenerate_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>

#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr double kAreaTolerance = 1e-12;  // a few thousand roundings of a cross product
constexpr double kEndTolerance = 1e-9;    // of the longest edge: a middle corner nearer to an end is that end
constexpr int kRounds = 16;               // triangles of zero area that lie beside each other take some

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Scaled first: squares of very small or large edges leave the range of double.
  const double scale = std::max({largest(b - a), largest(c - b), largest(a - c)});
  if (scale == 0) return true;
  const glm::dvec3 u = (b - a) / scale, v = (c - a) / scale;
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  return glm::length(glm::cross(u, v)) <= kAreaTolerance * longest * longest;
}

bool repeatsCorner(const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

// A triangle of zero area, turned so that b lies on the edge from c to a.
struct Flat {
  std::size_t triangle;
  std::uint32_t a, b, c;
};

// Nothing where the triangle has area, or where its middle corner is one of the ends.
std::optional<Flat> flatAt(const Mesh& mesh, std::size_t i) {
  const glm::uvec3& t = mesh.triangles[i];
  if (repeatsCorner(t) || !isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) return {};
  for (int middle = 0; middle < 3; ++middle) {
    const std::uint32_t a = t[(middle + 2) % 3], b = t[middle], c = t[(middle + 1) % 3];
    const glm::dvec3 along = mesh.positions[c] - mesh.positions[a], toB = mesh.positions[b] - mesh.positions[a];
    const double scale = largest(along);
    if (scale == 0) continue;
    const double share = glm::dot(toB / scale, along / scale) / glm::dot(along / scale, along / scale);
    if (share > kEndTolerance && share < 1 - kEndTolerance) return Flat{i, a, b, c};
  }
  return {};
}

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32u | std::max(a, b);
}

// One round: every flat triangle whose long edge has one other triangle, untouched so far, takes half of it. Returns
// whether anything was done.
bool cutNeighbours(Mesh& mesh, const std::vector<Flat>& flats, std::vector<char>& taken, DegenerateFaces& result) {
  // Step 1: the triangles on the long edges.
  struct Uses {
    std::array<std::size_t, 2> triangle{};
    std::size_t count = 0;
  };
  std::unordered_map<std::uint64_t, Uses> edges;
  for (const Flat& flat : flats) edges.emplace(edgeKey(flat.a, flat.c), Uses{});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; taken[i] == 0 && k < 3; ++k) {
      const auto found = edges.find(edgeKey(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]));
      if (found == edges.end()) continue;
      Uses& uses = found->second;
      if (uses.count < 2) uses.triangle[uses.count] = i;
      ++uses.count;
    }

  // Step 2: cut. The flat one's place in the list takes one half, the neighbour's the other.
  bool done = false;
  std::vector<char> touched(mesh.triangles.size(), 0);
  for (const Flat& flat : flats) {
    const Uses& uses = edges.at(edgeKey(flat.a, flat.c));
    if (uses.count != 2) continue;
    const std::size_t other = uses.triangle[0] == flat.triangle ? uses.triangle[1] : uses.triangle[0];
    if (touched[flat.triangle] != 0 || touched[other] != 0) continue;
    const glm::uvec3 n = mesh.triangles[other];
    int k = 0;  // the neighbour's corner across from the edge
    while (n[k] == flat.a || n[k] == flat.c) ++k;
    const std::uint32_t from = n[(k + 1) % 3], to = n[(k + 2) % 3], apex = n[k];
    touched[flat.triangle] = touched[other] = 1;
    done = true;
    result.zeroArea.add([&] {
      return findingAt(mesh, mesh.positions[flat.b], {flat.triangle}, {flat.b}, "closed by cutting its neighbour");
    });
    if (apex == flat.b) {  // the two lie back to back: both go
      taken[flat.triangle] = taken[other] = 1;
      result.zeroArea.add([&] { return findingAt(mesh, mesh.positions[flat.b], {other}, {flat.b}); });
      continue;
    }
    result.neighboursCut.add([&] { return findingAt(mesh, mesh.positions[flat.b], {other}, {flat.b}); });
    mesh.triangles[other] = {apex, from, flat.b};
    mesh.triangles[flat.triangle] = {apex, flat.b, to};
    if (!mesh.sourceFaces.empty()) mesh.sourceFaces[flat.triangle] = mesh.sourceFaces[other];
    if (!mesh.turned.empty()) mesh.turned[flat.triangle] = mesh.turned[other];
    if (!mesh.smoothingGroups.empty()) mesh.smoothingGroups[flat.triangle] = mesh.smoothingGroups[other];
    for (const std::size_t half : {other, flat.triangle}) {
      const glm::uvec3& t = mesh.triangles[half];
      if (!mesh.sourceCorners.empty())
        mesh.sourceCorners[half] = {sourceVertex(mesh, t.x), sourceVertex(mesh, t.y), sourceVertex(mesh, t.z)};
      if (!mesh.cornerNormals.empty())
        std::fill_n(mesh.cornerNormals.begin() + static_cast<std::ptrdiff_t>(3 * half), 3, glm::vec3(0));
    }
  }
  return done;
}

}  // namespace

DegenerateFaces dropDegenerateFaces(Mesh& mesh) {
  DegenerateFaces result;

  // Step 1: corners that are the same vertex.
  keepTriangles(mesh, [&](std::size_t i) {
    if (!repeatsCorner(mesh.triangles[i])) return true;
    result.repeatedCorner.add([&] { return findingAt(mesh, mesh.positions[mesh.triangles[i].x], {i}); });
    return false;
  });

  // Step 2: triangles without area hand their place to half of a neighbour.
  std::vector<char> taken(mesh.triangles.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Flat> flats;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (const std::optional<Flat> flat = taken[i] == 0 ? flatAt(mesh, i) : std::nullopt) flats.push_back(*flat);
    if (flats.empty() || !cutNeighbours(mesh, flats, taken, result)) break;
  }

  // Step 3: those that are left go.
  keepTriangles(mesh, [&](std::size_t i) {
    if (taken[i] != 0) return false;
    const glm::uvec3& t = mesh.triangles[i];
    if (!isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) return true;
    result.zeroArea.add([&] { return findingAt(mesh, centroid(mesh, i), {i}); });
    return false;
  });
  return result;
}

}  // namespace malus::prep

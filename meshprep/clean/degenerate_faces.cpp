#include "meshprep/clean/degenerate_faces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>

#include "meshprep/base/parallel_blocks.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr double kAreaTolerance = 1e-12;  // a few thousand rounding errors of a cross product
constexpr double kEndTolerance =
    1e-9;                    // relative to the longest edge: distance at which a middle corner coincides with an end
constexpr int kRounds = 16;  // of collapsing edges, which may degenerate others

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool repeatsCorner(const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

bool hasArea(const Mesh& mesh, const glm::uvec3& t) {
  return !repeatsCorner(t) && !isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
}

// Triangle of zero area, rotated so that b is on the edge from a to c, at this fraction of it from a.
struct Flat {
  std::uint32_t triangle = 0, a = 0, b = 0, c = 0;
  double fraction = 0;
  bool isNeedle() const { return !(fraction > kEndTolerance && fraction < 1 - kEndTolerance); }
};

std::optional<Flat> findFlat(const Mesh& mesh, std::uint32_t i) {
  const glm::uvec3& t = mesh.triangles[i];
  if (repeatsCorner(t) || hasArea(mesh, t)) return {};
  // The middle corner is opposite to the longest edge.
  Flat flat;
  double longest = -1;
  for (int middle = 0; middle < 3; ++middle) {
    const std::uint32_t a = t[(middle + 2) % 3], b = t[middle], c = t[(middle + 1) % 3];
    const glm::dvec3 edge = mesh.positions[c] - mesh.positions[a], toB = mesh.positions[b] - mesh.positions[a];
    const double scale = largest(edge);
    if (scale <= longest) continue;
    longest = scale;
    const double squared = scale > 0 ? glm::dot(edge / scale, edge / scale) : 1;
    flat = {i, a, b, c, scale > 0 ? glm::dot(toB / scale, edge / scale) / squared : 0};
  }
  return flat;
}

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32u | std::max(a, b);
}

// Collapses edges of negligible length. Returns true if there was one.
bool collapseShortEdges(Mesh& mesh, DegenerateFaces& result) {
  std::vector<std::uint32_t> become(mesh.positions.size());
  std::iota(become.begin(), become.end(), 0u);
  const auto finalVertex = [&](std::uint32_t v) {
    while (become[v] != v) v = become[v];
    return v;
  };
  bool any = false;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::optional<Flat> flat = findFlat(mesh, i);
    if (!flat || !flat->isNeedle()) continue;
    const std::uint32_t end = flat->fraction < 0.5 ? flat->a : flat->c;
    const std::uint32_t first = std::min(finalVertex(end), finalVertex(flat->b)),
                        second = std::max(finalVertex(end), finalVertex(flat->b));
    if (first == second) continue;
    become[second] = first;
    any = true;
    result.edgesCollapsed.add([&] { return findingAt(mesh, mesh.positions[first], {i}, {first, second}); });
  }
  if (!any) return false;
  keepTriangles(mesh, [&](std::size_t i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::uvec3 now{finalVertex(t.x), finalVertex(t.y), finalVertex(t.z)};
    if (repeatsCorner(now)) {
      result.zeroArea.add([&] { return findingAt(mesh, mesh.positions[t.x], {i}); });
      return false;
    }
    mesh.triangles[i] = now;
    return true;
  });
  return true;
}

// Cuts the neighbours of flat triangles, as soon as their longest edges have a neighbour with area.
class Cutter {
 public:
  Cutter(Mesh& mesh, DegenerateFaces& result) : mesh_(mesh), result_(result) {}

  void run() {
    std::deque<Flat> flats;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      if (const std::optional<Flat> flat = findFlat(mesh_, i)) flats.push_back(*flat);
    if (flats.empty()) return;
    isOnFlat_.assign(mesh_.positions.size(), 0);
    for (const Flat& flat : flats) isOnFlat_[flat.a] = isOnFlat_[flat.b] = isOnFlat_[flat.c] = 1;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) addUses(i);
    for (std::size_t idle = 0; !flats.empty() && idle <= flats.size();) {
      const Flat flat = flats.front();
      flats.pop_front();
      if (cut(flat)) {
        idle = 0;
      } else {
        flats.push_back(flat);
        ++idle;
      }
    }
  }

 private:
  // Visits the lists of triangles on edges between vertices of flat triangles.
  template <class Visit>
  void forEdges(std::uint32_t triangle, Visit visit) {
    const glm::uvec3& t = mesh_.triangles[triangle];
    for (int k = 0; k < 3; ++k)
      if (isOnFlat_[t[k]] != 0 && isOnFlat_[t[(k + 1) % 3]] != 0) visit(uses_[edgeKey(t[k], t[(k + 1) % 3])]);
  }
  void addUses(std::uint32_t triangle) {
    forEdges(triangle, [&](std::vector<std::uint32_t>& uses) { uses.push_back(triangle); });
  }
  void removeUses(std::uint32_t triangle) {
    forEdges(triangle, [&](std::vector<std::uint32_t>& uses) { std::erase(uses, triangle); });
  }

  // Cuts the neighbour. The indices of both triangles get a half each.
  bool cut(const Flat& flat) {
    const std::vector<std::uint32_t>& uses = uses_[edgeKey(flat.a, flat.c)];
    if (uses.size() != 2) return false;
    const std::uint32_t other = uses[0] == flat.triangle ? uses[1] : uses[0];
    if (!hasArea(mesh_, mesh_.triangles[other])) return false;
    result_.zeroArea.add([&] {
      return findingAt(mesh_, mesh_.positions[flat.b], {flat.triangle}, {flat.b}, "closed by cutting its neighbour");
    });
    result_.neighboursCut.add([&] { return findingAt(mesh_, mesh_.positions[flat.b], {other}, {flat.b}); });
    removeUses(flat.triangle);
    removeUses(other);

    // Replace one end of the edge by the cut in each half. Other corners keep their attributes.
    const glm::uvec3 n = mesh_.triangles[other];
    int apex = 0;
    while (n[apex] == flat.a || n[apex] == flat.c) ++apex;
    const int from = (apex + 1) % 3, to = (apex + 2) % 3;
    copyTriangle(other, flat.triangle);
    const CornerTexture texture = cutTexture(other, from, to, n[from] == flat.a ? flat.fraction : 1 - flat.fraction);
    setCutCorner(other, to, flat.b, texture);
    setCutCorner(flat.triangle, from, flat.b, texture);
    addUses(flat.triangle);
    addUses(other);
    return true;
  }

  void copyTriangle(std::size_t source, std::size_t target) {
    mesh_.triangles[target] = mesh_.triangles[source];
    if (!mesh_.sourceFaces.empty()) mesh_.sourceFaces[target] = mesh_.sourceFaces[source];
    if (!mesh_.sourceCorners.empty()) mesh_.sourceCorners[target] = mesh_.sourceCorners[source];
    if (!mesh_.flipped.empty()) mesh_.flipped[target] = mesh_.flipped[source];
    if (!mesh_.smoothingGroups.empty()) mesh_.smoothingGroups[target] = mesh_.smoothingGroups[source];
    for (std::size_t k = 0; k < 3 && !mesh_.cornerNormals.empty(); ++k)
      mesh_.cornerNormals[3 * target + k] = mesh_.cornerNormals[3 * source + k];
    for (std::size_t k = 0; k < 3 && !mesh_.cornerTextures.empty(); ++k)
      mesh_.cornerTextures[3 * target + k] = mesh_.cornerTextures[3 * source + k];
  }
  // Texture attributes between two corners of a triangle.
  CornerTexture cutTexture(std::size_t triangle, int from, int to, double fraction) const {
    if (mesh_.cornerTextures.empty()) return {};
    const auto at = [&](int corner) { return mesh_.cornerTextures[3 * triangle + static_cast<std::size_t>(corner)]; };
    return interpolated(at(from), at(to), fraction);
  }
  void setCutCorner(std::size_t triangle, int corner, std::uint32_t vertex, const CornerTexture& texture) {
    mesh_.triangles[triangle][corner] = vertex;
    if (!mesh_.sourceCorners.empty()) mesh_.sourceCorners[triangle][corner] = sourceVertex(mesh_, vertex);
    if (!mesh_.cornerNormals.empty())
      mesh_.cornerNormals[3 * triangle + static_cast<std::size_t>(corner)] = glm::vec3(0);
    if (!mesh_.cornerTextures.empty()) mesh_.cornerTextures[3 * triangle + static_cast<std::size_t>(corner)] = texture;
  }

  Mesh& mesh_;
  DegenerateFaces& result_;
  std::vector<char> isOnFlat_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> uses_;
};

}  // namespace

bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Scale, because squares of very small or large edges leave the range of double.
  const double scale = std::max({largest(b - a), largest(c - b), largest(a - c)});
  if (scale == 0) return true;
  const glm::dvec3 u = (b - a) / scale, v = (c - a) / scale;
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  return glm::length(glm::cross(u, v)) <= kAreaTolerance * longest * longest;
}

DegenerateFaces dropDegenerateFaces(Mesh& mesh) {
  DegenerateFaces result;

  // Remove triangles with a repeated vertex, and collapse edges of negligible length.
  keepTriangles(mesh, [&](std::size_t i) {
    if (!repeatsCorner(mesh.triangles[i])) return true;
    result.repeatedCorner.add([&] { return findingAt(mesh, mesh.positions[mesh.triangles[i].x], {i}); });
    return false;
  });
  if (allNumbers(mesh.triangles.size(), [&](std::size_t i) { return hasArea(mesh, mesh.triangles[i]); })) return result;
  for (int round = 0; round < kRounds && collapseShortEdges(mesh, result); ++round) {
  }

  // Cut neighbours of the remaining ones.
  Cutter(mesh, result).run();

  // Remove those without a suitable neighbour.
  keepTriangles(mesh, [&](std::size_t i) {
    if (hasArea(mesh, mesh.triangles[i])) return true;
    result.zeroArea.add([&] { return findingAt(mesh, centroid(mesh, i), {i}); });
    return false;
  });
  return result;
}

}  // namespace malus::prep

#include "meshprep/clean/degenerate_faces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>

#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr double kAreaTolerance = 1e-12;  // a few thousand roundings of a cross product
constexpr double kEndTolerance = 1e-9;    // of the longest edge: a middle corner nearer to an end is that end
constexpr int kRounds = 16;               // of collapsing edges, which may leave others without length

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool repeatsCorner(const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

bool hasArea(const Mesh& mesh, const glm::uvec3& t) {
  return !repeatsCorner(t) && !isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
}

// A triangle of zero area, turned so that b lies on the edge from c to a, at this share of it from a.
struct Flat {
  std::uint32_t triangle = 0, a = 0, b = 0, c = 0;
  double share = 0;
  bool isNeedle() const { return !(share > kEndTolerance && share < 1 - kEndTolerance); }
};

std::optional<Flat> flatAt(const Mesh& mesh, std::uint32_t i) {
  const glm::uvec3& t = mesh.triangles[i];
  if (repeatsCorner(t) || hasArea(mesh, t)) return {};
  // The middle corner is across from the longest edge.
  Flat flat;
  double longest = -1;
  for (int middle = 0; middle < 3; ++middle) {
    const std::uint32_t a = t[(middle + 2) % 3], b = t[middle], c = t[(middle + 1) % 3];
    const glm::dvec3 along = mesh.positions[c] - mesh.positions[a], toB = mesh.positions[b] - mesh.positions[a];
    const double scale = largest(along);
    if (scale <= longest) continue;
    longest = scale;
    const double squared = scale > 0 ? glm::dot(along / scale, along / scale) : 1;
    flat = {i, a, b, c, scale > 0 ? glm::dot(toB / scale, along / scale) / squared : 0};
  }
  return flat;
}

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32u | std::max(a, b);
}

// The first vertex of every edge that has no length beside its triangle.
bool collapseShortEdges(Mesh& mesh, DegenerateFaces& result) {
  std::vector<std::uint32_t> become(mesh.positions.size());
  std::iota(become.begin(), become.end(), 0u);
  const auto firstOf = [&](std::uint32_t v) {
    while (become[v] != v) v = become[v];
    return v;
  };
  bool any = false;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::optional<Flat> flat = flatAt(mesh, i);
    if (!flat || !flat->isNeedle()) continue;
    const std::uint32_t end = flat->share < 0.5 ? flat->a : flat->c;
    const std::uint32_t first = std::min(firstOf(end), firstOf(flat->b)),
                        second = std::max(firstOf(end), firstOf(flat->b));
    if (first == second) continue;
    become[second] = first;
    any = true;
    result.edgesCollapsed.add([&] { return findingAt(mesh, mesh.positions[first], {i}, {first, second}); });
  }
  if (!any) return false;
  keepTriangles(mesh, [&](std::size_t i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::uvec3 now{firstOf(t.x), firstOf(t.y), firstOf(t.z)};
    if (repeatsCorner(now)) {
      result.zeroArea.add([&] { return findingAt(mesh, mesh.positions[t.x], {i}); });
      return false;
    }
    mesh.triangles[i] = now;
    return true;
  });
  return true;
}

// Cuts neighbours of flat triangles, one after the other as their long edges get a neighbour with area.
class Cutter {
 public:
  Cutter(Mesh& mesh, DegenerateFaces& result) : mesh_(mesh), result_(result) {}

  void run() {
    std::deque<Flat> flats;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      if (const std::optional<Flat> flat = flatAt(mesh_, i)) flats.push_back(*flat);
    if (flats.empty()) return;
    ofFlats_.assign(mesh_.positions.size(), 0);
    for (const Flat& flat : flats) ofFlats_[flat.a] = ofFlats_[flat.b] = ofFlats_[flat.c] = 1;
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
  // Edges between vertices of flat triangles, with their triangles.
  template <class Visit>
  void forEdgesOf(std::uint32_t triangle, Visit visit) {
    const glm::uvec3& t = mesh_.triangles[triangle];
    for (int k = 0; k < 3; ++k)
      if (ofFlats_[t[k]] != 0 && ofFlats_[t[(k + 1) % 3]] != 0) visit(uses_[edgeKey(t[k], t[(k + 1) % 3])]);
  }
  void addUses(std::uint32_t triangle) {
    forEdgesOf(triangle, [&](std::vector<std::uint32_t>& uses) { uses.push_back(triangle); });
  }
  void removeUses(std::uint32_t triangle) {
    forEdgesOf(triangle, [&](std::vector<std::uint32_t>& uses) { std::erase(uses, triangle); });
  }

  // The flat one's place in the list takes one half of the neighbour, the neighbour's the other.
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

    // The neighbour's corners: its apex, then the edge from and to. The cut takes `to`'s place in one half, `from`'s in
    // the other; what is known of the corners stays with them.
    const glm::uvec3 n = mesh_.triangles[other];
    int apex = 0;
    while (n[apex] == flat.a || n[apex] == flat.c) ++apex;
    const int from = (apex + 1) % 3, to = (apex + 2) % 3;
    copyTriangle(other, flat.triangle);
    placeCut(other, to, flat.b);
    placeCut(flat.triangle, from, flat.b);
    addUses(flat.triangle);
    addUses(other);
    return true;
  }

  void copyTriangle(std::size_t source, std::size_t target) {
    mesh_.triangles[target] = mesh_.triangles[source];
    if (!mesh_.sourceFaces.empty()) mesh_.sourceFaces[target] = mesh_.sourceFaces[source];
    if (!mesh_.sourceCorners.empty()) mesh_.sourceCorners[target] = mesh_.sourceCorners[source];
    if (!mesh_.turned.empty()) mesh_.turned[target] = mesh_.turned[source];
    if (!mesh_.smoothingGroups.empty()) mesh_.smoothingGroups[target] = mesh_.smoothingGroups[source];
    for (std::size_t k = 0; k < 3 && !mesh_.cornerNormals.empty(); ++k)
      mesh_.cornerNormals[3 * target + k] = mesh_.cornerNormals[3 * source + k];
  }
  void placeCut(std::size_t triangle, int corner, std::uint32_t vertex) {
    mesh_.triangles[triangle][corner] = vertex;
    if (!mesh_.sourceCorners.empty()) mesh_.sourceCorners[triangle][corner] = sourceVertex(mesh_, vertex);
    if (!mesh_.cornerNormals.empty())
      mesh_.cornerNormals[3 * triangle + static_cast<std::size_t>(corner)] = glm::vec3(0);
  }

  Mesh& mesh_;
  DegenerateFaces& result_;
  std::vector<char> ofFlats_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> uses_;
};

}  // namespace

bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Scaled first: squares of very small or large edges leave the range of double.
  const double scale = std::max({largest(b - a), largest(c - b), largest(a - c)});
  if (scale == 0) return true;
  const glm::dvec3 u = (b - a) / scale, v = (c - a) / scale;
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  return glm::length(glm::cross(u, v)) <= kAreaTolerance * longest * longest;
}

DegenerateFaces dropDegenerateFaces(Mesh& mesh) {
  DegenerateFaces result;

  // Step 1: corners that are the same vertex, or as good as.
  keepTriangles(mesh, [&](std::size_t i) {
    if (!repeatsCorner(mesh.triangles[i])) return true;
    result.repeatedCorner.add([&] { return findingAt(mesh, mesh.positions[mesh.triangles[i].x], {i}); });
    return false;
  });
  for (int round = 0; round < kRounds && collapseShortEdges(mesh, result); ++round) {
  }

  // Step 2: triangles without area hand their place to half of a neighbour.
  Cutter(mesh, result).run();

  // Step 3: those that are left go.
  keepTriangles(mesh, [&](std::size_t i) {
    if (hasArea(mesh, mesh.triangles[i])) return true;
    result.zeroArea.add([&] { return findingAt(mesh, centroid(mesh, i), {i}); });
    return false;
  });
  return result;
}

}  // namespace malus::prep

#include "meshprep/clean/orient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <oneapi/tbb/parallel_invoke.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/outside_visibility.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/shell_nesting.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxVisibilityTests = 256;  // some milliseconds each
constexpr double kClearDifference = 0.05;         // of visible shares: about twice the error of the sampling
constexpr double kVolumeTolerance = 1e-12;  // relative to area times diagonal of the bounding box: rounding errors

// Neighbour through an edge of two triangles.
struct Link {
  std::uint32_t triangle = kNone;
  bool agrees = false;  // they traverse the edge in opposite directions
};

struct Part {
  std::vector<std::uint32_t> triangles;
  bool orientable = true;
  bool closed = true;
  bool hasVolume = false;  // closed, orientable, and encloses a volume
  bool isNestedOutward = false;
  std::optional<double> signedVolume;  // of the triangles after flipping, if known
};

class Orienter {
 public:
  Orienter(Mesh& mesh, bool openSurface, std::span<const EdgeUse> uses)
      : mesh_(mesh), openSurface_(openSurface), uses_(uses) {}

  OrientResult run() {
    linkTriangles();
    findParts();
    findClosed();
    followMajority();
    if (!openSurface_) orientOutward();
    keepDoubled();
    return finish();
  }

 private:
  void linkTriangles() {
    links_.resize(mesh_.triangles.size());
    forEachEdge(uses_, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 1) ++result_.boundaryEdges;
      if (edge.size() > 2) ++result_.nonManifoldEdges;
      if (edge.size() != 2) return;
      const bool agrees = edge[0].forward != edge[1].forward;
      links_[edge[0].triangle][edge[0].corner] = {edge[1].triangle, agrees};
      links_[edge[1].triangle][edge[1].corner] = {edge[0].triangle, agrees};
    });
  }

  // Traverses components and flips triangles that disagree with their predecessor.
  void findParts() {
    part_.assign(mesh_.triangles.size(), kNone);
    flipped_.assign(mesh_.triangles.size(), 0);
    for (std::uint32_t first = 0; first < part_.size(); ++first) {
      if (part_[first] != kNone) continue;
      const auto id = static_cast<std::uint32_t>(parts_.size());
      Part part;
      part.triangles.push_back(first);
      part_[first] = id;
      for (std::size_t next = 0; next < part.triangles.size(); ++next) {
        const std::uint32_t here = part.triangles[next];
        for (const Link& link : links_[here]) {
          if (link.triangle == kNone) continue;
          const char flip = static_cast<char>(link.agrees ? flipped_[here] : 1 - flipped_[here]);
          if (part_[link.triangle] == kNone) {
            part_[link.triangle] = id;
            flipped_[link.triangle] = flip;
            part.triangles.push_back(link.triangle);
          } else if (flipped_[link.triangle] != flip) {
            part.orientable = false;
          }
        }
      }
      parts_.push_back(std::move(part));
    }
  }

  // Marks a part with these uses of an edge as open, unless they traverse it equally often in both directions.
  static void checkEdge(Part& part, std::size_t uses, int balance) {
    if (part.orientable ? balance != 0 : uses % 2 != 0) part.closed = false;
  }

  // Finds closed parts: each edge is traversed equally often in both directions. They have no boundary even if they
  // touch themselves or other parts at an edge.
  void findClosed() {
    const auto direction = [&](const EdgeUse& use) { return use.forward != (flipped_[use.triangle] != 0) ? 1 : -1; };
    std::vector<std::pair<std::uint32_t, int>> directions;  // per use: part, and 1 or -1
    forEachEdge(uses_, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2 && part_[edge[0].triangle] == part_[edge[1].triangle])  // most edges
        return checkEdge(parts_[part_[edge[0].triangle]], 2, direction(edge[0]) + direction(edge[1]));
      directions.clear();
      for (const EdgeUse& use : edge) directions.emplace_back(part_[use.triangle], direction(use));
      std::sort(directions.begin(), directions.end());
      for (std::size_t begin = 0, end = 0; begin < directions.size(); begin = end) {
        int balance = 0;
        for (; end < directions.size() && directions[end].first == directions[begin].first; ++end)
          balance += directions[end].second;
        checkEdge(parts_[directions[begin].first], end - begin, balance);
      }
    });
  }

  void flipPart(Part& part) {
    for (const std::uint32_t t : part.triangles) flipped_[t] = static_cast<char>(1 - flipped_[t]);
    if (part.signedVolume) part.signedVolume = 0 - *part.signedVolume;
  }

  void followMajority() {
    std::vector<Part*> contradictory;
    for (Part& part : parts_) {
      if (!part.orientable) {
        for (const std::uint32_t t : part.triangles) flipped_[t] = 0;
        continue;
      }
      const auto flips = static_cast<std::size_t>(std::count_if(part.triangles.begin(), part.triangles.end(),
                                                                [&](std::uint32_t t) { return flipped_[t] != 0; }));
      if (2 * flips > part.triangles.size()) flipPart(part);
      if (!part.closed && flips > 0 && flips < part.triangles.size()) contradictory.push_back(&part);
    }
    if (!openSurface_) orientByVisibility(std::move(contradictory));
  }

  // Decides open components whose faces contradict each other by their visibility from outside, the largest first.
  void orientByVisibility(std::vector<Part*> parts) {
    if (parts.empty()) return;
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part* a, const Part* b) { return a->triangles.size() > b->triangles.size(); });
    const OutsideVisibility visibility(mesh_);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const VisibleShares visible =
          i < kMaxVisibilityTests ? visibility.sample(parts[i]->triangles, flipped_) : VisibleShares{};
      if (visible.back > visible.front + kClearDifference) flipPart(*parts[i]);
      const bool clear = std::abs(visible.front - visible.back) > kClearDifference;
      ++(clear ? result_.orientedByVisibility : result_.orientedByMajority);
    }
  }

  // Returns the triangle after flipping.
  glm::uvec3 triangle(std::uint32_t t) const {
    const glm::uvec3 v = mesh_.triangles[t];
    return flipped_[t] != 0 ? glm::uvec3(v.x, v.z, v.y) : v;
  }

  // Uses the part's first corner as origin, because tetrahedra to a far origin cancel.
  double signedVolume(const Part& part) const {
    const glm::dvec3 origin = mesh_.positions[triangle(part.triangles.front()).x];
    double volume = 0;
    for (const std::uint32_t t : part.triangles) {
      const glm::uvec3 v = triangle(t);
      const glm::dvec3 a = mesh_.positions[v.x] - origin, b = mesh_.positions[v.y] - origin,
                       c = mesh_.positions[v.z] - origin;
      volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
  }

  // Returns the largest volume that may be a rounding error.
  double volumeTolerance(const Part& part) const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    double area = 0;
    for (const std::uint32_t t : part.triangles) {
      const glm::uvec3 v = mesh_.triangles[t];
      const glm::dvec3 &a = mesh_.positions[v.x], &b = mesh_.positions[v.y], &c = mesh_.positions[v.z];
      low = glm::min(low, glm::min(a, glm::min(b, c)));
      high = glm::max(high, glm::max(a, glm::max(b, c)));
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return kVolumeTolerance * area * glm::length(high - low);
  }

  void orientOutward() {
    // Collect the shells in the orientation of the majority.
    std::vector<Shell> shells;
    std::vector<std::size_t> shellPart;
    std::vector<double> volumes;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      if (!part.orientable || !part.closed) continue;
      double volume = 0, tolerance = 0;
      oneapi::tbb::parallel_invoke([&] { volume = signedVolume(part); }, [&] { tolerance = volumeTolerance(part); });
      part.signedVolume = volume;
      if (!(std::abs(volume) > tolerance)) {
        ++result_.withoutVolume;
        continue;
      }
      part.hasVolume = true;
      Shell shell;
      shell.volume = std::abs(volume);
      for (const std::uint32_t t : part.triangles) shell.triangles.push_back(triangle(t));
      shells.push_back(std::move(shell));
      shellPart.push_back(i);
      volumes.push_back(volume);
    }

    // Find their nesting.
    std::vector<Nesting> nesting(shells.size());
    if (shells.size() > kMaxShells || !nestShells(shells, mesh_.positions, nesting))
      result_.nestingUnchecked = shells.size();

    // Flip. The parent of a shell at odd depth is at even depth and decides for both.
    for (std::size_t i = 0; i < shells.size(); ++i) {
      const bool follows = nesting[i].depth % 2 == 1;
      if (follows) ++result_.nested;
      const double deciding = follows ? volumes[*nesting[i].parent] : volumes[i];
      if (deciding < 0) flipPart(parts_[shellPart[i]]);
      if (follows) parts_[shellPart[i]].isNestedOutward = volumes[i] * volumes[*nesting[i].parent] > 0;
    }
  }

  // Triangle by its sorted positions.
  struct Placed {
    std::array<std::uint32_t, 3> ids;
    std::uint32_t triangle;
    bool even;  // orientation in the mesh: smallest, middle, largest id
  };

  // Returns the triangles that have the positions of another one, together.
  std::vector<Placed> findCoincident() const {
    const std::vector<std::uint32_t> position = positionIds(mesh_);
    std::vector<Placed> placed;
    placed.reserve(mesh_.triangles.size());
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const glm::uvec3& t = mesh_.triangles[i];
      const std::array<std::uint32_t, 3> ids = {position[t.x], position[t.y], position[t.z]};
      Placed p{ids, i, false};
      std::sort(p.ids.begin(), p.ids.end());
      for (std::size_t k = 0; k < 3; ++k)
        p.even = p.even || (ids[k] == p.ids[0] && ids[(k + 1) % 3] == p.ids[1] && ids[(k + 2) % 3] == p.ids[2]);
      placed.push_back(p);
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
      return a.ids != b.ids ? a.ids < b.ids : a.triangle < b.triangle;
    });
    std::vector<Placed> coincident;
    for (std::size_t i = 0; i < placed.size(); ++i)
      if ((i > 0 && placed[i - 1].ids == placed[i].ids) ||
          (i + 1 < placed.size() && placed[i + 1].ids == placed[i].ids))
        coincident.push_back(placed[i]);
    return coincident;
  }

  // Keeps the orientation of parts if flipping them would make a triangle equal to one that is back to back with it:
  // the two sides of a doubled surface would be duplicates.
  void keepDoubled() {
    if (std::find(flipped_.begin(), flipped_.end(), 1) == flipped_.end()) return;
    const std::vector<Placed> coincident = findCoincident();
    for (bool again = true; again;) {
      again = false;
      for (std::size_t begin = 0, end = 0; begin < coincident.size(); begin = end) {
        std::array<std::array<bool, 2>, 2> seen{};  // by orientation after and before flipping
        const auto isEvenAfter = [&](const Placed& p) { return p.even != (flipped_[p.triangle] != 0); };
        for (; end < coincident.size() && coincident[end].ids == coincident[begin].ids; ++end)
          seen[isEvenAfter(coincident[end]) ? 1 : 0][coincident[end].even ? 1 : 0] = true;
        for (std::size_t i = begin; i < end; ++i) {
          const auto& sameAfter = seen[isEvenAfter(coincident[i]) ? 1 : 0];
          if (flipped_[coincident[i].triangle] == 0 || !sameAfter[0] || !sameAfter[1]) continue;
          Part& part = parts_[part_[coincident[i].triangle]];
          for (const std::uint32_t t : part.triangles) flipped_[t] = 0;
          part.signedVolume.reset();
          ++result_.keptDoubled;
          again = true;
          break;  // the others of this position are compared in the next round
        }
      }
    }
  }

  OrientResult finish() {
    for (const Part& part : parts_) {
      Component component;
      component.triangles = part.triangles.size();
      component.closed = part.closed;
      component.orientable = part.orientable;
      component.hasVolume = part.hasVolume;
      component.isNestedOutward = part.isNestedOutward;
      component.at = mesh_.positions[mesh_.triangles[part.triangles.front()].x];
      component.firstFace = sourceFace(mesh_, part.triangles.front());
      for (const std::uint32_t t : part.triangles) component.flipped += flipped_[t] != 0 ? 1u : 0u;
      if (part.closed && part.orientable)
        component.signedVolume = part.signedVolume ? *part.signedVolume : signedVolume(part);
      result_.notOrientable += part.orientable ? 0u : 1u;
      result_.components.push_back(component);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (flipped_[t] == 0) continue;
      result_.flipped.add([&] { return findingAt(mesh_, centroid(mesh_, t), {t}); });
      flipTriangle(mesh_, t);
    }
    result_.componentOf = std::move(part_);
    return std::move(result_);
  }

  Mesh& mesh_;
  bool openSurface_;
  std::span<const EdgeUse> uses_;
  std::vector<std::array<Link, 3>> links_;
  std::vector<std::uint32_t> part_;
  std::vector<char> flipped_;  // 1: the triangle is to be flipped
  std::vector<Part> parts_;
  OrientResult result_;
};

}  // namespace

OrientResult orient(Mesh& mesh, bool openSurface, std::span<const EdgeUse> edges) {
  return Orienter(mesh, openSurface, edges).run();
}

OrientResult orient(Mesh& mesh, bool openSurface) { return orient(mesh, openSurface, edgeUses(mesh.triangles)); }

}  // namespace malus::prep

#include "meshprep/clean/orient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/shell_nesting.h"

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kVolumeTolerance = 1e-12;  // of the area times the box's diagonal: rounding, no side to tell by

// A neighbour through an edge of two triangles.
struct Link {
  std::uint32_t triangle = kNone;
  bool agrees = false;  // both run along the edge in opposite ways, as neighbours should
};

struct Part {
  std::vector<std::uint32_t> triangles;
  bool orientable = true;
  bool closed = true;
  bool hasVolume = false;  // closed, orientable, and with an inside
};

class Orienter {
 public:
  Orienter(Mesh& mesh, bool sheet) : mesh_(mesh), sheet_(sheet), uses_(edgeUses(mesh.triangles)) {}

  OrientResult run() {
    linkTriangles();
    findParts();
    findClosed();
    takeMajority();
    if (!sheet_) turnOutward();
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

  // Walks from triangle to triangle, turning those that do not agree with where the walk came from.
  void findParts() {
    partOf_.assign(mesh_.triangles.size(), kNone);
    turned_.assign(mesh_.triangles.size(), 0);
    for (std::uint32_t first = 0; first < partOf_.size(); ++first) {
      if (partOf_[first] != kNone) continue;
      const auto id = static_cast<std::uint32_t>(parts_.size());
      Part part;
      part.triangles.push_back(first);
      partOf_[first] = id;
      for (std::size_t next = 0; next < part.triangles.size(); ++next) {
        const std::uint32_t here = part.triangles[next];
        for (const Link& link : links_[here]) {
          if (link.triangle == kNone) continue;
          const char turn = static_cast<char>(link.agrees ? turned_[here] : 1 - turned_[here]);
          if (partOf_[link.triangle] == kNone) {
            partOf_[link.triangle] = id;
            turned_[link.triangle] = turn;
            part.triangles.push_back(link.triangle);
          } else if (turned_[link.triangle] != turn) {
            part.orientable = false;
          }
        }
      }
      parts_.push_back(std::move(part));
    }
  }

  // A part is closed where each edge is run along as often one way as the other: it has no boundary, even
  // where it touches itself or other parts along an edge.
  void findClosed() {
    forEachEdge(uses_, [&](std::span<const EdgeUse> edge) {
      std::vector<std::pair<std::uint32_t, int>> ways;  // of each use: part, and 1 or -1 as it runs
      for (const EdgeUse& use : edge)
        ways.emplace_back(partOf_[use.triangle], use.forward != (turned_[use.triangle] != 0) ? 1 : -1);
      std::sort(ways.begin(), ways.end());
      for (std::size_t begin = 0, end = 0; begin < ways.size(); begin = end) {
        int balance = 0;
        for (; end < ways.size() && ways[end].first == ways[begin].first; ++end) balance += ways[end].second;
        Part& part = parts_[ways[begin].first];
        if (part.orientable ? balance != 0 : (end - begin) % 2 != 0) part.closed = false;
      }
    });
  }

  void turnWhole(const Part& part) {
    for (const std::uint32_t t : part.triangles) turned_[t] = static_cast<char>(1 - turned_[t]);
  }

  void takeMajority() {
    for (const Part& part : parts_) {
      if (!part.orientable) {
        for (const std::uint32_t t : part.triangles) turned_[t] = 0;
        continue;
      }
      const auto turns = static_cast<std::size_t>(std::count_if(part.triangles.begin(), part.triangles.end(),
                                                                [&](std::uint32_t t) { return turned_[t] != 0; }));
      if (2 * turns > part.triangles.size()) turnWhole(part);
    }
  }

  // The triangle as it will be.
  glm::uvec3 triangle(std::uint32_t t) const {
    const glm::uvec3 v = mesh_.triangles[t];
    return turned_[t] != 0 ? glm::uvec3(v.x, v.z, v.y) : v;
  }

  // About the part's own first corner: far from the origin, tetrahedra to the origin would cancel badly.
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

  bool hasVolume(const Part& part, double volume) const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    double area = 0;
    for (const std::uint32_t t : part.triangles) {
      const glm::uvec3 v = mesh_.triangles[t];
      const glm::dvec3 &a = mesh_.positions[v.x], &b = mesh_.positions[v.y], &c = mesh_.positions[v.z];
      low = glm::min(low, glm::min(a, glm::min(b, c)));
      high = glm::max(high, glm::max(a, glm::max(b, c)));
      area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return std::abs(volume) > kVolumeTolerance * area * glm::length(high - low);
  }

  void turnOutward() {
    // Step 1: the shells, in the orientation that the majority gave them.
    std::vector<Shell> shells;
    std::vector<std::size_t> partOfShell;
    std::vector<double> volumes;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      if (!part.orientable || !part.closed) continue;
      const double volume = signedVolume(part);
      if (!hasVolume(part, volume)) {
        ++result_.withoutVolume;
        continue;
      }
      part.hasVolume = true;
      Shell shell;
      shell.volume = std::abs(volume);
      for (const std::uint32_t t : part.triangles) shell.triangles.push_back(triangle(t));
      shells.push_back(std::move(shell));
      partOfShell.push_back(i);
      volumes.push_back(volume);
    }

    // Step 2: what lies inside what.
    std::vector<Nesting> nesting(shells.size());
    if (shells.size() > kMaxShells || !nestShells(shells, mesh_.positions, nesting))
      result_.nestingUnchecked = shells.size();

    // Step 3: turn. A parent is at an even depth where its child is at an odd one, so it decides alone.
    for (std::size_t i = 0; i < shells.size(); ++i) {
      const bool follows = nesting[i].depth % 2 == 1;
      if (follows) ++result_.nested;
      const double deciding = follows ? volumes[*nesting[i].parent] : volumes[i];
      if (deciding < 0) turnWhole(parts_[partOfShell[i]]);
    }
  }

  OrientResult finish() {
    for (const Part& part : parts_) {
      Component component;
      component.triangles = part.triangles.size();
      component.closed = part.closed;
      component.orientable = part.orientable;
      component.hasVolume = part.hasVolume;
      component.at = mesh_.positions[mesh_.triangles[part.triangles.front()].x];
      component.firstFace = sourceFace(mesh_, part.triangles.front());
      for (const std::uint32_t t : part.triangles) component.flipped += turned_[t] != 0 ? 1u : 0u;
      if (part.closed && part.orientable) component.signedVolume = signedVolume(part);
      result_.notOrientable += part.orientable ? 0u : 1u;
      result_.components.push_back(component);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (turned_[t] == 0) continue;
      result_.flipped.add([&] { return findingAt(mesh_, centroid(mesh_, t), {t}); });
      turnOver(mesh_, t);
    }
    result_.componentOf = std::move(partOf_);
    return std::move(result_);
  }

  Mesh& mesh_;
  bool sheet_;
  std::vector<EdgeUse> uses_;
  std::vector<std::array<Link, 3>> links_;
  std::vector<std::uint32_t> partOf_;
  std::vector<char> turned_;  // 1 where the triangle is to be turned over
  std::vector<Part> parts_;
  OrientResult result_;
};

}  // namespace

OrientResult orient(Mesh& mesh, bool sheet) { return Orienter(mesh, sheet).run(); }

}  // namespace malus::prep

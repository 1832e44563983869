#include "meshprep/simplify/surface_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "meshprep/normals/piece_normals.h"

namespace malus::prep {

namespace {

constexpr double kRelativeTolerance = 0.01;
constexpr std::size_t kMinSubdivisions = 1'000'000;
constexpr std::size_t kSubdivisionsPerTriangle = 64;
constexpr double kLargePiece = 4;  // times as long as a triangle of the other surface: halved, not cut along it

struct Corner {
  glm::dvec3 position;
  Surface::Nearest nearest;
};
using Piece = std::array<Corner, 3>;

// Distance from a plane through the edge from corner `edge` on, perpendicular to the triangle; positive inside.
struct EdgePlane {
  glm::dvec3 origin, inward;
  double operator()(const glm::dvec3& p) const { return glm::dot(p - origin, inward); }
};

EdgePlane edgePlane(const TriangleCorners& t, std::size_t edge) {
  const glm::dvec3 &a = t[edge], &b = t[(edge + 1) % 3], &c = t[(edge + 2) % 3];
  const glm::dvec3 inward = glm::cross(glm::cross(b - a, c - a), b - a);
  const double length = glm::length(inward);
  return {a, length > 0 ? inward / length : glm::dvec3(0)};
}

double longestEdge(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}
double longestEdge(const Piece& p) { return longestEdge(p[0].position, p[1].position, p[2].position); }

class DistanceBound {
 public:
  DistanceBound(const Mesh& from, const Surface& to, double tolerance) : from_(from), to_(to), tolerance_(tolerance) {}

  double run() {
    // The distances of the vertices are lower bounds.
    std::vector<Surface::Nearest> nearest(from_.positions.size());
    std::vector<char> isUsed(from_.positions.size(), 0);
    for (const glm::uvec3& t : from_.triangles)
      for (int k = 0; k < 3; ++k) isUsed[t[k]] = 1;
    for (std::size_t i = 0; i < nearest.size(); ++i)
      if (isUsed[i] != 0) nearest[i] = query(from_.positions[i]).nearest;

    // Subdivide triangles whose upper bound is too large.
    subdivisionsLeft_ = std::max(kMinSubdivisions, kSubdivisionsPerTriangle * from_.triangles.size());
    for (const glm::uvec3& t : from_.triangles) {
      pieces_.push_back({Corner{from_.positions[t.x], nearest[t.x]}, Corner{from_.positions[t.y], nearest[t.y]},
                         Corner{from_.positions[t.z], nearest[t.z]}});
      while (!pieces_.empty()) {
        const Piece piece = pieces_.back();
        pieces_.pop_back();
        process(piece);
      }
    }
    return std::max(lower_, upper_);
  }

 private:
  Corner query(const glm::dvec3& position) {
    const Surface::Nearest nearest = to_.nearest(position);
    lower_ = std::max(lower_, nearest.distance);
    return {position, nearest};
  }

  bool isTight(double upper) const { return upper <= (1 + kRelativeTolerance) * lower_ + tolerance_; }

  // The distance to one triangle is convex: over the piece, its maximum is at a corner.
  double boundBy(const Piece& piece, std::uint32_t triangle) const {
    double upper = 0;
    for (const Corner& corner : piece)
      upper = std::max(upper, distanceToTriangle(corner.position, to_.triangle(triangle)));
    return upper;
  }

  void process(const Piece& piece) {
    // Bound the piece by one triangle of the other surface.
    double upper = std::min({boundBy(piece, piece[0].nearest.triangle), boundBy(piece, piece[1].nearest.triangle),
                             boundBy(piece, piece[2].nearest.triangle)});
    Corner centre{};
    if (!isTight(upper)) {
      centre = query((piece[0].position + piece[1].position + piece[2].position) / 3.0);
      upper = std::min(upper, boundBy(piece, centre.nearest.triangle));
    }

    // Every point of a triangle is within 1 / sqrt(3) of its longest edge from a corner.
    const double longest = longestEdge(piece);
    upper =
        std::min(upper, std::max({piece[0].nearest.distance, piece[1].nearest.distance, piece[2].nearest.distance}) +
                            longest / std::numbers::sqrt3);
    if (isTight(upper) || subdivisionsLeft_ == 0) {
      upper_ = std::max(upper_, upper);
      return;
    }
    --subdivisionsLeft_;
    if (!cutAlong(piece, centre.nearest.triangle, longest)) halve(piece, longest);
  }

  // Cuts the piece along an edge of a triangle of the other surface.
  bool cutAlong(const Piece& piece, std::uint32_t triangle, double longest) {
    const TriangleCorners& t = to_.triangle(triangle);
    if (longest > kLargePiece * longestEdge(t[0], t[1], t[2])) return false;
    std::size_t bestEdge = 3;
    double best = 1e-6 * longest;  // thinner slices are not worth a cut
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const EdgePlane plane = edgePlane(t, edge);
      const std::array<double, 3> d = {plane(piece[0].position), plane(piece[1].position), plane(piece[2].position)};
      const double balance = std::min(*std::max_element(d.begin(), d.end()), -*std::min_element(d.begin(), d.end()));
      if (balance > best) best = balance, bestEdge = edge;
    }
    if (bestEdge == 3) return false;

    // One corner is alone on its side of the plane.
    const EdgePlane plane = edgePlane(t, bestEdge);
    std::array<double, 3> d{};
    for (std::size_t i = 0; i < 3; ++i) d[i] = plane(piece[i].position);
    std::size_t alone = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if ((d[i] > 0) != (d[(i + 1) % 3] > 0) && (d[i] > 0) != (d[(i + 2) % 3] > 0)) alone = i;
    const Corner &a = piece[alone], &b = piece[(alone + 1) % 3], &c = piece[(alone + 2) % 3];
    const double da = d[alone], db = d[(alone + 1) % 3], dc = d[(alone + 2) % 3];
    const Corner ab = query(a.position + da / (da - db) * (b.position - a.position));
    const Corner ac = query(a.position + da / (da - dc) * (c.position - a.position));
    pieces_.push_back({a, ab, ac});
    pieces_.push_back({ab, b, c});
    pieces_.push_back({ab, c, ac});
    return true;
  }

  // Bisects the longest edge.
  void halve(const Piece& piece, double longest) {
    std::size_t edge = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (glm::distance(piece[i].position, piece[(i + 1) % 3].position) == longest) edge = i;
    const Corner &a = piece[edge], &b = piece[(edge + 1) % 3], &c = piece[(edge + 2) % 3];
    const Corner middle = query((a.position + b.position) / 2.0);
    pieces_.push_back({a, middle, c});
    pieces_.push_back({middle, b, c});
  }

  const Mesh& from_;
  const Surface& to_;
  double tolerance_;
  double lower_ = 0, upper_ = 0;
  std::size_t subdivisionsLeft_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace

double maxDistance(const Mesh& from, const Surface& to, double tolerance) {
  return DistanceBound(from, to, tolerance).run();
}

double maxNormalDeviation(const Mesh& from, const Surface& to, double reach) {
  const auto normal = [](const TriangleCorners& t) { return faceNormal(t[0], t[1], t[2]); };
  double smallestCosine = 1;
  for (const glm::uvec3& t : from.triangles) {
    const TriangleCorners corners = {from.positions[t.x], from.positions[t.y], from.positions[t.z]};
    const glm::dvec3 own = normal(corners);
    if (own == glm::dvec3(0)) continue;
    const glm::dvec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Surface::Nearest nearest = to.nearest(centre);
    double cosine = glm::dot(own, normal(to.triangle(nearest.triangle)));
    if (cosine < smallestCosine)
      to.forEachWithin(centre, std::max(reach, nearest.distance), [&](std::uint32_t other) {
        cosine = std::max(cosine, glm::dot(own, normal(to.triangle(other))));
      });
    smallestCosine = std::min(smallestCosine, cosine);
  }
  return glm::degrees(std::acos(std::clamp(smallestCosine, -1.0, 1.0)));
}

}  // namespace malus::prep

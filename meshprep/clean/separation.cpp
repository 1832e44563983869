#include "meshprep/clean/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;  // relative error of a rounded operation

inline double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Vector with bounds: of its components, and of their absolute errors.
struct Bounded {
  glm::dvec3 v;
  double size, error;
};

// Difference of two points.
inline Bounded difference(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 v = a - b;
  const double size = largest(v);
  return {v, size, 2 * kUnit * size};
}

// Differences of two points, each of which may move by at most a distance.
class Differences {
 public:
  explicit Differences(double distance) : distance_(distance) {}
  Bounded operator()(const glm::dvec3& a, const glm::dvec3& b) const {
    Bounded result = difference(a, b);
    if (distance_ == 0) return result;
    result.error += 2 * distance_;
    result.size += result.error;  // products of errors count, too
    return result;
  }

 private:
  double distance_;
};

// Each component is a difference of two products.
inline Bounded cross(const Bounded& a, const Bounded& b) {
  const double product = a.size * b.size;
  return {glm::cross(a.v, b.v), 2 * product, 2 * (a.error * b.size + b.error * a.size) + 6 * kUnit * product};
}

// Value of a scalar product, and a bound of its error.
struct Projection {
  double value, error;
  bool isPositive() const { return value > error; }
  bool isNegative() const { return value < -error; }
};

inline Projection dot(const Bounded& a, const Bounded& b) {
  return {glm::dot(a.v, b.v), 4 * (a.error * b.size + b.error * a.size) + 12 * kUnit * a.size * b.size};
}

bool haveOneSign(const Projection& a, const Projection& b) {
  return (a.isPositive() && b.isPositive()) || (a.isNegative() && b.isNegative());
}

// Returns true if the projections of two triangles on the axis are separate. Points are relative to one origin.
bool separates(const Bounded& axis, const std::array<Bounded, 3>& a, const std::array<Bounded, 3>& b) {
  double lowA = std::numeric_limits<double>::infinity(), lowB = lowA, highA = -lowA, highB = -lowA;
  for (std::size_t i = 0; i < 3; ++i) {
    const Projection p = dot(axis, a[i]), q = dot(axis, b[i]);
    lowA = std::min(lowA, p.value - p.error);
    highA = std::max(highA, p.value + p.error);
    lowB = std::min(lowB, q.value - q.error);
    highB = std::max(highB, q.value + q.error);
  }
  return highA < lowB || highB < lowA;
}

}  // namespace

bool certainlyHasArea(const TriangleCorners& a) {
  const Bounded normal = cross(difference(a[1], a[0]), difference(a[2], a[0]));
  return largest(normal.v) > normal.error;
}

bool areSeparate(const TriangleCorners& a, const TriangleCorners& b, double distance) {
  const Differences subtract(distance);
  const glm::dvec3& origin = a[0];
  const std::array<Bounded, 3> p = {Bounded{glm::dvec3(0), 0, 0}, subtract(a[1], origin), subtract(a[2], origin)};
  const std::array<Bounded, 3> q = {subtract(b[0], origin), subtract(b[1], origin), subtract(b[2], origin)};
  const std::array<Bounded, 3> edgesA = {p[1], subtract(a[2], a[1]), p[2]};
  const std::array<Bounded, 3> edgesB = {subtract(b[1], b[0]), subtract(b[2], b[1]), subtract(b[2], b[0])};

  // Try the planes of the triangles, then planes along an edge that are perpendicular to these.
  const Bounded normalA = cross(edgesA[0], edgesA[2]), normalB = cross(edgesB[0], edgesB[2]);
  if (separates(normalA, p, q) || separates(normalB, p, q)) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (separates(cross(normalA, edgesA[i]), p, q) || separates(cross(normalB, edgesB[i]), p, q)) return true;

  // Try planes along an edge of each.
  for (const Bounded& edgeA : edgesA)
    for (const Bounded& edgeB : edgesB)
      if (separates(cross(edgeA, edgeB), p, q)) return true;
  return false;
}

bool areSeparateBesideCorner(const TriangleCorners& a, const TriangleCorners& b, double distance) {
  const Differences subtract(distance);
  const std::array<Bounded, 2> p = {subtract(a[1], a[0]), subtract(a[2], a[0])};
  const std::array<Bounded, 2> q = {subtract(b[1], b[0]), subtract(b[2], b[0])};

  // The other triangle is on one side of a triangle's plane.
  const Bounded normalA = cross(p[0], p[1]), normalB = cross(q[0], q[1]);
  if (haveOneSign(dot(normalA, q[0]), dot(normalA, q[1])) || haveOneSign(dot(normalB, p[0]), dot(normalB, p[1])))
    return true;

  // It is beyond a plane along an edge, perpendicular to this one. (n x p0) . p1 is n^2, (n x p1) . p0 is -n^2.
  const auto isBeyond = [](const Bounded& normal, const std::array<Bounded, 2>& own,
                           const std::array<Bounded, 2>& other) {
    const Bounded first = cross(normal, own[0]), second = cross(normal, own[1]);
    return (dot(first, other[0]).isNegative() && dot(first, other[1]).isNegative()) ||
           (dot(second, other[0]).isPositive() && dot(second, other[1]).isPositive());
  };
  if (isBeyond(normalA, p, q) || isBeyond(normalB, q, p)) return true;

  // They are on different sides of a plane along an edge of each.
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const Bounded normal = cross(p[i], q[j]);
      const Projection ofA = dot(normal, p[1 - i]), ofB = dot(normal, q[1 - j]);
      if ((ofA.isPositive() && ofB.isNegative()) || (ofA.isNegative() && ofB.isPositive())) return true;
    }
  return false;
}

bool areSeparateBesideEdge(const TriangleCorners& a, const TriangleCorners& b, double distance) {
  const Differences subtract(distance);
  // They touch beside the edge only if they are coplanar and on the same side of it.
  const Bounded edge = subtract(a[1], a[0]), p = subtract(a[2], a[0]), q = subtract(b[2], b[0]);
  const Bounded normalA = cross(edge, p), normalB = cross(edge, q);
  const Projection height = dot(normalA, q);
  return height.isPositive() || height.isNegative() || dot(normalA, normalB).isNegative();
}

}  // namespace malus::prep

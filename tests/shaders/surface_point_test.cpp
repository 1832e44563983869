// Shading normals, and origins that no longer touch the face they leave.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_OPTICS_SUITE(SurfacePointTest);

TYPED_TEST(SurfacePointTest, NormalsFaceTheRay) {
  MALUS_TYPES;
  const real3 g = O::make3(0, 0, 1), n = O::make3(R(0.1L), 0, 1);
  const real3 front = O::shadingNormal(O::make3(R(0.6L), 0, R(-0.8L)), g, n);
  EXPECT_GT(front.z, 0);
  const real3 back = O::shadingNormal(O::make3(R(0.6L), 0, R(0.8L)), g, n);
  EXPECT_LT(back.z, 0);
  EXPECT_CLOSE(front.x / front.z, 0.1L, 2 * kEps);
  EXPECT_CLOSE(back.x / back.z, 0.1L, 2 * kEps);
}

TYPED_TEST(SurfacePointTest, GeometricNormalReplacesUnusableNormal) {
  MALUS_TYPES;
  const real3 g = O::make3(0, 0, 1);
  // Facing away from the ray.
  EXPECT_EQ(O::shadingNormal(O::make3(R(0.995L), 0, R(-0.0999L)), g, O::make3(1, 0, R(0.5L))), g);
  // Sending the mirror direction below the face.
  EXPECT_EQ(O::shadingNormal(O::make3(R(0.8L), 0, R(-0.6L)), g, O::make3(-1, 0, R(0.2L))), g);
  // Grazing: the geometric normal always sends the ray upward.
  EXPECT_EQ(O::shadingNormal(O::make3(1, 0, 0), g, g).x, 0);
}

TYPED_TEST(SurfacePointTest, ReflectionStaysAboveTheFace) {
  MALUS_TYPES;
  Draw draw(13);
  for (int i = 0; i < 5000; ++i) {
    const real3 d = toReal3<O>(draw.direction()), g = toReal3<O>(draw.direction());
    const Vec bend = draw.direction();
    const real3 n = O::shadingNormal(d, g, O::normalize3(g + toReal3<O>(oracle::along(bend, 0.8L, bend, 0))));
    const Real c = -oracle::dot(toVec(d), toVec(n));
    EXPECT_GE(c, 0);
    const Vec mirror = oracle::along(toVec(d), 1, toVec(n), 2 * c);
    const Real side = oracle::dot(toVec(d), toVec(g)) < 0 ? 1 : -1;
    EXPECT_GE(side * oracle::dot(mirror, toVec(g)), -4 * kEps);
    EXPECT_CLOSE(oracle::dot(toVec(n), toVec(n)), 1, 4 * kEps);
  }
}

TYPED_TEST(SurfacePointTest, ErrorBoundContainsTheTrueError) {
  MALUS_TYPES;
  Draw draw(14);
  for (int i = 0; i < 5000; ++i) {
    const Real size = std::pow(10.0L, draw.between(-3, 4));
    const auto corner = [&] {
      const Vec v = draw.direction();
      return toReal3<O>(oracle::along(v, size, v, 0));
    };
    const real3 p0 = corner(), p1 = corner(), p2 = corner();
    const real b1 = R(draw.unit()), b2 = (1 - b1) * R(draw.unit());
    const real3 e1 = p1 - p0, e2 = p2 - p0;
    const real3 p = O::trianglePoint(p0, e1, e2, b1, b2);
    const real3 error = O::hitPointError(p0, e1, e2, b1, b2, kEps / 2);
    const Real b0 = 1 - Real(b1) - Real(b2);
    const Vec exact = oracle::along(oracle::along(toVec(p0), b0, toVec(p1), b1), 1, toVec(p2), b2);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LE(std::abs(toVec(p)[j] - exact[j]), toVec(error)[j]);
      EXPECT_LE(toVec(error)[j], 3 * size * 8 * kEps) << "bound is too large";
    }
  }
}

TYPED_TEST(SurfacePointTest, IntersectionErrorGrowsWithTheTriangle) {
  MALUS_TYPES;
  const auto errorAt = [&](Real s) {
    return O::intersectionError(O::make3(R(s), 0, 0), O::make3(0, R(s), 0), O::make3(0, 0, R(-2 * s)), O::splat3(0),
                                kEps / 2);
  };
  EXPECT_CLOSE(errorAt(1), 8 * kEps, 1e-3 * kEps);
  EXPECT_CLOSE(errorAt(1024), 1024 * 8 * kEps, kEps);
  // A far origin of the whole scene changes nothing but the differences' rounding.
  const real3 far = O::splat3(1000);
  EXPECT_CLOSE(O::intersectionError(far + O::make3(1, 0, 0), far, far, far, kEps / 2), 4 * kEps, 1e-3 * kEps);
}

TYPED_TEST(SurfacePointTest, OriginsAreOutsideTheErrorBox) {
  MALUS_TYPES;
  Draw draw(15);
  for (int i = 0; i < 5000; ++i) {
    const Vec at = draw.direction(), normal = draw.direction();
    const Real size = std::pow(10.0L, draw.between(-3, 4));
    const real3 p = toReal3<O>(oracle::along(at, size, at, 0)), n = toReal3<O>(normal);
    const real3 error = O::make3(R(size * 4 * kEps), R(size * 4 * kEps), R(size * 4 * kEps));
    const real3 o = O::rayOrigin(p, error, n, kEps / 2);
    // The corner of the box that reaches farthest along n stays below the origin.
    Real reach = 0, offset = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      reach += toVec(error)[j] * std::abs(toVec(n)[j]);
      offset += (toVec(o)[j] - toVec(p)[j]) * toVec(n)[j];
    }
    EXPECT_GE(offset, reach * (1 - 4 * Real(kEps)));
    EXPECT_LE(offset, 2 * reach + 4 * kEps * size) << "offset is too large";
  }
  // A point at 0 with no error stays.
  EXPECT_EQ(O::rayOrigin(O::splat3(0), O::splat3(0), O::make3(0, 0, 1), kEps), O::splat3(0));
}

TYPED_TEST(SurfacePointTest, StartsStayInsideAndOffTheEdges) {
  MALUS_TYPES;
  Draw draw(16);
  int roomy = 0;
  for (int i = 0; i < 6000; ++i) {
    // Any triangle, slivers and right ones among them; a point on an edge, at a corner, close to one, or anywhere.
    real3 p0 = toReal3<O>(draw.direction()), p1 = toReal3<O>(draw.direction()), p2 = toReal3<O>(draw.direction());
    if (i % 4 == 0) p2 = p0 + (p1 - p0) * R(0.5L) + (p2 - p0) * R(1e-3L);
    if (i % 4 == 1) p0 = O::make3(0, 0, 0), p1 = O::make3(1, 0, 0), p2 = O::make3(0, 1, 0);
    const Real near = i % 3 == 0 ? 0 : i % 3 == 1 ? std::pow(10.0L, -draw.between(2, 9)) : draw.unit() / 2;
    const real b0 = R(near),
               b1 = R(i % 5 == 0   ? 0
                      : i % 5 == 1 ? 1 - near
                                   : (1 - near) * draw.unit()),
               b2 = std::max(real(0), 1 - b0 - b1);
    const real3 p = p0 * b0 + p1 * b1 + p2 * b2, across = O::cross3(p1 - p0, p2 - p0);
    const real margin = R(1e3L) * kEps;
    const real3 start = O::insideTriangle(p, p0, p1, p2, b0, b1, b2, across, margin);
    const Vec n = oracle::unit(toVec(across));
    EXPECT_CLOSE(oracle::dot(n, toVec(start - p)), 0, 60 * kEps) << "not in the plane";
    EXPECT_LE(std::sqrt(oracle::dot(toVec(start - p), toVec(start - p))), 30 * margin) << "too far";
    const auto distance = [&](const real3& a, const real3& b, const real3& at) {
      const Vec edge = toVec(b - a), inward = oracle::unit(oracle::cross(n, edge));
      return oracle::dot(inward, toVec(at - a));
    };
    Real before = 10, after = 10, sum = 0;
    for (const auto& [a, b] : {std::pair(p1, p2), {p2, p0}, {p0, p1}}) {
      before = std::min(before, distance(a, b, p));
      after = std::min(after, distance(a, b, start));
      sum += std::sqrt(oracle::dot(toVec(b - a), toVec(b - a)));
    }
    EXPECT_GE(after, std::min(before, Real(0)) - 8 * kEps) << "outside the triangle";
    if (before > 1.01L * margin) {
      EXPECT_EQ(start, p) << "moved far from edges";
    }
    // With a wide inscribed circle and no sharp corners, the start is off the edges.
    const Real radius = std::sqrt(oracle::dot(toVec(across), toVec(across))) / sum;
    if (radius > 0.1L) {
      ++roomy;
      EXPECT_GT(after, 0.9L * std::min(Real(margin), radius)) << i;
    }
  }
  EXPECT_GT(roomy, 2000);
  // Without area nothing is divided by 0.
  const real3 a = O::make3(1, 2, 3);
  EXPECT_EQ(O::insideTriangle(a, a, a, a, 1, 0, 0, O::splat3(0), kEps), a);
}

}  // namespace
}  // namespace malus::test

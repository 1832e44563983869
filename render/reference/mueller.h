// Stokes vectors and Mueller matrices of three colours in double precision. Signs and frames:
// shaders/optics/CONVENTIONS.md. The two kinds of matrices are held by their elements that are not 0; `matrix` writes
// them out, as documentation and for the tests. Products leave out the zeros and keep the order of the sums.
#pragma once

#include <array>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "shaders/optics/optics.h"

namespace malus::reference {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

// Stokes vector (S0, S1, S2, S3) of each colour, in one frame.
using Light = std::array<dvec4, 3>;

inline Light unpolarized(const dvec3& radiance) {
  return {dvec4(radiance.x, 0, 0, 0), dvec4(radiance.y, 0, 0, 0), dvec4(radiance.z, 0, 0, 0)};
}
inline Light operator+(const Light& a, const Light& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// A matrix from its rows; glm's constructor takes columns.
inline dmat4 rows(const std::array<double, 16>& r) {
  return glm::transpose(
      dmat4(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10], r[11], r[12], r[13], r[14], r[15]));
}

// [[A, B, 0, 0], [B, A, 0, 0], [0, 0, Re X, -Im X], [0, 0, Im X, Re X]]
struct InterfaceMatrix {
  double a, b, xRe, xIm;
};
inline InterfaceMatrix interfaceMatrix(double s, double p, double xRe, double xIm) {
  return {(s + p) / 2, (s - p) / 2, xRe, xIm};
}
// share of a, and the rest of b
inline InterfaceMatrix mix(const InterfaceMatrix& a, const InterfaceMatrix& b, double share) {
  const double rest = 1 - share;
  return {share * a.a + rest * b.a, share * a.b + rest * b.b, share * a.xRe + rest * b.xRe,
          share * a.xIm + rest * b.xIm};
}
inline dmat4 matrix(const InterfaceMatrix& m) {
  return rows({m.a, m.b, 0, 0, m.b, m.a, 0, 0, 0, 0, m.xRe, -m.xIm, 0, 0, m.xIm, m.xRe});
}
inline dvec4 operator*(const InterfaceMatrix& m, const dvec4& s) {
  return {m.a * s[0] + m.b * s[1], m.b * s[0] + m.a * s[1], m.xRe * s[2] - m.xIm * s[3], m.xIm * s[2] + m.xRe * s[3]};
}
inline dvec4 operator*(const dvec4& row, const InterfaceMatrix& m) {
  return {row[0] * m.a + row[1] * m.b, row[0] * m.b + row[1] * m.a, row[2] * m.xRe + row[3] * m.xIm,
          row[3] * m.xRe - row[2] * m.xIm};
}

// An interface's matrix for each colour.
using Mueller = std::array<InterfaceMatrix, 3>;

// Frame rotation by f: (S1, S2) -> [[cos 2f, sin 2f], [-sin 2f, cos 2f]] (S1, S2).
struct FrameRotation {
  double cos2, sin2;
};
inline dmat4 matrix(const FrameRotation& r) {
  return rows({1, 0, 0, 0, 0, r.cos2, r.sin2, 0, 0, -r.sin2, r.cos2, 0, 0, 0, 0, 1});
}
inline FrameRotation transposed(const FrameRotation& r) { return {r.cos2, -r.sin2}; }
inline dvec4 operator*(const FrameRotation& r, const dvec4& s) {
  return {s[0], r.cos2 * s[1] + r.sin2 * s[2], r.cos2 * s[2] - r.sin2 * s[1], s[3]};
}
inline dvec4 operator*(const dvec4& row, const FrameRotation& r) {
  return {row[0], row[1] * r.cos2 - row[2] * r.sin2, row[1] * r.sin2 + row[2] * r.cos2, row[3]};
}

// Frame rotation from the canonical frame of a ray in direction d to the frame whose x is the s direction of a surface.
inline FrameRotation toSurface(const dvec3& d, const dvec3& s) {
  FrameRotation r{};
  f64::canonicalRotation(d, s, r.cos2, r.sin2);
  return r;
}

inline Light operator*(const Mueller& m, const Light& l) { return {m[0] * l[0], m[1] * l[1], m[2] * l[2]}; }
inline Light rotated(const FrameRotation& r, const Light& l) { return {r * l[0], r * l[1], r * l[2]}; }
inline Light scaled(const Light& l, const dvec3& scale) { return {l[0] * scale[0], l[1] * scale[1], l[2] * scale[2]}; }

// Light linearly polarized along x, with a degree of polarization from 0 to 1.
inline Light polarized(const dvec3& radiance, double degree) {
  Light l = unpolarized(radiance);
  for (std::size_t i = 0; i < 3; ++i) l[i][1] = l[i][0] * degree;
  return l;
}

}  // namespace malus::reference

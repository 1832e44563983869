// Stokes vectors and Mueller matrices of three colours in double precision, written out as matrices for easy checking.
// Signs and frames: shaders/optics/CONVENTIONS.md.
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
using Mueller = std::array<dmat4, 3>;

inline Light unpolarized(const dvec3& radiance) {
  return {dvec4(radiance.x, 0, 0, 0), dvec4(radiance.y, 0, 0, 0), dvec4(radiance.z, 0, 0, 0)};
}
inline Light operator+(const Light& a, const Light& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Light operator*(const Mueller& m, const Light& l) { return {m[0] * l[0], m[1] * l[1], m[2] * l[2]}; }

// A matrix from its rows; glm's constructor takes columns.
inline dmat4 rows(const std::array<double, 16>& r) {
  return glm::transpose(
      dmat4(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10], r[11], r[12], r[13], r[14], r[15]));
}

// [[A, B, 0, 0], [B, A, 0, 0], [0, 0, Re X, -Im X], [0, 0, Im X, Re X]]
inline dmat4 interfaceMatrix(double s, double p, double xRe, double xIm) {
  const double a = (s + p) / 2, b = (s - p) / 2;
  return rows({a, b, 0, 0, b, a, 0, 0, 0, 0, xRe, -xIm, 0, 0, xIm, xRe});
}

// Frame rotation by f: (S1, S2) -> [[cos 2f, sin 2f], [-sin 2f, cos 2f]] (S1, S2).
inline dmat4 frameRotation(double cos2, double sin2) {
  return rows({1, 0, 0, 0, 0, cos2, sin2, 0, 0, -sin2, cos2, 0, 0, 0, 0, 1});
}

// Frame rotation from the canonical frame of a ray in direction d to the frame whose x is the s direction of a surface.
inline dmat4 toSurface(const dvec3& d, const dvec3& s) {
  double cos2, sin2;
  f64::canonicalRotation(d, s, cos2, sin2);
  return frameRotation(cos2, sin2);
}
inline Light rotated(const dmat4& rotation, const Light& l) {
  return {rotation * l[0], rotation * l[1], rotation * l[2]};
}

inline Light scaled(const Light& l, const dvec3& scale) { return {l[0] * scale[0], l[1] * scale[1], l[2] * scale[2]}; }

// Light linearly polarized along x, with a degree of polarization from 0 to 1.
inline Light polarized(const dvec3& radiance, double degree) {
  Light l = unpolarized(radiance);
  for (std::size_t i = 0; i < 3; ++i) l[i][1] = l[i][0] * degree;
  return l;
}

}  // namespace malus::reference

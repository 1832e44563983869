#include "render/material/surface_response.h"

#include <cmath>
#include <numbers>

#include "shaders/optics/optics.h"

namespace malus::render {

namespace {

// The single- and double-precision optics as types.
struct Single {
  using real = float;
  using Stokes = f32::Stokes;
  static auto terms(real c, real n1, real n2, real step) { return f32::refractionTermsWith(c, n1, n2, step); }
  static auto dielectric(real c, const f32::RefractionTerms& f) { return f32::reflectanceFromTerms(c, f); }
  static auto conductor(real c, real n1, real n2, real k2, real step) {
    return f32::conductorReflectanceWith(c, n1, n2, k2, step);
  }
  static auto through(real c, const f32::RefractionTerms& f) { return f32::transmittanceFromTerms(c, f); }
  static Stokes applied(const Stokes& s, real rs, real rp, real xRe, real xIm) {
    return f32::stokesInterface(s, f32::splat3(rs), f32::splat3(rp), f32::splat3(xRe), f32::splat3(xIm));
  }
};
struct Double {
  using real = double;
  using Stokes = f64::Stokes;
  static auto terms(real c, real n1, real n2, real step) { return f64::refractionTermsWith(c, n1, n2, step); }
  static auto dielectric(real c, const f64::RefractionTerms& f) { return f64::reflectanceFromTerms(c, f); }
  static auto conductor(real c, real n1, real n2, real k2, real step) {
    return f64::conductorReflectanceWith(c, n1, n2, k2, step);
  }
  static auto through(real c, const f64::RefractionTerms& f) { return f64::transmittanceFromTerms(c, f); }
  static Stokes applied(const Stokes& s, real rs, real rp, real xRe, real xIm) {
    return f64::stokesInterface(s, f64::splat3(rs), f64::splat3(rp), f64::splat3(xRe), f64::splat3(xIm));
  }
};

// Mueller matrix, row by row, from its effect on the four unit Stokes vectors.
template <class O, class Apply>
std::array<double, 16> muellerMatrix(const Apply& apply) {
  std::array<double, 16> m{};
  for (std::size_t column = 0; column < 4; ++column) {
    typename O::Stokes unit{};
    (column == 0 ? unit.s0 : column == 1 ? unit.s1 : column == 2 ? unit.s2 : unit.s3).x = 1;
    const typename O::Stokes s = apply(unit);
    const double rows[4] = {s.s0.x, s.s1.x, s.s2.x, s.s3.x};
    for (std::size_t row = 0; row < 4; ++row) m[4 * row + column] = rows[row] + 0.0;  // no negative zeros
  }
  return m;
}

template <class O>
SurfaceResponse respond(const Interface& interface, double angleDegrees) {
  using real = typename O::real;
  SurfaceResponse response;
  response.angleDegrees = angleDegrees;
  // 90 degrees is grazing exactly.
  const auto c = static_cast<real>(angleDegrees == 90 ? 0 : std::cos(angleDegrees * std::numbers::pi / 180));
  const auto n1 = static_cast<real>(interface.n1), n2 = static_cast<real>(interface.n2),
             k2 = static_cast<real>(interface.k2), step = static_cast<real>(interface.n2 - interface.n1);
  const bool metal = interface.k2 > 0;
  const auto terms = O::terms(c, n1, n2, step);
  const auto r = metal ? O::conductor(c, n1, n2, k2, step) : O::dielectric(c, terms);
  response.rs = r.rs;
  response.rp = r.rp;
  const double sum = response.rs + response.rp;
  response.diattenuation = sum > 0 ? (response.rs - response.rp) / sum : 0;
  response.phaseDegrees = std::atan2(double(r.xIm) + 0.0, double(r.xRe) + 0.0) * 180 / std::numbers::pi;
  response.reflection =
      muellerMatrix<O>([&](const typename O::Stokes& s) { return O::applied(s, r.rs, r.rp, r.xRe, r.xIm); });
  if (metal) return response;
  const auto t = O::through(c, terms);
  response.ts = t.ts;
  response.tp = t.tp;
  response.transmission =
      muellerMatrix<O>([&](const typename O::Stokes& s) { return O::applied(s, t.ts, t.tp, t.x, 0); });
  return response;
}

}  // namespace

SurfaceResponse surfaceResponse(const Interface& interface, double angleDegrees, Precision precision) {
  return precision == Precision::singlePrecision ? respond<Single>(interface, angleDegrees)
                                                 : respond<Double>(interface, angleDegrees);
}

}  // namespace malus::render

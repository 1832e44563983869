// Paths of a camera ray over several interfaces, and their light by the Jones oracle.
#pragma once

#include "tests/shaders/optics_types.h"

namespace malus::test {

// One interface hit by the camera ray: from a medium of index n1 to one of n2 (per colour, complex
// for metals).
struct Bounce {
  oracle::Vec n{};  // unit, against the ray
  double n1 = 1;
  std::array<oracle::Complex, 3> n2{};
  bool metal = false;
  bool transmits = false;
};
struct Path {
  std::vector<oracle::Vec> d;  // of the camera ray: before the first bounce, ..., after the last
  std::vector<Bounce> bounces;
  oracle::Real cosine(std::size_t i) const { return -oracle::dot(d[i], bounces[i].n); }
};

inline Bounce glassMirror(double n1 = 1, double n2 = 1.5) { return {{}, n1, {n2, n2, n2}, false, false}; }
inline Bounce glassWindow(double n1, double n2) { return {{}, n1, {n2, n2, n2}, false, true}; }
inline Bounce metalMirror(const Metal& m, double n1 = 1) {
  Bounce b{{}, n1, {}, true, false};
  for (std::size_t i = 0; i < 3; ++i) b.n2[i] = oracle::Complex(m.n[i], -m.k[i]);
  return b;
}

// Adds a bounce whose normal is n or -n.
inline void extend(Path& path, Bounce bounce, const oracle::Vec& n) {
  const oracle::Vec& d = path.d.back();
  bounce.n = oracle::dot(d, n) < 0 ? n : oracle::along(n, -1, n, 0);
  path.bounces.push_back(bounce);
  path.d.push_back(bounce.transmits ? oracle::refracted(d, bounce.n, bounce.n1, bounce.n2[0].real())
                                    : oracle::mirrored(d, bounce.n));
}

// A normal at incidence angle with cosine c, in a random plane.
inline oracle::Vec normalAt(Draw& draw, const oracle::Vec& d, oracle::Real c) {
  const oracle::Vec across = oracle::unit(oracle::cross(d, draw.direction()));
  return oracle::unit(oracle::along(d, -c, across, std::sqrt(1 - c * c)));
}

// Glass and gold mirrors from outside, windows into glass, mirrors and windows inside. Angles stay away from
// normal incidence (where the s direction takes its rounding divided by the sine) and from the critical angle.
inline Path randomPath(Draw& draw, std::size_t length) {
  Path path;
  path.d.push_back(draw.direction());
  bool inside = false;
  while (path.bounces.size() < length) {
    const oracle::Real c = draw.between(0.15, 0.95), sinT = 1.5L * std::sqrt(1 - c * c);
    if (inside && std::abs(sinT - 1) < 0.05L) continue;
    Bounce bounce;
    if (!inside) {
      const std::size_t kind = draw.below(3);
      bounce = kind == 0 ? glassMirror() : kind == 1 ? metalMirror(kMetals[draw.below(5)]) : glassWindow(1, 1.5);
    } else {
      bounce = sinT < 1 && draw.below(2) == 0 ? glassWindow(1.5, 1) : glassMirror(1.5, 1);
    }
    extend(path, bounce, normalAt(draw, path.d.back(), c));
    if (bounce.transmits) inside = !inside;
  }
  return path;
}

// The light that returns to the camera from an unpolarized source of radiance 1 at the path's end.
inline oracle::Beam lightAlong(const Path& path, std::size_t colour, oracle::Beam beam) {
  for (std::size_t i = path.bounces.size(); i-- > 0;) {
    const Bounce& b = path.bounces[i];
    beam = b.transmits ? oracle::transmit(beam, b.n, b.n2[colour].real(), b.n1)
                       : oracle::reflect(beam, b.n, b.n1, b.n2[colour]);
  }
  return beam;
}
inline oracle::Beam lightAlong(const Path& path, std::size_t colour) {
  const oracle::Vec& d = path.d.back();
  return lightAlong(path, colour, oracle::unpolarized(oracle::along(d, -1, d, 0), 1));
}
// In the canonical frame of the first ray.
inline oracle::Stokes4 expectedStokes(const Path& path, std::size_t colour) {
  return oracle::measured(lightAlong(path, colour), oracle::canonicalX(oracle::along(path.d[0], -1, path.d[0], 0)));
}

// The light without polarization, the scale of errors.
inline oracle::Real unpolarizedShare(const Path& path, std::size_t colour) {
  oracle::Real share = 1;
  for (std::size_t i = 0; i < path.bounces.size(); ++i) {
    const Bounce& b = path.bounces[i];
    const oracle::Powers p = oracle::powers(path.cosine(i), b.n1, b.n2[colour]);
    share *= b.transmits ? (p.ts + p.tp) / 2 : (p.rs + p.rp) / 2;
  }
  return share;
}

}  // namespace malus::test

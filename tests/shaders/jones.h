// An oracle for the optics, independent of shaders/: Jones calculus in long double on field vectors in
// space, so that no reference frame has to be rotated. Time e^{+iwt}, waves e^{i(wt - k.r)}, index n - i k.
// A field is a complex vector perpendicular to its direction; unpolarized light is the incoherent sum of two.
// jones_test.cpp compares it with Maxwell's boundary conditions and with the rotation of a field in time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace malus::oracle {

using Real = long double;
using Complex = std::complex<Real>;
using Vec = std::array<Real, 3>;
using Field = std::array<Complex, 3>;
using Stokes4 = std::array<Real, 4>;

template <class A, class B>
auto dot(const std::array<A, 3>& a, const std::array<B, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class A, class B>
auto cross(const std::array<A, 3>& a, const std::array<B, 3>& b) {
  using T = decltype(a[0] * b[0]);
  return std::array<T, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec along(const Vec& a, Real ka, const Vec& b, Real kb) {
  return {ka * a[0] + kb * b[0], ka * a[1] + kb * b[1], ka * a[2] + kb * b[2]};
}
inline Vec unit(const Vec& v) { return along(v, 1 / std::sqrt(dot(v, v)), v, 0); }
inline Field sum(const Vec& a, Complex ka, const Vec& b, Complex kb) {
  return {ka * a[0] + kb * b[0], ka * a[1] + kb * b[1], ka * a[2] + kb * b[2]};
}

// Amplitudes of the electric field along s and p. p is direction x s on each ray, so that (s, p, direction)
// is right-handed; then r_p = -r_s at normal incidence. cosT: of the refracted wave, complex.
struct Amplitudes {
  Complex rs, rp, ts, tp, cosT;
};
inline Amplitudes amplitudes(Real cosI, Real n1, Complex n2) {
  const Real sinI = std::sqrt(std::max(Real(0), (1 - cosI) * (1 + cosI)));
  const Complex sinT = n1 * sinI / n2;
  Complex cosT = std::sqrt((Real(1) - sinT) * (Real(1) + sinT));
  // A wave into the second medium fades along it, or runs along it.
  const Complex kz = n2 * cosT;
  if (kz.imag() > 0 || (kz.imag() == 0 && kz.real() < 0)) cosT = -cosT;
  Amplitudes a;
  a.rs = (n1 * cosI - n2 * cosT) / (n1 * cosI + n2 * cosT);
  a.rp = (n2 * cosI - n1 * cosT) / (n2 * cosI + n1 * cosT);
  a.ts = 2 * n1 * cosI / (n1 * cosI + n2 * cosT);
  a.tp = 2 * n1 * cosI / (n2 * cosI + n1 * cosT);
  a.cosT = cosT;
  if (n2 == n1) a = {0, 0, 1, 1, cosI};
  return a;
}

struct Powers {
  Real rs, rp;  // |r|^2
  Complex x;    // r_p conj(r_s)
  Real ts, tp;  // flux transmittances
  Real txGeo;   // sqrt(ts tp)
};
inline Powers powers(Real cosI, Real n1, Complex n2) {
  const Amplitudes a = amplitudes(cosI, n1, n2);
  const Real flux = cosI > 0 ? (n2 * a.cosT).real() / (n1 * cosI) : 0;
  Powers p{std::norm(a.rs), std::norm(a.rp), a.rp * std::conj(a.rs), 0, 0, 0};
  p.ts = flux * std::norm(a.ts);
  p.tp = flux * std::norm(a.tp);
  p.txGeo = std::sqrt(p.ts * p.tp);
  return p;
}

// Jones vector to Stokes parameters: traces of the coherency matrix E E^dagger with the Pauli matrices.
struct Jones {
  std::array<std::array<Complex, 2>, 2> m{};
};
inline Jones multiply(const Jones& a, const Jones& b) {
  Jones r;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j];
  return r;
}
inline Jones dagger(const Jones& a) {
  Jones r;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) r.m[i][j] = std::conj(a.m[j][i]);
  return r;
}
inline Jones pauli(int i) {
  const Complex o = 1, z = 0, im(0, 1);
  if (i == 0) return {{{{o, z}, {z, o}}}};
  if (i == 1) return {{{{o, z}, {z, -o}}}};
  if (i == 2) return {{{{z, o}, {o, z}}}};
  return {{{{z, -im}, {im, z}}}};
}
inline Real trace(const Jones& a) { return (a.m[0][0] + a.m[1][1]).real(); }
inline Stokes4 stokesFromField(Complex ex, Complex ey) {
  Jones c;
  c.m[0] = {ex * std::conj(ex), ex * std::conj(ey)};
  c.m[1] = {ey * std::conj(ex), ey * std::conj(ey)};
  Stokes4 s{};
  for (int i = 0; i < 4; ++i) s[static_cast<std::size_t>(i)] = trace(multiply(pauli(i), c));
  return s;
}
inline std::array<Stokes4, 4> muellerMatrix(const Jones& j) {
  std::array<Stokes4, 4> m{};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      m[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
          trace(multiply(pauli(a), multiply(j, multiply(pauli(b), dagger(j))))) / 2;
  return m;
}

// A beam in space: its direction and fields that do not interfere.
struct Beam {
  Vec k{};
  std::vector<Field> fields;
};
inline Vec anyAcross(const Vec& k) {
  const Vec axis = std::abs(k[0]) < Real(0.6) ? Vec{1, 0, 0} : Vec{0, 1, 0};
  return unit(cross(k, axis));
}
inline Beam unpolarized(const Vec& k, Real radiance) {
  const Vec a = anyAcross(k), b = cross(k, a);
  const Complex e = std::sqrt(radiance / 2);
  return {k, {sum(a, e, b, 0), sum(a, 0, b, e)}};
}
inline Beam polarized(const Vec& k, const Vec& x, Complex ex, Complex ey) { return {k, {sum(x, ex, cross(k, x), ey)}}; }

inline Vec sAcross(const Vec& k, const Vec& n) {
  const Vec s = cross(k, n);
  return dot(s, s) > Real(1e-30) ? unit(s) : anyAcross(k);
}
inline Vec mirrored(const Vec& k, const Vec& n) { return along(k, 1, n, -2 * dot(k, n)); }
inline Beam reflect(const Beam& in, const Vec& n, Real n1, Complex n2) {
  const Amplitudes a = amplitudes(std::abs(dot(in.k, n)), n1, n2);
  const Vec s = sAcross(in.k, n), pIn = cross(in.k, s);
  Beam out{mirrored(in.k, n), {}};
  const Vec pOut = cross(out.k, s);
  for (const Field& e : in.fields) out.fields.push_back(sum(s, a.rs * dot(e, s), pOut, a.rp * dot(e, pIn)));
  return out;
}
// Snell's law; c: cosine of incidence. For total reflection the result has no meaning.
inline Vec refracted(const Vec& k, const Vec& n, Real n1, Real n2) {
  const Real c = dot(k, n);
  const Vec tangent = along(k, n1 / n2, n, -c * n1 / n2);
  const Real cosT = std::sqrt(1 - dot(tangent, tangent));
  return along(tangent, 1, n, c < 0 ? -cosT : cosT);
}
inline Beam transmit(const Beam& in, const Vec& n, Real n1, Real n2) {
  const Real c = std::abs(dot(in.k, n));
  const Amplitudes a = amplitudes(c, n1, n2);
  const Complex flux = std::sqrt(n2 * a.cosT.real() / (n1 * c));
  const Vec s = sAcross(in.k, n), pIn = cross(in.k, s);
  Beam out{refracted(in.k, n, n1, n2), {}};
  const Vec pOut = cross(out.k, s);
  for (const Field& e : in.fields)
    out.fields.push_back(sum(s, flux * a.ts * dot(e, s), pOut, flux * a.tp * dot(e, pIn)));
  return out;
}

// Stokes vector for an observer with this x axis.
inline Stokes4 measured(const Beam& beam, const Vec& x) {
  const Vec y = cross(beam.k, x);
  Stokes4 total{};
  for (const Field& e : beam.fields) {
    const Stokes4 s = stokesFromField(dot(e, x), dot(e, y));
    for (std::size_t i = 0; i < 4; ++i) total[i] += s[i];
  }
  return total;
}

// The canonical frame of a ray, the same at both ends: the x axis, rotated by the shortest rotation that takes the
// z axis onto the direction or its opposite, whichever is above the horizon (or so little
// below that a float may have lost it).
inline Vec canonicalX(const Vec& k) {
  const Vec m = k[2] < -1e-30L ? along(k, -1, k, 0) : k;
  const Vec axis = cross(Vec{0, 0, 1}, m);  // its length is the sine of the rotation
  const Vec e{1, 0, 0};
  // Rodrigues: e cos + (axis x e) + axis (axis . e) / (1 + cos)
  const Vec turned = along(along(e, m[2], cross(axis, e), 1), 1, axis, dot(axis, e) / (1 + m[2]));
  return turned;
}

}  // namespace malus::oracle

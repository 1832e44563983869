// Frames where their construction degenerates: parallel and antiparallel directions, the axes, and the jump of the
// canonical frame, which must be at the same direction for both ends of a ray.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(Frames);

// Each axis both ways, z = +-0, +-1e-38, +-denormal, and random ones.
template <class B>
std::vector<typename B::real3> directions() {
  using real = typename B::real;
  std::vector<typename B::real3> list;
  for (int axis = 0; axis < 3; ++axis)
    for (const real sign : {real(1), real(-1)}) {
      auto v = B::splat3(0);
      v[axis] = sign;
      list.push_back(v);
    }
  const real smallest = std::numeric_limits<real>::denorm_min(), tiny = std::numeric_limits<real>::min();
  for (const real z : {real(0), -real(0), real(1e-38), real(-1e-38), tiny, -tiny, smallest, -smallest, real(-1e-20)})
    for (int i = 0; i < 16; ++i) {
      const Real phi = i * 3.14159265358979323846L / 8;
      list.push_back(B::make3(static_cast<real>(std::cos(phi)), static_cast<real>(std::sin(phi)), z));
    }
  list.push_back(B::make3(tiny, -tiny, -1));
  list.push_back(B::make3(-tiny, tiny, 1));
  Draw draw(107);
  for (int i = 0; i < 200; ++i) list.push_back(toReal3<B>(draw.direction()));
  return list;
}

TYPED_TEST(Frames, EveryPairOfDirections) {
  MALUS_BACKEND_TYPES;
  const auto list = directions<B>();
  std::vector<typename B::FrameIn> in;
  for (const auto& d : list)
    for (const auto& n : list) in.push_back({d, n, 1, R(1.5L)});
  for (const auto& d : list) {
    in.push_back({d, d, 1, R(1.5L)});
    in.push_back({d, d * real(-1), 1, R(1.5L)});
  }
  const auto out = B::frames(in);
  Worst frame("frame", kUnit), s("s", kUnit), turn("turn", kUnit);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec z = oracle::along(toVec(in[i].d), -1, toVec(in[i].d), 0), x = toVec(out[i].x), y = toVec(out[i].y);
    // Orthonormal and right-handed: x cross y is the direction of propagation.
    for (const auto& [a, b] : {std::pair(x, y), {x, z}, {y, z}}) frame.add(oracle::dot(a, b));
    const Vec across = oracle::cross(x, y);
    for (std::size_t k = 0; k < 3; ++k) frame.add(across[k] - z[k]);
    // s is a unit vector perpendicular to the ray and the normal.
    s.add(oracle::dot(toVec(out[i].s), toVec(out[i].s)) - 1);
    s.add(oracle::dot(toVec(out[i].s), z));
    s.add(oracle::dot(toVec(out[i].s), toVec(in[i].n)));
    for (const auto& [c, sn] : {std::pair(out[i].cos2, out[i].sin2),
                                {out[i].mirrorCos, out[i].mirrorSin},
                                {out[i].cameraCos, out[i].cameraSin}})
      turn.add(Real(c) * c + Real(sn) * sn - 1);
  }
  EXPECT_LT(frame.value(), 4);
  EXPECT_LT(s.value(), 8);
  EXPECT_LT(turn.value(), 6);
}

TYPED_TEST(Frames, BothEndsOfARayAgree) {
  MALUS_BACKEND_TYPES;
  // A direction may differ between the two ends: a zero changes its sign, a denormal is flushed.
  std::vector<typename B::FrameIn> in;
  const real tiny = std::numeric_limits<real>::min(), smallest = std::numeric_limits<real>::denorm_min();
  constexpr std::size_t kWays = 8;
  for (int i = 0; i < 32; ++i) {
    const Real phi = i * 3.14159265358979323846L / 16;
    for (const real z : {real(0), -real(0), tiny, -tiny, smallest, -smallest, real(1e-38), real(-1e-38)})
      in.push_back({B::make3(R(std::cos(phi)), R(std::sin(phi)), z), B::make3(0, 0, 1), 1, R(1.5L)});
  }
  const auto out = B::frames(in);
  for (std::size_t i = 0; i < in.size(); i += kWays)
    for (std::size_t k = 1; k < kWays; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_CLOSE(out[i].x[axis], out[i + k].x[axis], 2 * kUnit) << i << ' ' << k;
        EXPECT_CLOSE(out[i].y[axis], out[i + k].y[axis], 2 * kUnit) << i << ' ' << k;
      }
}

TYPED_TEST(Frames, CanonicalFrameJumpDoesNotShow) {
  MALUS_BACKEND_TYPES;
  // A ray whose z passes through 0: its frame jumps, the light at the camera does not.
  std::vector<typename B::ChainIn> chains;
  for (const Real z : {0.0L, -0.0L, 1e-38L, -1e-38L, 1e-20L, -1e-20L, 1e-8L, -1e-8L}) {
    Path path;
    path.d.push_back(oracle::unit({0.3L, 0.2L, -0.9L}));
    const Vec out = oracle::unit({0.6L, 0.8L, z});
    extend(path, metalMirror(kMetals[0]), oracle::unit(oracle::along(out, 1, path.d[0], -1)));
    extend(path, glassMirror(), oracle::unit({-0.3L, -0.7L, 0.5L}));
    extend(path, metalMirror(kMetals[2]), oracle::unit({0.1L, 0.9L, -0.2L}));
    chains.push_back(chainFromPath<B>(path));
  }
  // With less than IEEE's precision, source and bounces of both chains are packed with different roundings.
  const Real packings = B::kPackingRoundings == 1 ? 1 : 2 * 4;
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 1; i < out.size(); ++i)
      EXPECT_LT(largestDifference(stokesVector(out[i]), stokesVector(out[0])) / out[0].s0,
                60 * kUnit + 1e-7L + packings * packingLoss<B>(method) +
                    (method == "sp-cosine" || method == "sp-ratio" ? 2e-3L : 0))
          << method << ' ' << i;
  }
}

TYPED_TEST(Frames, LoopsOfMirrorsAreProductsOfHalfTurns) {
  MALUS_BACKEND_TYPES;
  // Perfect mirrors map a field by 2 n n^T - 1, n along d_out - d_in: a closed loop of directions
  // rotates the polarization (z -> x -> y -> z by 90 degrees).
  Draw draw(108);
  std::vector<typename B::IterativeIn> in;
  for (int i = 0; i < 300; ++i) {
    typename B::IterativeIn loop{};
    std::vector<Vec> directions;
    if (i < 60) {
      directions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    } else {
      // Random closed paths of 3 to 64 mirrors.
      const std::size_t count = 3 + draw.below(62);
      directions.push_back(draw.direction());
      while (directions.size() < count) {
        const Vec next = draw.direction();
        if (oracle::dot(next, directions.back()) < 0.9L &&
            (directions.size() + 1 < count || oracle::dot(next, directions[0]) < 0.9L))
          directions.push_back(next);
      }
      directions.push_back(directions[0]);
    }
    loop.d = toReal3<B>(directions[0]);
    const Vec p = draw.direction();
    loop.light = toReal3<B>(p);
    loop.count = static_cast<real>(directions.size() - 1);
    for (std::size_t k = 0; k + 1 < directions.size(); ++k)
      loop.n[k] = toReal3<B>(oracle::unit(oracle::along(directions[k + 1], 1, directions[k], -1)));
    in.push_back(loop);
  }
  const auto out = B::loops(in);
  for (std::size_t i = 0; i < in.size(); ++i) {
    // A fully polarized field with these Stokes components, reflected with the rounded normals.
    const Vec d = oracle::unit(toVec(in[i].d)), x = oracle::canonicalX(d), y = oracle::cross(d, x);
    const Vec p = oracle::unit(toVec(in[i].light));
    const Real ex = std::sqrt((1 + p[0]) / 2);
    const oracle::Complex ey = ex > 1e-9L ? oracle::Complex(p[1], p[2]) / (2 * ex) : oracle::Complex(1);
    oracle::Field e = oracle::sum(x, ex, y, ey);
    Vec k = d;
    const auto count = static_cast<std::size_t>(in[i].count);
    for (std::size_t j = 0; j < count; ++j) {
      const Vec n = oracle::unit(toVec(in[i].n[j]));
      const oracle::Complex en = oracle::dot(e, n);
      for (std::size_t a = 0; a < 3; ++a) e[a] = Real(2) * n[a] * en - e[a];
      k = oracle::mirrored(k, n);
    }
    const Vec xEnd = oracle::canonicalX(k), yEnd = oracle::cross(k, xEnd);
    const oracle::Stokes4 want = oracle::stokesFromField(oracle::dot(e, xEnd), oracle::dot(e, yEnd)),
                          got = stokesVector(out[i]);
    // Directions and frames drift by one rounding per mirror.
    EXPECT_LT(largestDifference(got, want), 16 * static_cast<Real>(count) * kUnit) << i;
    EXPECT_CLOSE(std::hypot(std::hypot(got[1], got[2]), got[3]), 1, 8 * static_cast<Real>(count) * kUnit);
  }
}

}  // namespace
}  // namespace malus::test

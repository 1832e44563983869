// The bound of the error without polarization, and the angles of incidence that it takes into account.
#include "bake/effects/polarization_bound.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "bake/effects/diattenuation.h"
#include "bake/effects/interface_patches.h"
#include "tests/bake/effects/effect_scene.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Material;
using pack::MaterialKind;

constexpr ImageRequest imageOfDepth(std::uint32_t depth) { return {depth, {1, 0, 0, 0}, false, false}; }

Material gold() {
  Material m = material(MaterialKind::metal);
  m.eta = {0.1884, 0.5439, 1.3319};
  m.k = {3.4034, 2.2309, 1.8693};
  return m;
}

// Diattenuation of a reflection by Fresnel's equations in complex numbers, from vacuum, at a cosine of incidence.
double reflectedD(std::complex<double> n, double c) {
  const std::complex<double> t = std::sqrt(1.0 - (1 - c * c) / (n * n));
  const double s = std::norm((c - n * t) / (c + n * t)), p = std::norm((n * c - t) / (n * c + t));
  return std::abs(s - p) / (s + p);
}

// A flat square of half side `half` about (0, 0, z), facing +z or -z.
pack::Mesh square(double half, double z, bool up) {
  pack::Mesh mesh;
  mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  mesh.triangles = up ? std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}} : std::vector<glm::uvec3>{{0, 2, 1}, {0, 3, 2}};
  return mesh;
}

// Two squares that face each other at a distance of 1, and a camera halfway between them on their axis.
pack::Scene facingSquares(const Material& m, double half, std::uint32_t depth) {
  pack::Scene scene = makeScene({m}, depth);
  scene.meshes = {square(half, 0, true), square(half, 1, false)};
  scene.camera.position = {0, 0, 0.5};
  return scene;
}

glm::dvec3 pointIn(const std::vector<glm::dvec3>& hull, std::mt19937& random) {
  std::exponential_distribution<double> weight;
  glm::dvec3 sum(0.0);
  double all = 0;
  for (const glm::dvec3& p : hull) {
    const double w = weight(random);
    sum += w * p;
    all += w;
  }
  return sum / all;
}

// Rays between random points of random triangles have the angles that the range promises.
TEST(PolarizationBound, AnglesContainEveryRay) {
  std::mt19937 random(7);
  std::normal_distribution<double> at;
  int narrow = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&] { return glm::dvec3(at(random), at(random), at(random)); };
    InterfacePatch to;
    to.hull = {point(), point(), point()};
    to.axis = glm::normalize(glm::cross(to.hull[1] - to.hull[0], to.hull[2] - to.hull[0]));
    to.spread = i % 2 == 0 ? 0 : 0.2;
    const glm::dvec3 shift = 4.0 * glm::normalize(point());
    const std::vector<glm::dvec3> from = {shift + point(), shift + point(), shift + point()};
    const CosineRange range = incidence(from, to, 0);
    ASSERT_FALSE(range.isEmpty());
    narrow += range.high - range.low < 0.5 ? 1 : 0;
    for (int k = 0; k < 20; ++k) {
      glm::dvec3 n = to.axis;
      if (to.spread > 0) {
        const glm::dvec3 side = glm::normalize(glm::cross(n, point()));
        const double tilt = std::uniform_real_distribution<double>(0, to.spread)(random);
        n = std::cos(tilt) * n + std::sin(tilt) * side;
      }
      const double c = std::abs(glm::dot(glm::normalize(pointIn(from, random) - pointIn(to.hull, random)), n));
      ASSERT_GE(c, range.low) << i;
      ASSERT_LE(c, range.high) << i;
    }
  }
  EXPECT_GT(narrow, 100) << "few ranges contain every angle";
}

TEST(PolarizationBound, FacesOfOnePlaneDoNotSeeEachOther) {
  InterfacePatch to;
  to.hull = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  to.isFlat = true;
  EXPECT_TRUE(incidence({{2, 0, 0}, {3, 0, 1e-9}, {2, 1, 0}}, to, 1e-6).isEmpty());
  EXPECT_FALSE(incidence({{2, 0, 0}, {3, 0, 1}, {2, 1, 0}}, to, 1e-6).isEmpty());
}

TEST(PolarizationBound, TheLargestValueOfARange) {
  std::mt19937 random(3);
  std::vector<double> cells(37);
  for (double& c : cells) c = std::uniform_real_distribution<double>()(random);
  const RangeMaximum maximum(cells);
  const auto count = static_cast<double>(cells.size());
  for (std::size_t first = 0; first < cells.size(); ++first)
    for (std::size_t last = first; last < cells.size(); ++last)
      EXPECT_EQ(maximum.over({(static_cast<double>(first) + 0.5) / count, (static_cast<double>(last) + 0.5) / count}),
                *std::max_element(cells.begin() + static_cast<std::ptrdiff_t>(first),
                                  cells.begin() + static_cast<std::ptrdiff_t>(last) + 1));
  EXPECT_EQ(maximum.over({1, 0}), 0);
}

// Metal mirrors of 20 cm at a distance of 1 m: the most oblique ray is a diagonal. The first reflection is seen from
// the camera, halfway. The bound is that of the formula to 1 %, and far below that of any angle.
TEST(PolarizationBound, SmallMirrorsMeetOnlySteepRays) {
  const double half = 0.1;
  const double toSecond = 1 / std::sqrt(1 + 8 * half * half), toFirst = 0.5 / std::sqrt(0.25 + 2 * half * half);
  const glm::dvec3 bound = polarizationErrorBound(facingSquares(gold(), half, 2), imageOfDepth(2));
  const glm::dvec3 any = polarizationErrorBound(makeScene({gold()}, 2), imageOfDepth(2));
  for (int i = 0; i < 3; ++i) {
    const std::complex<double> n(gold().eta[i], -gold().k[i]);
    const double exact = reflectedD(n, toFirst) * reflectedD(n, toSecond);
    EXPECT_GE(bound[i], exact * 0.999) << i;
    EXPECT_LE(bound[i], exact * 1.1) << i;
    EXPECT_LT(bound[i], 0.1 * any[i]) << i;
  }
}

// Glass mirrors whose rays stay steeper than Brewster's angle never polarize fully; larger ones can.
TEST(PolarizationBound, BrewstersAngleMustBeInReach) {
  Material glass = material(MaterialKind::mirrorGlass);
  glass.eta = glm::dvec3(1.5);
  EXPECT_LT(polarizationErrorBound(facingSquares(glass, 0.1, 4), imageOfDepth(4)).x, 0.1);
  EXPECT_NEAR(polarizationErrorBound(facingSquares(glass, 2, 2), imageOfDepth(2)).x, 1, 1e-9);
}

// Every chain of mirrors that a ray can take is below the bound: rays between random points of a prism of mirrors.
TEST(PolarizationBound, HoldsForRandomChains) {
  pack::Scene scene = makeScene({gold()}, 3);
  scene.meshes.clear();
  for (int i = 0; i < 3; ++i) {
    const double turn = 2 * std::numbers::pi * i / 3, half = 0.3;
    const glm::dvec3 out(std::cos(turn), 0, std::sin(turn)), side(-out.z, 0, out.x), up(0, 1, 0);
    pack::Mesh mesh;
    for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      mesh.positions.push_back(out + half * (static_cast<double>(a) * side + static_cast<double>(b) * up));
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    scene.meshes.push_back(mesh);
  }
  scene.camera.position = {0, 0, 0};
  const double bound = polarizationErrorBound(scene, imageOfDepth(3)).z;
  const std::complex<double> n(gold().eta.z, -gold().k.z);
  std::mt19937 random(11);
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dvec3 from = scene.camera.position;
    std::size_t last = 3;
    double more = 1, less = 1;
    for (int k = 0; k < 3; ++k) {
      std::size_t next = random() % 3;
      if (next == last) next = (next + 1) % 3;
      const pack::Mesh& mesh = scene.meshes[next];
      const glm::dvec3 p = pointIn(mesh.positions, random);
      const glm::dvec3 normal =
          glm::normalize(glm::cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]));
      const double d = reflectedD(n, std::abs(glm::dot(glm::normalize(p - from), normal)));
      more *= 1 + d;
      less *= 1 - d;
      from = p;
      last = next;
    }
    largest = std::max(largest, (more + less) / 2 - 1);
  }
  EXPECT_LE(largest, bound);
  EXPECT_GT(largest, 0.2 * bound);
}

// Diattenuation of a transmission between two dielectrics by Fresnel's equations.
double transmittedD(double n1, double n2, double c) {
  const double sine = n1 / n2 * std::sqrt(1 - c * c);
  if (sine >= 1) return 0;
  const double t = std::sqrt(1 - sine * sine), rs = (n1 * c - n2 * t) / (n1 * c + n2 * t),
               rp = (n2 * c - n1 * t) / (n2 * c + n1 * t);
  return std::abs(rs * rs - rp * rp) / (2 - rs * rs - rp * rp);
}

// At every angle, those next to Brewster's and the critical one included.
TEST(PolarizationBound, CellsAreMaximaOfGlassFromBothSides) {
  std::mt19937 random(5);
  for (const auto& [outside, inside] : {std::pair(1.0, 1.5), {1.5, 1.33}, {1.0, 2.4}}) {
    Material m = material(MaterialKind::glass);
    m.outsideEta = outside;
    m.eta = glm::dvec3(inside);
    const Diattenuation d = diattenuation(m, 0);
    m.kind = MaterialKind::paint;
    m.albedo = glm::dvec3(0.5);
    const RangeMaximum leaving = diattenuation(m, 0).leaving;
    for (int i = 0; i < 20000; ++i) {
      double c = std::uniform_real_distribution<double>()(random);
      const double most = std::max(outside, inside), least = std::min(outside, inside);
      if (i % 2 == 0) c = std::sqrt(1 - least * least / (most * most)) * (1 + 1e-6 * c);
      const CosineRange here{c, c};
      ASSERT_LE(transmittedD(outside, inside, c), d.interaction.over(here) + 1e-9) << c;
      ASSERT_LE(transmittedD(inside, outside, c), d.interaction.over(here) + 1e-9) << c;
      ASSERT_LE(transmittedD(outside, inside, c), leaving.over(here) + 1e-9) << c;
    }
  }
}

// Facets of a rough texel have other normals than the face.
TEST(PolarizationBound, ARoughnessMapMeetsEveryAngle) {
  pack::Scene scene = facingSquares(gold(), 0.1, 2);
  scene.materials[0].meshMaps.roughness.texture = 0;
  EXPECT_NEAR(polarizationErrorBound(scene, imageOfDepth(2)).z,
              polarizationErrorBound(makeScene({gold()}, 2), imageOfDepth(2)).z, 1e-12);
}

TEST(PolarizationBound, IsUsefulUpToTheIntensityItself) {
  EXPECT_TRUE(isUseful({0.5, 1, 0}));
  EXPECT_FALSE(isUseful({0.5, 1.1, 0}));
}

}  // namespace
}  // namespace malus::bake

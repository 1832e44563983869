#include "meshprep/certify/glass.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "meshprep/prepare.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::cube;
using test::flipped;
using test::joined;

Certificate certify(const Mesh& mesh, Options options = {}) {
  options.certifyGlass = true;
  options.flat = true;
  Report report;
  clean(mesh, options, report);
  return report.certificate;
}

// Returns the text of the only problem.
std::string problem(const Mesh& mesh, const Options& options = {}) {
  const Certificate certificate = certify(mesh, options);
  EXPECT_EQ(certificate.problems.size(), 1u);
  if (certificate.problems.empty()) return {};
  const Problem& p = certificate.problems.front();
  return p.what + "; " + p.where + "; " + p.repair;
}

TEST(GlassCertificate, IsGrantedForSolidsAndCavities) {
  EXPECT_TRUE(certify(cube()).isGranted());
  EXPECT_TRUE(certify(flipped(cube())).isGranted());  // cleaning flips it
  EXPECT_TRUE(certify(test::sphere(15, 32)).isGranted());
  EXPECT_TRUE(certify(joined(cube(4), flipped(cube(1, {1, 1, 1})))).isGranted());
  EXPECT_TRUE(certify(joined(cube(), cube(1, {3, 0, 0}))).isGranted());
  EXPECT_TRUE(certify(joined(cube(), cube(1, {1, 1, 0}))).isGranted());  // common edge, which is split
}

TEST(GlassCertificate, IsGivenOnRequestOnly) {
  Report report;
  clean(cube(), {}, report);
  EXPECT_FALSE(report.certificate.checked);
  EXPECT_FALSE(report.certificate.isGranted());
}

TEST(GlassCertificate, LocatesAHole) {
  Mesh mesh = joined(cube(1, {5, 0, 0}), cube());
  mesh.triangles.pop_back();
  const Certificate certificate = certify(mesh);
  ASSERT_EQ(certificate.problems.size(), 1u);
  EXPECT_EQ(certificate.problems[0].component, 1u);
  EXPECT_CONTAINS(certificate.problems[0].what, "3 open");
  EXPECT_TRUE(contains(certificate.problems[0].where, "face "));
  EXPECT_TRUE(contains(certificate.problems[0].repair, "--fill-holes"));
  Options options;
  options.steps.fillHoles = 3;
  EXPECT_TRUE(certify(mesh, options).isGranted());
}

TEST(GlassCertificate, RefusesAMoebiusStrip) {
  Mesh mesh;
  constexpr std::uint32_t kSteps = 9;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double a = 2 * 3.14159265358979 * i / kSteps;
    const glm::dvec3 out(std::cos(a), std::sin(a), 0), side = std::cos(a / 2) * out + glm::dvec3(0, 0, std::sin(a / 2));
    mesh.positions.push_back(3.0 * out + side);
    mesh.positions.push_back(3.0 * out - side);
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = i + 1 == kSteps ? 1 : a + 2, d = i + 1 == kSteps ? 0 : b + 2;
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(b, d, c);
  }
  const Certificate certificate = certify(mesh);
  EXPECT_TRUE(std::any_of(certificate.problems.begin(), certificate.problems.end(),
                          [](const Problem& p) { return contains(p.what, "not orientable"); }));
  Options options;
  options.openSurface = true;
  const Certificate open = certify(mesh, options);
  EXPECT_TRUE(contains(open.problems.at(0).what, "not orientable"));
}

TEST(GlassCertificate, RefusesIntersectingSolids) {
  EXPECT_TRUE(contains(problem(joined(cube(), cube(1, {0.5, 0.3, 0.2}))), "cross", "first near"));
}

TEST(GlassCertificate, RefusesSolidsThatTouch) {
  EXPECT_TRUE(contains(problem(joined(cube(), cube(1, {1, 0, 0}))), "2 pairs"));
  // Shifted along the common plane: overlapping, but not equal.
  EXPECT_TRUE(contains(problem(joined(cube(), cube(1, {1, 0.25, 0.25}))), "cross"));
}

TEST(GlassCertificate, RefusesAFoldWithoutThickness) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  const Certificate certificate = certify(mesh);
  ASSERT_EQ(certificate.problems.size(), 3u);
  EXPECT_CONTAINS(certificate.problems[0].what, "3 open");  // two surfaces, not a fold
  EXPECT_CONTAINS(certificate.problems[1].what, "3 open");
  EXPECT_CONTAINS(certificate.problems[2].what, "1 pair", "coincident");

  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 3}, {0, 3, 1}};  // a flat tetrahedron
  const Certificate flat = certify(mesh);
  ASSERT_FALSE(flat.problems.empty());
  EXPECT_CONTAINS(flat.problems[0].what, "1 closed", "volume");
}

TEST(GlassCertificate, ReportsNonManifoldEdges) {
  Options options;
  options.steps.fans = false;
  EXPECT_TRUE(contains(problem(joined(cube(), cube(1, {1, 1, 0})), options), "1 edge", "three"));
}

// Two faces of a slab: the one at z = 0 points down, the one at z = 1 up; `up` flips the lower one.
Mesh slab(bool up) {
  Mesh mesh;
  for (const double z : {0.0, 1.0})
    for (const glm::dvec3& p : {glm::dvec3(0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
      mesh.positions.emplace_back(p.x, p.y, z);
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  if (up) mesh.triangles[0] = {0, 1, 2}, mesh.triangles[1] = {0, 2, 3};
  return mesh;
}

TEST(GlassCertificate, RequiresAnOppositeSurface) {
  Options options;
  options.openSurface = true;
  EXPECT_TRUE(certify(slab(false), options).isGranted());
  const Certificate wrong = certify(slab(true), options);
  ASSERT_EQ(wrong.problems.size(), 2u);
  for (const Problem& p : wrong.problems) EXPECT_TRUE(contains(p.what, "opposite")) << p.what;
  Mesh lake = slab(false);
  lake.triangles.erase(lake.triangles.begin(), lake.triangles.begin() + 2);
  EXPECT_TRUE(contains(problem(lake, options), "2 sampled faces"));
  EXPECT_FALSE(certify(slab(false)).isGranted());  // not a solid
}

TEST(GlassCertificate, IsGrantedForAFibre) {
  Mesh fibre = cube();  // 10 micrometres thick, 100 m long
  for (glm::dvec3& p : fibre.positions) p *= glm::dvec3(100, 1e-5, 1e-5);
  EXPECT_TRUE(certify(fibre).isGranted());
}

// Cylinder with caps that are fans around a corner of their rim.
Mesh cylinder(std::uint32_t sides) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * 3.14159265358979323846 * i / sides;
    mesh.positions.emplace_back(std::cos(a), std::sin(a), 0);
    mesh.positions.emplace_back(std::cos(a), std::sin(a), 1);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.emplace_back(a, b, b + 1);
    mesh.triangles.emplace_back(a, b + 1, a + 1);
    if (i == 0 || i + 1 == sides) continue;
    mesh.triangles.emplace_back(0, b, a);
    mesh.triangles.emplace_back(1, a + 1, b + 1);
  }
  return mesh;
}

TEST(GlassCertificate, IsGrantedForLargeFans) { EXPECT_TRUE(certify(cylinder(1024)).isGranted()); }

TEST(GlassCertificate, ReportsFacesWithTheWrongOrientation) {
  Options options;
  options.steps.orient = false;
  EXPECT_TRUE(certify(cube(), options).isGranted());
  Mesh mesh = cube();
  std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
  EXPECT_TRUE(contains(problem(mesh, options), "1 face", "orientation"));
  EXPECT_TRUE(contains(problem(flipped(cube()), options), "12 faces", "orientation"));
  EXPECT_TRUE(certify(mesh).isGranted());
}

TEST(GlassCertificate, RefusesTooManyOverlaps) {
  // Long thin solids through one point.
  Mesh mesh;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Mesh needle = cube();
    const double a = i * 0.01;
    for (glm::dvec3& p : needle.positions) {
      const glm::dvec3 q(p.x * 20 - 10, p.y * 1e-3, p.z * 1e-3);
      p = {std::cos(a) * q.x - std::sin(a) * q.y, std::sin(a) * q.x + std::cos(a) * q.y, q.z + a * q.x};
    }
    mesh = i == 0 ? needle : joined(std::move(mesh), needle);
  }
  const Certificate certificate = certify(mesh);
  EXPECT_TRUE(std::any_of(certificate.problems.begin(), certificate.problems.end(),
                          [](const Problem& p) { return contains(p.what, "too many overlapping faces"); }));
}

}  // namespace
}  // namespace malus::prep

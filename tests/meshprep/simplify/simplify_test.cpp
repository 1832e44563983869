// Simplification as a step of preparation, against shapes whose result is known and against sampled distances.
#include "meshprep/simplify/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/clean/edges.h"
#include "meshprep/prepare.h"
#include "meshprep/simplify/surface.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;

struct Result {
  Mesh before, after;
  Report report;
};

// The mesh cleaned without and with simplification.
Result run(const Mesh& mesh, const Options& options) {
  Result result;
  Options plain = options;
  plain.simplify = {};
  plain.certifyGlass = false;
  Report unused;
  result.before = clean(mesh, plain, unused);
  result.after = clean(mesh, options, result.report);
  return result;
}

Options flatWithin(double metres) {
  Options options;
  options.flat = true;
  options.simplify.maxError = metres;
  return options;
}

using Position = std::tuple<double, double, double>;
using EdgeSet = std::set<std::pair<Position, Position>>;
Position key(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

EdgeSet boundary(const Mesh& mesh) {
  EdgeSet edges;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    const Position a = key(mesh.positions[edge[0].low]), b = key(mesh.positions[edge[0].high]);
    if (edge.size() == 1) edges.emplace(std::min(a, b), std::max(a, b));
  });
  return edges;
}

// The largest distance of random points of one mesh to the other, in both directions.
double sampledDistance(const Mesh& a, const Mesh& b, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  double largest = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Surface surface(*to);
    for (const glm::uvec3& t : from->triangles)
      for (int i = 0; i < 20; ++i) {
        double u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::dvec3 &p = from->positions[t.x], &q = from->positions[t.y], &r = from->positions[t.z];
        largest = std::max(largest, surface.nearest(p + u * (q - p) + v * (r - p)).distance);
      }
  }
  return largest;
}

// n by n quads over the unit square.
template <class Height>
Mesh sheet(std::uint32_t n, Height z) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.positions.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n,
                                  z(static_cast<double>(i) / n, static_cast<double>(j) / n));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

// A cube whose faces have n by n quads, as six sheets that share positions.
Mesh fineCube(std::uint32_t n) {
  const Mesh face = sheet(n, [](double, double) { return 0.0; });
  Mesh cube;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      Mesh side = face;
      for (glm::dvec3& p : side.positions) {
        glm::dvec3 q;
        q[(axis + 1) % 3] = p.x;
        q[(axis + 2) % 3] = p.y;
        q[axis] = high ? 1 : 0;
        p = q;
      }
      cube = test::joined(std::move(cube), high ? side : test::flipped(std::move(side)));
    }
  return cube;
}

TEST(Simplify, APlaneWithInnerVerticesBecomesTwoTriangles) {
  std::mt19937 random(3);
  Mesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int i = 0; i < 200; ++i) {
    const std::size_t split = random() % mesh.triangles.size();
    const glm::uvec3 t = mesh.triangles[split];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back((mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0);
    mesh.triangles[split] = {t.x, t.y, middle};
    mesh.triangles.emplace_back(t.y, t.z, middle);
    mesh.triangles.emplace_back(t.z, t.x, middle);
  }
  const Result result = run(mesh, flatWithin(1e-9));
  EXPECT_EQ(result.before.triangles.size(), 402u);
  EXPECT_EQ(result.after.triangles.size(), 2u);
  EXPECT_EQ(result.after.positions.size(), 4u);
  EXPECT_EQ(result.report.simplification.trianglesBefore, 402u);
  EXPECT_EQ(result.report.simplification.trianglesAfter, 2u);
  EXPECT_LE(result.report.simplification.maxDeviation, 1e-9);
  EXPECT_LT(result.report.simplification.maxNormalDegrees, 1e-5);
}

TEST(Simplify, ATessellatedCubeBecomesTwelveTriangles) {
  for (const bool flat : {false, true}) {
    Options options = flatWithin(1e-9);
    options.flat = flat;
    options.certifyGlass = true;
    const Result result = run(fineCube(9), options);
    EXPECT_EQ(result.after.triangles.size(), 12u);
    EXPECT_TRUE(result.report.certificate.isGranted());
    ASSERT_EQ(result.report.components.size(), 1u);
    EXPECT_NEAR(result.report.components[0].signedVolume, 1, 1e-12);
  }
}

TEST(Simplify, ASphereStaysWithinTheBound) {
  std::mt19937 random(4);
  const double bound = 0.01;
  const Result result = run(test::sphere(60, 120), flatWithin(bound));
  EXPECT_LT(result.after.triangles.size(), result.before.triangles.size() / 4);
  EXPECT_LE(result.report.simplification.maxDeviation, bound);
  EXPECT_LE(sampledDistance(result.before, result.after, random), result.report.simplification.maxDeviation);
  const double sagitta = 1 - std::cos(3.14159265358979 / 60);  // of the tessellation itself
  for (const glm::uvec3& t : result.after.triangles)
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = result.after.positions[t[k]], &b = result.after.positions[t[(k + 1) % 3]];
      EXPECT_NEAR(glm::length(a), 1, 1e-12);
      EXPECT_GE(glm::length(a + b) / 2, 1 - bound - sagitta);
    }
}

TEST(Simplify, RandomMeshesStayWithinTheBound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int simplified = 0;
  for (int round = 0; round < 12; ++round) {
    const double noise = std::pow(10, -1 - 3 * unit(random)), bound = noise * (0.1 + 3 * unit(random));
    Mesh mesh = round % 2 == 0 ? test::sphere(20, 31) : sheet(25, [](double, double) { return 0.0; });
    for (glm::dvec3& p : mesh.positions) p += noise * glm::dvec3(unit(random), unit(random), unit(random));
    const Result result = run(mesh, flatWithin(bound));
    EXPECT_LE(result.report.simplification.maxDeviation, bound);
    EXPECT_LE(sampledDistance(result.before, result.after, random), bound);
    simplified += result.after.triangles.size() < result.before.triangles.size() ? 1 : 0;
  }
  EXPECT_GE(simplified, 8);  // the bound alone would also hold for a step that does nothing
}

TEST(Simplify, BoundariesStayBitIdentical) {
  const Result result =
      run(sheet(30, [](double x, double y) { return 0.02 * std::sin(20 * x) * y; }), flatWithin(0.005));
  EXPECT_LT(result.after.triangles.size(), result.before.triangles.size() / 2);
  EXPECT_EQ(boundary(result.after), boundary(result.before));
}

TEST(Simplify, MaterialBordersStayBitIdentical) {
  // Two materials on one plane, the border a zigzag.
  const Mesh mesh = sheet(16, [](double, double) { return 0.0; });
  std::string text;
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  const auto isRed = [](std::size_t face) { return (face / 32 + face % 2) < 8; };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    text += fmt::format("usemtl {}\nf {} {} {}\n", isRed(i) ? "red" : "blue", mesh.triangles[i].x + 1,
                        mesh.triangles[i].y + 1, mesh.triangles[i].z + 1);
  const test::TemporaryFile file(".obj", text);
  const auto border = [&](const Options& options) {
    Report report;
    const Mesh result = prepare(file.path(), options, report);
    EdgeSet edges;
    forEachEdge(edgeUses(result.triangles), [&](std::span<const EdgeUse> edge) {
      if (edge.size() != 2) return;
      if (isRed(result.sourceFaces[edge[0].triangle]) == isRed(result.sourceFaces[edge[1].triangle])) return;
      const Position a = key(result.positions[edge[0].low]), b = key(result.positions[edge[0].high]);
      edges.emplace(std::min(a, b), std::max(a, b));
    });
    return std::pair(edges, result.triangles.size());
  };
  Options plain;
  plain.flat = true;
  const auto [edgesBefore, trianglesBefore] = border(plain);
  const auto [edgesAfter, trianglesAfter] = border(flatWithin(1e-6));
  EXPECT_GT(edgesBefore.size(), 16u);
  EXPECT_EQ(edgesAfter, edgesBefore);
  EXPECT_LT(trianglesAfter, trianglesBefore / 2);
}

TEST(Simplify, ReachesTheNumberOfTriangles) {
  for (const std::uint64_t budget : {1000u, 201u, 20u}) {
    Options options;
    options.flat = true;
    options.simplify.triangles = budget;
    const Result result = run(test::sphere(40, 60), options);
    EXPECT_LE(result.after.triangles.size(), budget);
    EXPECT_GE(result.after.triangles.size() + 2, budget);
    EXPECT_GT(result.report.simplification.maxDeviation, 0);
    EXPECT_TRUE(result.report.simplification.warnings.empty());
  }
  Options locked;
  locked.flat = true;
  locked.simplify.triangles = 10;
  const Result open = run(sheet(10, [](double, double) { return 0.0; }), locked);
  EXPECT_GE(open.after.triangles.size(), 38u);  // the 40 vertices of the boundary
  EXPECT_LE(open.after.triangles.size(), 42u);
  EXPECT_EQ(open.report.simplification.warnings.size(), 1u);
}

TEST(Simplify, KeepsTheNormalBound) {
  Options options;
  options.flat = true;
  options.simplify.maxNormalErrorDegrees = 5;
  const Result result = run(test::sphere(60, 90), options);
  EXPECT_LT(result.after.triangles.size(), result.before.triangles.size());
  EXPECT_LE(result.report.simplification.maxNormalDegrees, 5);
}

TEST(Simplify, BoundsThatAreTooTightLeaveTheMeshUnchanged) {
  const Result result = run(test::sphere(12, 15), flatWithin(1e-9));
  EXPECT_EQ(result.after.positions, result.before.positions);
  EXPECT_EQ(result.after.triangles, result.before.triangles);
  EXPECT_EQ(result.report.simplification.maxDeviation, 0);
  ASSERT_EQ(result.report.simplification.warnings.size(), 1u);
  EXPECT_TRUE(contains(result.report.simplification.warnings[0], "unchanged"));
}

TEST(Simplify, IsDeterministicAndKeepsSources) {
  const Mesh sphere = test::sphere(30, 40);
  const Result first = run(sphere, flatWithin(0.02)), second = run(sphere, flatWithin(0.02));
  EXPECT_EQ(first.after.positions, second.after.positions);
  EXPECT_EQ(first.after.triangles, second.after.triangles);
  ASSERT_EQ(first.after.sourceVertices.size(), first.after.positions.size());
  ASSERT_EQ(first.after.sourceFaces.size(), first.after.triangles.size());
  for (std::size_t i = 0; i < first.after.positions.size(); ++i)
    EXPECT_EQ(first.after.positions[i], sphere.positions[first.after.sourceVertices[i]]);
  const Surface surface(first.after);
  for (std::uint32_t i = 0; i < first.after.sourceFaces.size(); ++i) {
    const glm::uvec3 t = sphere.triangles[first.after.sourceFaces[i]];
    const glm::dvec3 centre = (sphere.positions[t.x] + sphere.positions[t.y] + sphere.positions[t.z]) / 3.0;
    EXPECT_LT(distanceToTriangle(centre, surface.triangle(i)), 0.6);  // a face at the same place
  }
}

TEST(Simplify, DoesNotDependOnTheUnit) {
  const Mesh sphere = test::sphere(24, 30);
  const std::size_t expected = run(sphere, flatWithin(0.01)).after.triangles.size();
  for (const double scale : {0x1p-24, 0x1p+20}) {
    Mesh scaled = sphere;
    for (glm::dvec3& p : scaled.positions) p *= scale;
    EXPECT_EQ(run(scaled, flatWithin(0.01 * scale)).after.triangles.size(), expected) << scale;
  }
}

TEST(Simplify, KeepsCreases) {
  Options options;
  options.simplify.maxError = 0.02;
  Mesh lens = test::sphere(40, 60);
  const double top = lens.positions[1 + 13 * 60].z;  // of a ring
  for (glm::dvec3& p : lens.positions) p.z = std::min(p.z, top);
  const Result result = run(lens, options);
  EXPECT_LT(result.after.triangles.size(), result.before.triangles.size() / 2);
  const auto normalsByPosition = [](const Mesh& mesh) {
    std::map<Position, std::vector<glm::vec3>> normals;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) normals[key(mesh.positions[i])].push_back(mesh.normals[i]);
    return normals;
  };
  const auto before = normalsByPosition(result.before), after = normalsByPosition(result.after);
  std::size_t onCreases = 0;
  for (const auto& [position, normals] : after) {
    const std::vector<glm::vec3>& expected = before.at(position);
    EXPECT_EQ(normals.size(), expected.size());
    onCreases += normals.size() == 2 ? 1 : 0;
    for (const glm::vec3& n : normals) {
      float best = -1;
      for (const glm::vec3& e : expected) best = std::max(best, glm::dot(n, e));
      EXPECT_GT(best, 0.9f);
    }
  }
  EXPECT_GT(onCreases, 6u);
}

TEST(Simplify, KeepsBordersOfSmoothingGroups) {
  Mesh mesh = sheet(12, [](double, double) { return 0.0; });
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.smoothingGroups.push_back(i / 24 < 6 ? 1 : 2);
  Options options;
  options.normals = Normals::smoothing;
  options.simplify.maxError = 1e-6;
  const Result result = run(mesh, options);
  EXPECT_LT(result.after.triangles.size(), result.before.triangles.size());
  double areaOfFirst = 0;
  for (std::size_t i = 0; i < result.after.triangles.size(); ++i) {
    const glm::uvec3 t = result.after.triangles[i];
    const glm::dvec3 &a = result.after.positions[t.x], &b = result.after.positions[t.y],
                     &c = result.after.positions[t.z];
    if (result.after.smoothingGroups[i] == 1) areaOfFirst += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  EXPECT_NEAR(areaOfFirst, 0.5, 1e-12);
}

TEST(Simplify, SeveralComponentsAndACertificate) {
  Options options = flatWithin(0.02);
  options.certifyGlass = true;
  Mesh cavity = test::sphere(30, 40);
  for (glm::dvec3& p : cavity.positions) p *= 0.5;
  const Result apart = run(test::joined(test::sphere(30, 40), test::flipped(cavity)), options);
  EXPECT_EQ(apart.report.components.size(), 2u);
  EXPECT_TRUE(apart.report.certificate.isGranted());
  EXPECT_LT(apart.after.triangles.size(), apart.before.triangles.size() / 2);

  // Walls thinner than the bound cross each other: the certificate names the option.
  Mesh close = test::sphere(31, 43);
  for (glm::dvec3& p : close.positions) p *= 0.98;
  options.simplify.maxError = 0.2;
  const Result thin = run(test::joined(test::sphere(30, 40), test::flipped(close)), options);
  ASSERT_FALSE(thin.report.certificate.problems.empty());
  EXPECT_TRUE(contains(thin.report.certificate.problems[0].repair, "--simplify-error"));
}

TEST(Simplify, RefusesBoundsOutOfRange) {
  const auto error = [](auto set) {
    Options options;
    options.flat = true;
    set(options);
    return errorMessage([&] {
      Report report;
      clean(test::cube(), options, report);
    });
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInfinity, 0.0, -1.0}) {
    EXPECT_TRUE(contains(error([&](Options& o) { o.simplify.maxError = bad; }), "--simplify-error")) << bad;
    EXPECT_TRUE(contains(error([&](Options& o) { o.simplify.maxNormalErrorDegrees = bad; }), "--simplify-normal"))
        << bad;
  }
  EXPECT_TRUE(contains(error([](Options& o) { o.simplify.maxNormalErrorDegrees = 181; }), "--simplify-normal"));
  EXPECT_TRUE(contains(error([](Options& o) { o.simplify.triangles = 0; }), "--simplify-triangles"));
  const auto valid = [](auto set) {
    return [set](Options& o) {
      o.simplify.maxError = 1;
      set(o);
    };
  };
  EXPECT_TRUE(contains(error(valid([](Options& o) { o.asIs = true; })), "simplification needs"));
  EXPECT_TRUE(contains(error(valid([](Options& o) { o.steps.orient = false; })), "--skip"));
  EXPECT_TRUE(contains(error(valid([](Options& o) { o.flat = false, o.normals = Normals::authored; })), "--normals"));
}

TEST(Simplify, LeavesAMoebiusStripUnchanged) {
  Mesh strip;
  constexpr std::uint32_t kColumns = 40;
  for (std::uint32_t i = 0; i < kColumns; ++i)
    for (const double side : {-0.2, 0.0, 0.2}) {
      const double u = 2 * 3.14159265358979 * i / kColumns, r = 1 + side * std::cos(u / 2);
      strip.positions.emplace_back(r * std::cos(u), r * std::sin(u), side * std::sin(u / 2));
    }
  const auto at = [](std::uint32_t i, std::uint32_t j) { return i < kColumns ? 3 * i + j : 2 - j; };
  for (std::uint32_t i = 0; i < kColumns; ++i)
    for (std::uint32_t j = 0; j < 2; ++j) {
      strip.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      strip.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  const Result result = run(strip, flatWithin(0.05));
  EXPECT_EQ(result.after.triangles, result.before.triangles);
  EXPECT_EQ(result.report.simplification.warnings.size(), 1u);
}

}  // namespace
}  // namespace malus::prep

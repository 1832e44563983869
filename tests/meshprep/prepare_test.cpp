#include "meshprep/prepare.h"

#include <gtest/gtest.h>

#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorOf;
using test::TemporaryFile;

// A cube as a careless modeller leaves it: corners not shared, a copy, two degenerate faces, a loose vertex,
// one side inside out.
std::string messyCube() {
  const Mesh cube = test::cube();
  std::string text = "v 9 9 9\n";
  int corner = 2;
  const auto addFace = [&](const glm::uvec3& t) {
    for (int i = 0; i < 3; ++i)
      text += fmt::format("v {} {} {}\n", cube.positions[t[i]].x, cube.positions[t[i]].y, cube.positions[t[i]].z);
    text += fmt::format("f {} {} {}\n", corner, corner + 1, corner + 2);
    corner += 3;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    const glm::uvec3 t = cube.triangles[i];
    addFace(i < 2 ? glm::uvec3(t.x, t.z, t.y) : t);
  }
  const glm::uvec3 last = cube.triangles[11];
  addFace({last.y, last.z, last.x});
  addFace({0, 0, 1});
  text += "f 2 2 3\n";
  return text;
}

TEST(Prepare, MessyCubeBecomesACube) {
  const TemporaryFile file(".obj", messyCube());
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(report.source, file.path().string());
  EXPECT_EQ(report.input.vertices, 43u);
  EXPECT_EQ(report.input.faces, 15u);
  EXPECT_EQ(report.count("vertices-welded"), 34u);
  EXPECT_EQ(report.count("faces-dropped-repeated-corner"), 2u);
  EXPECT_EQ(report.count("faces-dropped-duplicate"), 1u);
  EXPECT_EQ(report.count("vertices-dropped-unreferenced"), 1u);
  EXPECT_EQ(report.count("faces-turned-over"), 2u);
  EXPECT_EQ(report.count("vertices-added-at-creases"), 16u);
  EXPECT_EQ(report.output.vertices, 24u);
  EXPECT_EQ(report.output.triangles, 12u);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.normals.size(), 24u);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_TRUE(report.components[0].closed);
  EXPECT_EQ(report.components[0].flipped, 2u);
  EXPECT_NEAR(report.components[0].signedVolume, 1, 1e-12);
  // Nothing is dropped uncounted.
  EXPECT_EQ(report.input.faces - report.count("faces-dropped-repeated-corner") -
                report.count("faces-dropped-zero-area") - report.count("faces-dropped-duplicate") -
                report.count("faces-dropped-opposite"),
            report.output.triangles);
  EXPECT_EQ(report.input.vertices - report.count("vertices-welded") - report.count("vertices-dropped-unreferenced") +
                report.count("vertices-added-at-creases"),
            report.output.vertices);
}

TEST(Prepare, FlatKeepsEightCornersAndStoresNoNormals) {
  const TemporaryFile file(".obj", messyCube());
  Report report;
  Options options;
  options.flat = true;
  const Mesh mesh = prepare(file.path(), options, report);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(report.output.vertices, 8u);
}

TEST(Prepare, CleanMeshPassesUntouched) {
  const Mesh sphere = test::sphere(9, 16);
  const TemporaryFile file(".obj", test::objText(sphere));
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(mesh.positions, sphere.positions);
  EXPECT_EQ(mesh.triangles, sphere.triangles);
  for (const Step& step : report.steps) EXPECT_EQ(step.count, 0u) << step.name;
}

TEST(Prepare, TwiceIsOnce) {
  const TemporaryFile file(".obj", messyCube());
  Report report;
  const Mesh once = prepare(file.path(), {}, report);
  const TemporaryFile again(".obj", test::objText(once));
  const Mesh twice = prepare(again.path(), {}, report);
  EXPECT_EQ(once.positions, twice.positions);
  EXPECT_EQ(once.triangles, twice.triangles);
  EXPECT_EQ(once.normals, twice.normals);
}

TEST(Prepare, NonManifoldInputStaysUncracked) {
  // A cube with a fin: OpenMesh would give the fin vertices of its own.
  Mesh mesh = test::cube();
  mesh.positions.emplace_back(2, 2, 0.5);
  mesh.triangles.emplace_back(3, 7, 8);
  const TemporaryFile file(".obj", test::objText(mesh));
  Report report;
  Options options;
  options.flat = true;
  const Mesh result = prepare(file.path(), options, report);
  EXPECT_EQ(result.positions, mesh.positions);
  EXPECT_EQ(result.triangles, mesh.triangles);
  EXPECT_EQ(report.count("edges-non-manifold"), 1u);
  EXPECT_EQ(report.count("edges-boundary"), 2u);
}

TEST(Prepare, StlWeldsToTheSameTetrahedronAsPly) {
  const TemporaryFile stl(".stl", test::binaryStl(test::tetrahedronTriangles()));
  const TemporaryFile ply(".ply", test::binaryPly());
  Report report;
  Options options;
  options.flat = true;
  EXPECT_EQ(prepare(stl.path(), options, report).positions.size(), 4u);
  EXPECT_EQ(report.input.vertices, 12u);
  EXPECT_TRUE(report.components[0].closed);
  EXPECT_EQ(prepare(ply.path(), options, report).positions.size(), 4u);
  EXPECT_NEAR(report.components[0].signedVolume, 0.1 / 6, 1e-8);
}

TEST(Prepare, SheetKeepsItsBackAndItsSide) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n");
  Report report;
  Options options;
  options.flat = true;
  EXPECT_EQ(prepare(file.path(), options, report).triangles.size(), 3u + 1u);
  options.sheet = true;
  EXPECT_EQ(prepare(file.path(), options, report).triangles.size(), 4u);
}

TEST(Prepare, QuadsAreCounted) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 1 2 3 4\n");
  Report report;
  EXPECT_EQ(prepare(file.path(), {}, report).triangles.size(), 2u);
  EXPECT_EQ(report.count("polygons-triangulated"), 1u);
  EXPECT_EQ(report.count("polygons-concave"), 1u);
}

TEST(Prepare, BadOptionsAndNothingLeft) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  Report report;
  EXPECT_TRUE(contains(errorOf([&] { prepare(file.path(), {}, report); }), "nothing is left"));
  Options options;
  options.creaseDegrees = 200;
  EXPECT_TRUE(contains(errorOf([&] { prepare(file.path(), options, report); }), "0 to 180"));
  options.creaseDegrees = 40;
  options.weldTolerance = -1;
  EXPECT_TRUE(contains(errorOf([&] { prepare(file.path(), options, report); }), "weld tolerance"));
}

// A face without area, a copy of a face, a vertex that nothing uses, normals of any length.
constexpr const char* kBadOnPurpose =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\nelement face 3\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0 2\n1 0 0 0 0 -1\n0 1 0 1 0 0\n9 9 9 0 3 4\n3 0 1 2\n3 0 1 2\n3 0 1 0\n";

TEST(Prepare, AsItIsCleansNothing) {
  const TemporaryFile file(".ply", kBadOnPurpose);
  Options options;
  options.asIs = true;
  Report report;
  const Mesh mesh = prepare(file.path(), options, report);
  ASSERT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, -1));
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0.6f, 0.8f));
  EXPECT_EQ(report.output.vertices, 4u);
  EXPECT_EQ(report.output.triangles, 3u);
  options.flat = true;
  EXPECT_TRUE(prepare(file.path(), options, report).normals.empty());
}

TEST(Prepare, AsItIsNeedsNormals) {
  Options options;
  options.asIs = true;
  Report report;
  const TemporaryFile without(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(contains(errorOf([&] { prepare(without.path(), options, report); }), "has no normals"));
  std::string text = kBadOnPurpose;
  text.replace(text.find("0 0 2\n"), 5, "0 0 0");
  const TemporaryFile zero(".ply", text);
  EXPECT_TRUE(contains(errorOf([&] { prepare(zero.path(), options, report); }), "vertex 0 has no length"));
}

}  // namespace
}  // namespace malus::prep

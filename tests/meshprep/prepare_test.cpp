#include "meshprep/prepare.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::TemporaryFile;

// Cube with defects: separate corners, a duplicate face, two degenerate faces, an unused vertex, one flipped side.
std::string defectiveCube() {
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

TEST(Prepare, RepairsACube) {
  const TemporaryFile file(".obj", defectiveCube());
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(report.source, file.path().string());
  EXPECT_EQ(report.input.vertices, 43u);
  EXPECT_EQ(report.input.faces, 15u);
  EXPECT_EQ(report.count("vertices-welded"), 34u);
  EXPECT_EQ(report.count("faces-dropped-repeated-corner"), 2u);
  EXPECT_EQ(report.count("faces-dropped-duplicate"), 1u);
  EXPECT_EQ(report.count("vertices-dropped-unreferenced"), 1u);
  EXPECT_EQ(report.count("faces-flipped"), 2u);
  EXPECT_EQ(report.count("vertices-added-at-creases"), 16u);
  EXPECT_EQ(report.output.vertices, 24u);
  EXPECT_EQ(report.output.triangles, 12u);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.normals.size(), 24u);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_TRUE(report.components[0].closed);
  EXPECT_EQ(report.components[0].flipped, 2u);
  EXPECT_NEAR(report.components[0].signedVolume, 1, 1e-12);
  // All dropped faces and vertices are counted.
  EXPECT_EQ(report.input.faces - report.count("faces-dropped-repeated-corner") -
                report.count("faces-dropped-zero-area") - report.count("faces-dropped-duplicate") -
                report.count("faces-dropped-opposite"),
            report.output.triangles);
  EXPECT_EQ(report.input.vertices - report.count("vertices-welded") - report.count("vertices-dropped-unreferenced") +
                report.count("vertices-added-at-creases"),
            report.output.vertices);
}

TEST(Prepare, KeepsEightVerticesOfAFlatCube) {
  const TemporaryFile file(".obj", defectiveCube());
  Report report;
  Options options;
  options.flat = true;
  const Mesh mesh = prepare(file.path(), options, report);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(report.output.vertices, 8u);
}

TEST(Prepare, KeepsACleanMesh) {
  const Mesh sphere = test::sphere(9, 16);
  const TemporaryFile file(".obj", test::objText(sphere));
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(mesh.positions, sphere.positions);
  EXPECT_EQ(mesh.triangles, sphere.triangles);
  for (const Step& step : report.steps) EXPECT_EQ(step.count, 0u) << step.name;
}

TEST(Prepare, IsIdempotent) {
  const TemporaryFile file(".obj", defectiveCube());
  Report report;
  const Mesh once = prepare(file.path(), {}, report);
  const TemporaryFile again(".obj", test::objText(once));
  const Mesh twice = prepare(again.path(), {}, report);
  EXPECT_EQ(once.positions, twice.positions);
  EXPECT_EQ(once.triangles, twice.triangles);
  EXPECT_EQ(once.normals, twice.normals);
}

// Random boxes and triangles on a small grid, so that vertices, edges and faces coincide.
Mesh randomFaces(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  Mesh mesh;
  for (int i = 0; i < 3; ++i) {
    Mesh box = test::cube(1, glm::dvec3(draw(3), draw(3), draw(2)));
    if (draw(2) == 0) box = test::flipped(box);
    if (draw(3) == 0) box.triangles.resize(10);
    mesh = test::joined(std::move(mesh), box);
  }
  const int loose = draw(6);
  for (int i = 0; i < loose; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) mesh.positions.emplace_back(draw(4), draw(4), draw(3) + (draw(8) == 0 ? 1e-7 : 0.0));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  for (int i = 0; i < 4; ++i) {
    const std::size_t t = random() % mesh.triangles.size();
    std::swap(mesh.triangles[t].x, mesh.triangles[t].y);
    if (draw(2) == 0) mesh.triangles.push_back(mesh.triangles[random() % mesh.triangles.size()]);
  }
  // Vertices on edges, some at an end within rounding, connected by faces without area.
  for (int i = 0; seed % 4 > 1 && i < 6; ++i) {
    const std::size_t t = random() % mesh.triangles.size();
    const glm::uvec3 v = mesh.triangles[t];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    const double share = draw(3) == 0 ? 1e-13 : (draw(8) + 1) / 10.0;
    mesh.positions.push_back(mesh.positions[v.x] + share * (mesh.positions[v.y] - mesh.positions[v.x]));
    mesh.triangles[t] = {v.x, middle, v.z};
    mesh.triangles.emplace_back(middle, v.y, v.z);
    if (draw(3) > 0) mesh.triangles.emplace_back(v.x, v.y, middle);
  }
  for (glm::dvec3& p : mesh.positions)
    if (seed % 4 == 3) p += 1e-13 * glm::dvec3(draw(3) - 1, draw(3) - 1, draw(3) - 1);
  return mesh;
}

TEST(Prepare, IsIdempotentForRandomFaces) {
  std::uint64_t changes = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    Options options;
    options.flat = seed % 2 == 0;
    options.steps.weldTolerance = seed % 3 == 0 ? 1e-6 : 0;
    options.steps.fillHoles = seed % 5 == 0 ? 8 : 0;
    Report report;
    Mesh once = clean(randomFaces(seed), options, report);
    for (const Step& step : report.steps) changes += step.count;
    EXPECT_EQ(report.count("edges-non-manifold"), 0u) << seed;
    EXPECT_EQ(report.count("cleaning-not-converged"), 0u) << seed;
    Mesh again;
    again.positions = once.positions;
    again.triangles = once.triangles;
    Report second;
    const Mesh twice = clean(again, options, second);
    EXPECT_TRUE(twice.positions == once.positions) << seed;
    EXPECT_TRUE(twice.triangles == once.triangles) << seed;
    EXPECT_TRUE(twice.normals == once.normals) << seed;
    for (const char* step :
         {"faces-dropped-repeated-corner", "faces-dropped-zero-area", "faces-dropped-duplicate",
          "vertices-dropped-unreferenced", "faces-flipped", "holes-filled", "edges-cut", "edges-collapsed"})
      EXPECT_EQ(second.count(step), 0u) << seed << ' ' << step;
  }
  EXPECT_GT(changes, 20000u);
}

TEST(Prepare, DoesNotCrackNonManifoldMeshes) {
  // Cube with a fin: the fin gets separate vertices at the same positions.
  Mesh mesh = test::cube();
  mesh.positions.emplace_back(2, 2, 0.5);
  mesh.triangles.emplace_back(3, 7, 8);
  const TemporaryFile file(".obj", test::objText(mesh));
  Report report;
  Options options;
  options.flat = true;
  const Mesh result = prepare(file.path(), options, report);
  ASSERT_EQ(result.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(result.positions[result.triangles[i][k]], mesh.positions[mesh.triangles[i][k]]);
  EXPECT_EQ(result.positions.size(), 11u);
  EXPECT_EQ(report.count("edges-separated"), 1u);
  EXPECT_EQ(report.count("vertices-split"), 2u);
  EXPECT_EQ(report.count("edges-non-manifold"), 0u);
  EXPECT_EQ(report.count("edges-boundary"), 3u);

  options.steps.fans = false;
  EXPECT_EQ(prepare(file.path(), options, report).positions, mesh.positions);
  EXPECT_EQ(report.count("edges-non-manifold"), 1u);
}

TEST(Prepare, LocatesFindings) {
  const TemporaryFile file(".obj", defectiveCube());
  Report report;
  prepare(file.path(), {}, report);
  const auto step = [&](std::string_view name) -> const Step& {
    return *std::find_if(report.steps.begin(), report.steps.end(), [&](const Step& s) { return s.name == name; });
  };
  const Step& dropped = step("faces-dropped-duplicate");
  ASSERT_EQ(dropped.findings.size(), 1u);
  EXPECT_EQ(dropped.findings[0].faces, (std::vector<std::uint32_t>{12, 11}));
  const Step& unreferenced = step("vertices-dropped-unreferenced");
  EXPECT_EQ(unreferenced.findings.at(0).vertices, std::vector<std::uint32_t>{0});
  EXPECT_EQ(unreferenced.findings.at(0).at, glm::dvec3(9));
  EXPECT_EQ(step("vertices-welded").findings.size(), 34u);
  EXPECT_EQ(step("faces-flipped").findings.size(), 2u);
  EXPECT_EQ(step("faces-flipped").findings[0].faces, std::vector<std::uint32_t>{0});
}

TEST(Prepare, SkipsSteps) {
  const TemporaryFile file(".obj", defectiveCube());
  const auto count = [&](bool Cleaning::*left, std::string_view step) {
    Options options;
    options.flat = true;
    options.steps.*left = false;
    Report report;
    prepare(file.path(), options, report);
    return report.count(step);
  };
  Report all;
  prepare(file.path(), {}, all);
  for (const auto& [left, step] :
       std::vector<std::pair<bool Cleaning::*, const char*>>{{&Cleaning::weld, "vertices-welded"},
                                                             {&Cleaning::degenerate, "faces-dropped-repeated-corner"},
                                                             {&Cleaning::duplicates, "faces-dropped-duplicate"},
                                                             {&Cleaning::unreferenced, "vertices-dropped-unreferenced"},
                                                             {&Cleaning::orient, "faces-flipped"}}) {
    EXPECT_GT(all.count(step), 0u) << step;
    EXPECT_EQ(count(left, step), 0u) << step;
  }
}

TEST(Prepare, KeepsUnusedVerticesOnRequest) {
  Mesh mesh = test::cube();
  mesh.positions.insert(mesh.positions.begin() + 3, glm::dvec3(1e6, 0, 0));
  for (glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) t[k] += t[k] >= 3 ? 1 : 0;
  Options options;
  options.steps.unreferenced = false;
  options.weldRelative = 1e-7;  // relative to the cube without the unused vertex
  Report report;
  const Mesh cleaned = clean(mesh, options, report);
  EXPECT_EQ(report.count("vertices-dropped-unreferenced"), 0u);
  EXPECT_EQ(report.count("vertices-added-at-creases"), 16u);
  ASSERT_EQ(cleaned.positions.size(), 25u);
  EXPECT_EQ(std::count(cleaned.positions.begin(), cleaned.positions.end(), glm::dvec3(1e6, 0, 0)), 1);
  ASSERT_EQ(cleaned.normals.size(), 25u);
}

TEST(Prepare, WeldsStl) {
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

TEST(Prepare, KeepsTheBackOfAnOpenSurface) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 2 1\n");
  Report report;
  Options options;
  options.flat = true;
  EXPECT_EQ(prepare(file.path(), options, report).triangles.size(), 2u);
  EXPECT_EQ(report.count("faces-opposite"), 1u);
  options.steps.dropOpposite = true;
  EXPECT_LT(prepare(file.path(), options, report).triangles.size(), 2u);
  options.steps.dropOpposite = false;
  options.openSurface = true;
  EXPECT_EQ(prepare(file.path(), options, report).triangles.size(), 2u);
  EXPECT_EQ(report.count("faces-flipped"), 0u);
}

TEST(Prepare, CountsQuads) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 1 2 3 4\n");
  Report report;
  EXPECT_EQ(prepare(file.path(), {}, report).triangles.size(), 2u);
  EXPECT_EQ(report.count("polygons-triangulated"), 1u);
  EXPECT_EQ(report.count("polygons-concave"), 1u);
}

TEST(Prepare, LeavesOutFacesOfFewerCorners) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf\nf 1 2 3\n");
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.sourceFaces, (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(report.count("faces-dropped-few-corners"), 2u);
  EXPECT_EQ(report.input.faces, 3u);
  const TemporaryFile lines(".obj", "v 0 0 0\nv 1 0 0\nf 1 2\n");
  Options options;
  options.asIs = options.flat = true;
  EXPECT_CONTAINS(errorMessage([&] { prepare(lines.path(), options, report); }), "three corners");
}

TEST(Prepare, RefusesInvalidOptionsAndEmptyResults) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  Report report;
  EXPECT_TRUE(contains(errorMessage([&] { prepare(file.path(), {}, report); }), "no triangle is left"));
  Options options;
  options.creaseDegrees = 200;
  EXPECT_TRUE(contains(errorMessage([&] { prepare(file.path(), options, report); }), "0 to 180"));
  options.creaseDegrees = 40;
  options.steps.weldTolerance = -1;
  EXPECT_TRUE(contains(errorMessage([&] { prepare(file.path(), options, report); }), "weld tolerance"));
}

// A face without area, a duplicate face, an unused vertex, normals of any length.
constexpr const char* kDefectiveMesh =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\nelement face 3\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0 2\n1 0 0 0 0 -1\n0 1 0 1 0 0\n9 9 9 0 3 4\n3 0 1 2\n3 0 1 2\n3 0 1 0\n";

TEST(Prepare, KeepsDefectsWithAsIs) {
  const TemporaryFile file(".ply", kDefectiveMesh);
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

TEST(Prepare, RequiresNormalsWithAsIs) {
  Options options;
  options.asIs = true;
  Report report;
  const TemporaryFile without(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(contains(errorMessage([&] { prepare(without.path(), options, report); }), "no normals"));
  std::string text = kDefectiveMesh;
  text.replace(text.find("0 0 2\n"), 5, "0 0 0");
  const TemporaryFile zero(".ply", text);
  EXPECT_TRUE(contains(errorMessage([&] { prepare(zero.path(), options, report); }), "vertex 0", "length"));
}

}  // namespace
}  // namespace malus::prep

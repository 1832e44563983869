// Seams of texture coordinates split vertices after cleaning, which sees the welded surface.
#include "meshprep/textures/texture_vertices.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/prepare.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::TemporaryFile;

// Returns a cube of quads. Each of its six charts has a sixth of the image.
std::string cubeWithCharts(bool charts = true) {
  std::string text;
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1);
  for (int i = 0; i < 6; ++i) text += fmt::format("vt {0} 0\nvt {1} 0\nvt {1} 1\nvt {0} 1\n", i / 6.0, (i + 0.5) / 6);
  const int faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (int i = 0; i < 6; ++i) {
    text += "f";
    for (int k = 0; k < 4; ++k)
      text += charts ? fmt::format(" {}/{}", faces[i][k], 4 * i + k + 1) : fmt::format(" {}", faces[i][k]);
    text += "\n";
  }
  return text;
}

Mesh prepared(const std::string& text, Options options, Report& report) {
  const TemporaryFile file(".obj", text);
  return prepare(file.path(), options, report);
}

TEST(TextureVertices, ACubeOfSixChartsStaysClosed) {
  Options options;
  options.keepTextures = true;
  options.certifyGlass = true;
  options.creaseDegrees = 180;  // smooth: the normals split no vertex
  Report report;
  const Mesh mesh = prepared(cubeWithCharts(), options, report);
  EXPECT_TRUE(report.certificate.isGranted());
  EXPECT_EQ(report.count("edges-boundary"), 0u);
  EXPECT_EQ(report.count("vertices-added-at-creases"), 0u);
  EXPECT_EQ(report.count("vertices-added-at-seams"), 16u);
  ASSERT_EQ(mesh.positions.size(), 24u);
  ASSERT_EQ(mesh.textureCoordinates[0].size(), 24u);
  EXPECT_EQ(mesh.normals.size(), 24u);
  EXPECT_EQ(mesh.sourceVertices.size(), 24u);
  EXPECT_TRUE(mesh.textureCoordinates[1].empty());
  EXPECT_TRUE(mesh.tangents.empty());

  // Flat, and without coordinates.
  options.flat = true;
  EXPECT_EQ(prepared(cubeWithCharts(), options, report).positions.size(), 24u);
  EXPECT_EQ(prepared(cubeWithCharts(false), options, report).positions.size(), 8u);
  options.keepTextures = false;
  EXPECT_EQ(prepared(cubeWithCharts(), options, report).positions.size(), 8u);
  EXPECT_EQ(report.count("vertices-added-at-seams"), 0u);
}

// Creases split the vertices of a cube already: its charts add none.
TEST(TextureVertices, SeamsAtCreasesShareTheirVertices) {
  Options options;
  options.keepTextures = true;
  Report report;
  const Mesh mesh = prepared(cubeWithCharts(), options, report);
  EXPECT_EQ(report.count("vertices-added-at-creases"), 16u);
  EXPECT_EQ(report.count("vertices-added-at-seams"), 0u);
  EXPECT_EQ(mesh.positions.size(), 24u);
}

// Every corner keeps its coordinates through welding, dropped faces and flipped faces.
TEST(TextureVertices, CornersKeepTheirCoordinates) {
  std::string text;
  const Mesh cube = test::cube();
  int corner = 1;
  const auto uv = [](const glm::dvec3& p) { return glm::vec2(p.x + 2 * p.z, p.y - p.z); };
  for (std::size_t i = 0; i < cube.triangles.size(); ++i) {
    glm::uvec3 t = cube.triangles[i];
    if (i % 3 == 0) std::swap(t.y, t.z);  // cleaning flips it back
    for (int repeat = 0; repeat < (i == 5 ? 2 : 1); ++repeat) {
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = cube.positions[t[k]];
        text += fmt::format("v {} {} {}\nvt {} {}\n", p.x, p.y, p.z, uv(p).x, 1 - uv(p).y);
      }
      text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", corner, corner + 1, corner + 2);
      corner += 3;
    }
  }
  Options options;
  options.keepTextures = true;
  options.flat = true;
  Report report;
  const Mesh mesh = prepared(text, options, report);
  EXPECT_GT(report.count("faces-flipped"), 0u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  ASSERT_EQ(mesh.positions.size(), 8u);  // the coordinates are those of the position: there is no seam
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(mesh.textureCoordinates[0][v], uv(mesh.positions[v])) << v;
}

// A triangle beside a flat one is cut, and a hole is filled.
TEST(TextureVertices, NewCornersHaveCoordinatesInBetween) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  mesh.cornerTextures.resize(6);
  mesh.hasCoordinates = {true, false};
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const glm::dvec3 p = mesh.positions[mesh.triangles[corner / 3][static_cast<int>(corner % 3)]];
    mesh.cornerTextures[corner].coordinates[0] = {p.x / 4, p.y / 4};
  }
  Options options;
  options.openSurface = true;
  options.flat = true;
  Report report;
  const Mesh cleaned = clean(mesh, options, report);
  EXPECT_EQ(report.count("faces-cut-beside-zero-area"), 1u);
  ASSERT_EQ(cleaned.textureCoordinates[0].size(), cleaned.positions.size());
  for (std::size_t v = 0; v < cleaned.positions.size(); ++v)
    EXPECT_EQ(cleaned.textureCoordinates[0][v], glm::vec2(cleaned.positions[v].x / 4, cleaned.positions[v].y / 4));

  options.keepTextures = true;
  options.openSurface = false;
  options.steps.fillHoles = 4;
  std::string open = cubeWithCharts();
  open.resize(open.rfind("f "));
  const Mesh filled = prepared(open, options, report);
  EXPECT_EQ(report.count("holes-filled"), 1u);
  EXPECT_EQ(report.count("texture-corners-filled"), 6u);
  EXPECT_EQ(filled.textureCoordinates[0].size(), filled.positions.size());
}

// One triangle, ccw seen from +z.
Mesh triangleWithTangents(const std::array<glm::vec2, 3>& uv, const glm::vec4& tangent) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.cornerTextures.resize(3);
  for (std::size_t i = 0; i < 3; ++i) mesh.cornerTextures[i] = {{uv[i], {}}, tangent};
  mesh.hasCoordinates = {true, false};
  mesh.hasTangents = true;
  mesh.flipped = {0};
  return mesh;
}

TEST(TextureVertices, TangentsWithoutADirectionFollowTheCoordinates) {
  // The image upright: u along +x, v down along -y.
  Mesh mesh = triangleWithTangents({{{0, 1}, {1, 1}, {0, 0}}}, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(addTextureVertices(mesh).tangents, 3u);
  for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
  // Mirrored: u along -x.
  mesh = triangleWithTangents({{{1, 1}, {0, 1}, {1, 0}}}, glm::vec4(0, 0, 0, 1));
  addTextureVertices(mesh);
  for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1));
  // Without an area in the image.
  mesh = triangleWithTangents({}, glm::vec4(0, 0, 0, -1));
  addTextureVertices(mesh);
  for (const glm::vec4& t : mesh.tangents) EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
}

TEST(TextureVertices, FlippedTrianglesKeepTheirBitangents) {
  for (const bool flipped : {false, true}) {
    Mesh mesh = triangleWithTangents({}, glm::vec4(2, 0, 0, 1));
    mesh.flipped = {static_cast<char>(flipped ? 1 : 0)};
    mesh.cornerNormals.assign(3, glm::vec3(0, 0, flipped ? -1 : 1));
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    addTextureVertices(mesh);
    for (const glm::vec4& t : mesh.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, flipped ? -1 : 1));
  }
}

}  // namespace
}  // namespace malus::prep

// Simplification of meshes with texture coordinates: seams stay, corners keep the coordinates of their chart.
#include "meshprep/simplify/seams.h"

#include <algorithm>
#include <cstdint>
#include <functional>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/prepare.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

constexpr int kSide = 16;

// A flat square of 2 x 16 x 16 triangles from -1 to 1. uv: of a position and the chart, 0 for x < 0 and 1 else.
Mesh squareWith(const std::function<glm::vec2(const glm::dvec3&, int)>& uv) {
  Mesh mesh;
  const auto at = [](int i) { return 2.0 * i / kSide - 1; };
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) mesh.positions.emplace_back(at(x), at(y), 0);
  const auto vertex = [](int x, int y) { return static_cast<std::uint32_t>(y * (kSide + 1) + x); };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      mesh.triangles.emplace_back(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1));
      mesh.triangles.emplace_back(vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1));
      for (int corner = 0; corner < 6; ++corner) {
        const std::size_t triangle = mesh.triangles.size() - 2 + static_cast<std::size_t>(corner / 3);
        const glm::dvec3& p = mesh.positions[mesh.triangles[triangle][corner % 3]];
        mesh.cornerTextures.push_back({{uv(p, x < kSide / 2 ? 0 : 1), {}}});
      }
    }
  mesh.hasCoordinates = {true, false};
  return mesh;
}

glm::vec2 chart(const glm::dvec3& p, int i) { return {p.x * 0.5 + 10 * i, p.y * 0.5}; }

Options simplified(double error) {
  Options options;
  options.flat = true;
  options.openSurface = true;
  options.simplify.maxError = error;
  return options;
}

TEST(Seams, StayWhereTheyAre) {
  Report report;
  const Mesh mesh = clean(squareWith(chart), simplified(1e-3), report);
  EXPECT_LT(mesh.triangles.size(), 512u / 2);
  EXPECT_EQ(report.count("vertices-added-at-seams"), 17u);  // the seam does not lose a vertex
  for (const glm::uvec3& t : mesh.triangles) {
    double low = 1, high = -1;
    for (int k = 0; k < 3; ++k)
      low = std::min(low, mesh.positions[t[k]].x), high = std::max(high, mesh.positions[t[k]].x);
    EXPECT_TRUE(high <= 0 || low >= 0);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.textureCoordinates[0][t[k]], chart(mesh.positions[t[k]], high <= 0 ? 0 : 1));
  }
}

// The same square with coordinates that are not linear: the image may move by the bound.
TEST(Seams, TheImageMovesByNoMoreThanTheBound) {
  const auto curved = [](const glm::dvec3& p, int) { return glm::vec2(p.x + 0.2 * p.x * p.x, p.y); };
  std::size_t last = 0;
  for (const double bound : {1.0, 0.01, 1e-5}) {
    Report report;
    const Mesh source = squareWith(curved), mesh = clean(source, simplified(bound), report);
    EXPECT_GE(mesh.triangles.size(), last);
    last = mesh.triangles.size();
    // Compare at the vertices of the source, in the plane.
    for (const glm::dvec3& p : source.positions)
      for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const double area = glm::cross(b - a, c - a).z, y = glm::cross(p - a, c - a).z / area,
                     z = glm::cross(b - a, p - a).z / area;
        if (y < 0 || z < 0 || y + z > 1) continue;
        const auto uv = [&](std::uint32_t v) { return glm::dvec2(mesh.textureCoordinates[0][v]); };
        const glm::dvec2 found = uv(t.x) + y * (uv(t.y) - uv(t.x)) + z * (uv(t.z) - uv(t.x));
        EXPECT_LE(glm::distance(found, glm::dvec2(curved(p, 0))), 1.3 * bound + 1e-6);  // du/dx is 0.6 to 1.4
      }
  }
  EXPECT_EQ(last, 512u);
}

TEST(Seams, CutAndJoinedMeshesAreTheSame) {
  const Mesh source = squareWith(chart);
  Mesh mesh = source;
  const Seams seams(mesh);
  EXPECT_EQ(mesh.positions.size(), source.positions.size() + 17);
  EXPECT_TRUE(mesh.cornerTextures.empty());
  seams.join(mesh);
  EXPECT_EQ(mesh.positions, source.positions);
  EXPECT_EQ(mesh.triangles, source.triangles);
  ASSERT_EQ(mesh.cornerTextures.size(), source.cornerTextures.size());
  for (std::size_t i = 0; i < source.cornerTextures.size(); ++i)
    EXPECT_EQ(mesh.cornerTextures[i].coordinates, source.cornerTextures[i].coordinates);
}

}  // namespace
}  // namespace malus::prep

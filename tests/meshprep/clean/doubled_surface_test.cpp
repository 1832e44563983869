// Surfaces of which every face occurs twice, back to back.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "meshprep/clean/duplicate_faces.h"
#include "meshprep/prepare.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

// Cleans with flat normals, and cleans the result again, which must not change it.
Mesh cleanTwice(const Mesh& mesh, Report& report) {
  Options options;
  options.flat = true;
  const Mesh once = clean(mesh, options, report);
  Mesh again;
  again.positions = once.positions;
  again.triangles = once.triangles;
  Report second;
  const Mesh twice = clean(again, options, second);
  EXPECT_EQ(twice.positions, once.positions);
  EXPECT_EQ(twice.triangles, once.triangles);
  EXPECT_EQ(report.count("faces-dropped-duplicate"), 0u);
  EXPECT_EQ(report.count("cleaning-not-converged"), 0u);
  return once;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles)
    sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
  return sum;
}

TEST(DoubledSurface, KeepsBothSidesOfClosedSurfaces) {
  for (const Mesh& mesh : {test::cube(), test::sphere(9, 16)})
    for (const bool insideFirst : {false, true}) {
      const Mesh doubled =
          insideFirst ? test::joined(test::flipped(mesh), mesh) : test::joined(mesh, test::flipped(mesh));
      Report report;
      const Mesh once = cleanTwice(doubled, report);
      EXPECT_EQ(once.triangles.size(), doubled.triangles.size());
      EXPECT_NEAR(volume(once), 0, 1e-12);
    }
}

TEST(DoubledSurface, KeepsBothSidesOfOpenSurfaces) {
  Mesh sheet = test::sphere(9, 16);
  sheet.triangles.resize(100);
  Report report;
  EXPECT_EQ(cleanTwice(test::joined(sheet, test::flipped(sheet)), report).triangles.size(), 200u);
}

TEST(DoubledSurface, KeepsTheWallBetweenTwoBodies) {
  const Mesh bodies = test::joined(test::cube(), test::cube(1, {1, 0, 0}));
  Report report;
  const Mesh once = cleanTwice(bodies, report);
  EXPECT_EQ(once.triangles.size(), 24u);
  EXPECT_NEAR(volume(once), 2, 1e-12);
  for (const Component& component : report.components) EXPECT_TRUE(component.closed);
}

TEST(DoubledSurface, StillDropsCopiesOfTheSameSide) {
  Report report;
  Options options;
  options.flat = true;
  const Mesh once = clean(test::joined(test::sphere(5, 8), test::sphere(5, 8)), options, report);
  EXPECT_EQ(once.triangles.size(), test::sphere(5, 8).triangles.size());
}

// Cubes in a row, of which every second one is inside out: the walls between them have faces of one orientation.
TEST(DoubledSurface, KeepsWallsBesideABodyThatIsInsideOut) {
  Mesh bodies = test::cube();
  for (int i = 1; i < 4; ++i) {
    const Mesh next = test::cube(1, {i, 0, 0});
    bodies = test::joined(bodies, i % 2 == 1 ? test::flipped(next) : next);
    Report report;
    const Mesh once = cleanTwice(bodies, report);
    EXPECT_EQ(once.triangles.size(), bodies.triangles.size());
    EXPECT_EQ(report.count("faces-kept-walls"), static_cast<std::uint64_t>(2 * i));
    EXPECT_NEAR(volume(once), i + 1, 1e-12);
    EXPECT_EQ(report.components.size(), static_cast<std::size_t>(i + 1));
    for (const Component& component : report.components) EXPECT_TRUE(component.closed);
  }
}

// Vertices with equal positions become one, as in a file that stores each position once.
Mesh withSharedVertices(const Mesh& mesh) {
  Mesh result;
  std::vector<std::uint32_t> become;
  for (const glm::dvec3& p : mesh.positions) {
    const auto found = std::find(result.positions.begin(), result.positions.end(), p);
    become.push_back(static_cast<std::uint32_t>(found - result.positions.begin()));
    if (found == result.positions.end()) result.positions.push_back(p);
  }
  for (const glm::uvec3& t : mesh.triangles) result.triangles.emplace_back(become[t.x], become[t.y], become[t.z]);
  return result;
}

TEST(DoubledSurface, KeepsWallsWhoseVerticesAreSharedInTheFile) {
  for (const bool insideOut : {false, true}) {
    const Mesh next = test::cube(1, {1, 0, 0});
    const Mesh bodies = withSharedVertices(test::joined(test::cube(), insideOut ? test::flipped(next) : next));
    ASSERT_EQ(bodies.positions.size(), 12u);
    Report report;
    const Mesh once = cleanTwice(bodies, report);
    EXPECT_EQ(once.triangles.size(), 24u);
    EXPECT_EQ(report.count("faces-kept-walls"), insideOut ? 2u : 0u);
    EXPECT_NEAR(volume(once), 2, 1e-12);
    EXPECT_EQ(report.components.size(), 2u);
    for (const Component& component : report.components) EXPECT_TRUE(component.closed);
  }
}

TEST(DoubledSurface, DropsCopiesOfEveryFaceAlsoBesideAWall) {
  // Two rooms that share one wall: every edge of the wall has three faces, and every face occurs twice.
  Mesh rooms = withSharedVertices(test::joined(test::cube(), test::flipped(test::cube(1, {1, 0, 0}))));
  Report report;
  Options options;
  options.flat = true;
  const std::vector<glm::uvec3> faces = rooms.triangles;
  rooms.triangles.insert(rooms.triangles.end(), faces.begin(), faces.end());
  clean(rooms, options, report);
  EXPECT_EQ(report.count("faces-kept-walls"), 0u);
  EXPECT_GE(report.count("faces-dropped-duplicate"), faces.size());
}

TEST(DoubledSurface, DropsCopiesOfFacesWithRepeatedCorners) {
  Mesh mesh = test::cube();
  mesh.triangles = {{0, 1, 1}, {0, 1, 1}};
  EXPECT_EQ(dropDuplicateFaces(mesh, false).same.count, 1u);
  mesh = test::cube();
  mesh.sourceCorners = mesh.triangles = {{0, 0, 0}, {0, 0, 0}, {1, 2, 2}, {1, 2, 2}};
  EXPECT_EQ(dropDuplicateFaces(mesh, false).same.count, 2u);
}

TEST(DoubledSurface, KeepsWallsOfCubesAroundAnEdge) {
  // Four cubes around an edge, like a chessboard: the four walls meet at it.
  Mesh bodies;
  for (int i = 0; i < 4; ++i) {
    const Mesh next = test::cube(1, {i % 2, i / 2, 0});
    bodies = test::joined(bodies, i == 1 || i == 2 ? test::flipped(next) : next);
  }
  Report report;
  const Mesh once = cleanTwice(bodies, report);
  EXPECT_GE(once.triangles.size(), 48u);  // the common edge may be cut
  EXPECT_NEAR(volume(once), 4, 1e-12);
  for (const Component& component : report.components) EXPECT_TRUE(component.closed);
}

TEST(DoubledSurface, DropsAFaceThatOccursTwice) {
  // In a closed body, at the border of an open one, and alone.
  Mesh closed = test::cube(), open = test::cube(), alone = test::cube();
  closed.triangles.push_back(closed.triangles[3]);
  open.triangles.resize(10);
  open.triangles.push_back(open.triangles.back());
  alone.triangles.resize(1);
  alone.triangles.push_back(alone.triangles.back());
  for (Mesh& mesh : {std::ref(closed), std::ref(open), std::ref(alone)}) {
    Report report;
    Options options;
    options.flat = true;
    EXPECT_EQ(clean(mesh, options, report).triangles.size(), mesh.triangles.size() - 1);
    EXPECT_EQ(report.count("faces-dropped-duplicate"), 1u);
  }
}

}  // namespace
}  // namespace malus::prep

#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "meshprep/read/scan.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorOf;
using test::TemporaryFile;

Polygons read(const std::string& text) { return readMesh(TemporaryFile(".obj", text).path()); }

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// A file that must be refused with a message that holds both parts.
void expectRefused(const std::string& text, const std::string& place, const std::string& part) {
  const std::string error = errorOf([&] { read(text); });
  EXPECT_TRUE(contains(error, place)) << text << "\n" << error;
  EXPECT_TRUE(contains(error, part)) << text << "\n" << error;
}

TEST(ScanObj, QuadKeepsItsFourCorners) {
  const Polygons polygons = read(kSquare + "f 1 2 3 4\n");
  EXPECT_EQ(polygons.positions.size(), 4u);
  ASSERT_EQ(polygons.faceCount(), 1u);
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(ScanObj, CoordinatesAreDouble) {
  EXPECT_EQ(read("v 0.1234567890123456 +2 -3e-2\nv 1 0 0\nv .5 1. 0\nf 1 2 3\n").positions[0],
            glm::dvec3(0.1234567890123456, 2, -0.03));
}

TEST(ScanObj, AllKindsOfCornersNegativeIndicesAndForwardReferences) {
  const Polygons polygons = read("vt 0 0\nvn 0 0 1\nf 1/1/1 2/1 3//1\n" + kSquare + "f 1 2 3\n");
  EXPECT_EQ(polygons.faceCount(), 2u);
}

TEST(ScanObj, NegativeIndicesCountFromWhereTheyStand) {
  const Polygons polygons = read(kSquare + "f -4 -3 -2\nv 9 9 9\nf -1 -4 -5\n");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 4, 1, 0}));
}

TEST(ScanObj, CrLfTabsBlankLinesAndMaterialsAreFine) {
  const Polygons polygons = read(
      "# \xc3\xa4\r\nmtllib /dev/zero\r\n\r\n\tv 0 0\t0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 0 1\r\n"
      "usemtl x\r\ng a b\r\ns off\r\nf 1 2 3\r\n");
  EXPECT_EQ(polygons.faceCount(), 1u);
}

TEST(ScanObj, ByteOrderMarkOfUtf8IsSkipped) {
  EXPECT_EQ(read("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions.size(), 3u);
}

TEST(ScanObj, NonManifoldFacesShareTheirVertices) {
  // Five triangles on one edge, and one turned against its neighbour: OpenMesh's mesh would copy vertices.
  const Polygons polygons = read(
      "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 1 1 0\n"
      "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\nf 2 1 7\n");
  EXPECT_EQ(polygons.positions.size(), 7u);
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 1, 0, 6}));
}

TEST(ScanObj, FacesWithRepeatedCornersAreKeptForCounting) {
  const Polygons polygons = read(kSquare + "f 1 2 2\nf 1 2 2 3\nf 1 2 3 4\nf 1 1 1\n");
  EXPECT_EQ(polygons.faceCount(), 4u);
  EXPECT_EQ(polygons.face(1).size(), 4u);
}

TEST(ScanObj, NumbersMustBeFinite) {
  expectRefused("v 0 0 0\nv nan 0 0\n" + kSquare + "f 1 2 3\n", ".obj:2:", "a finite decimal number, found \"nan\"");
  expectRefused("v 0 -inf 0\n", ".obj:1:", "finite");
  expectRefused("v 0 0 1e39\n", ".obj:1:", "float holds");
  expectRefused("v 0 0 1e999\n", ".obj:1:", "float holds");
  expectRefused("v 0 0 1,5\n", ".obj:1:", "\"1,5\"");
  expectRefused("v 0 0 0x10\n", ".obj:1:", "0x10");
  expectRefused("v 0 0\n", ".obj:1:", "3 (x y z)");
  expectRefused("v 0 0 +-1\n", ".obj:1:", "+-1");
}

TEST(ScanObj, VanishingNumbersAreZero) {
  EXPECT_EQ(read("v 1e-400 0 -1e-400\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions[0], glm::dvec3(0, 0, 0));
  EXPECT_EQ(read("v 1e-42 0 1e-60\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions.size(), 3u);
}

TEST(ScanObj, IndicesMustBeThere) {
  expectRefused(kSquare + "f 1 2 5\n", ".obj:5:", "1 to 4, found 5");
  expectRefused(kSquare + "f 0 1 2\n", ".obj:5:", "found 0");
  expectRefused(kSquare + "f 1 2 -5\n", ".obj:5:", "found -5");
  expectRefused(kSquare + "vt 0 0\nf 1/1 2/2 3/1\n", ".obj:6:", "a texture coordinate that is not there");
  expectRefused(kSquare + "f 1//1 2//1 3//1\n", ".obj:5:", "a normal that is not there");
  expectRefused(kSquare + "f 1 2 99999999999999999999\n", ".obj:5:", "whole numbers");
  expectRefused(kSquare + "f 1 2 4000000000\n", ".obj:5:", "4000000000");
}

TEST(ScanObj, BadCornersAndFaces) {
  expectRefused(kSquare + "f 1 2\n", ".obj:5:", "at least 3 corners, found 2");
  expectRefused(kSquare + "f 1/ 2 3\n", ".obj:5:", "v/vt");
  expectRefused(kSquare + "f 1/1/1/1 2 3\n", ".obj:5:", "v/vt");
  expectRefused(kSquare + "f 1 2 3 # 4\n", ".obj:5:", "\"#\"");
  expectRefused(kSquare + "f /1 2 3\n", ".obj:5:", "nothing");
}

TEST(ScanObj, ContinuationLinesAreRefused) { expectRefused(kSquare + "f 1 2 \\\n3 4\n", ".obj:5:", "continuation"); }

TEST(ScanObj, OtherFilesAreRefused) {
  expectRefused("<html>\n", ".obj:1:", "unknown statement");
  expectRefused("\xff\xfev", ".obj", "UTF-16");
  expectRefused(std::string("v\0 \0000\0", 7), ".obj:1:", "byte 0x00");
  expectRefused("v 0 0 0\rv 1 0 0\r", ".obj:1:", "byte 0x0d");
  expectRefused(kSquare, ".obj", "no faces");
  expectRefused("# nothing\n", ".obj", "no vertices");
  expectRefused(kSquare + "surf 0 1 0 1 1 2 3 4\n", ".obj:5:", "surf");
  expectRefused("v 0 0 0 0.5\n", ".obj:1:", "rational");
}

}  // namespace
}  // namespace malus::prep

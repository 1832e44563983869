#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::TemporaryFile;

Polygons read(const std::string& text) { return test::readCrosschecked(".off", text); }

void expectRefused(const std::string& text, const std::string& location, const std::string& part) {
  const std::string error = errorMessage([&] {
    const test::TemporaryFile file(".off", text);
    readMesh(file.path(), true);
  });
  EXPECT_TRUE(contains(error, location)) << text << "\n" << error;
  EXPECT_TRUE(contains(error, part)) << text << "\n" << error;
}

const std::string kPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0.1\n";

TEST(ScanOff, ReadsAPlainFile) {
  const Polygons polygons = read("OFF\n4 2 0\n" + kPoints + "3 0 1 2\n4 0 1 2 3\n");
  EXPECT_EQ(polygons.positions[3], glm::dvec3(0, 1, 0.1));
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 3}));
}

TEST(ScanOff, AcceptsCommentsBlankLinesAndCrLf) {
  EXPECT_EQ(
      read("# a\n\nOFF # b\n# c\n4 1 0 # d\n\n0 0 0 # e\n# f\n1 0 0\n1 1 0\n0 1 0\n# g\n3 0 1 2 # h\n#i").faceCount(),
      1u);
  EXPECT_EQ(read("OFF 4 1 0\n" + kPoints + "3 0 1 2\n").faceCount(), 1u);
  EXPECT_EQ(read("OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n").faceCount(), 1u);
}

TEST(ScanOff, SkipsColoursNormalsAndTextureCoordinates) {
  EXPECT_EQ(read("OFF\n4 2 0\n" + kPoints + "3 0 1 2 255 0 0\n3 0 2 3 0.1 0.2 0.3 1\n").faceCount(), 2u);
  EXPECT_EQ(read("COFF\n3 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2\n").faceCount(), 1u);
  EXPECT_EQ(
      read("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 2 3 4 .5 .5\n1 0 0 0 0 1 1 2 3 4 .5 .5\n0 1 0 0 0 1 1 2 3 4 .5 .5\n3 0 1 2\n")
          .positions[1],
      glm::dvec3(1, 0, 0));
}

TEST(ScanOff, NotesIgnoredContentOnce) {
  EXPECT_TRUE(read("OFF\n4 1 0\n" + kPoints + "4 0 1 2 3 # red\n").notes.empty());
  EXPECT_EQ(read("OFF\n4 2 0\n" + kPoints + "3 0 1 2 255 0 0\n3 0 2 3 7\n").notes,
            (std::vector<std::string>{"colours of faces"}));
  EXPECT_EQ(read("COFF\n3 1 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2\n").notes,
            (std::vector<std::string>{"colours of vertices"}));
  EXPECT_EQ(read("STOFF\n3 1 0\n0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n").notes,
            (std::vector<std::string>{"texture coordinates"}));
}

TEST(ScanOff, AcceptsHabitsOfExporters) {
  const Polygons polygons = read("OFF\r4 4 # no edges\r0 0 0\r1 0 0\r1 1 0 # c\r0 1 0\r2 0 1\r3 0 1 2\r0\r1 3\r\0");
  EXPECT_EQ(polygons.firstCorner, (std::vector<std::size_t>{0, 2, 5, 5, 6}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"accepted: a missing number of edges",
                                                      "faces of fewer than three corners", "accepted: CR line ends"}));
  EXPECT_EQ(read("OFF 4 1\n" + kPoints + "3 0 1 2\n").faceCount(), 1u);
  EXPECT_EQ(read("OFF\n4 1 0\n" + kPoints + "3 0 1 2\n" + std::string(3, '\0')).notes,
            (std::vector<std::string>{"padding at the end of the file"}));
}

TEST(ScanOff, KeepsNormals) {
  EXPECT_EQ(read("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 .6 .8\n0 1 0 0 0 2\n3 0 1 2\n").normals,
            (std::vector<glm::vec3>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 2}}));
  EXPECT_TRUE(read("OFF\n4 1 0\n" + kPoints + "3 0 1 2\n").normals.empty());
  expectRefused("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 nan .8\n0 1 0 0 0 2\n3 0 1 2\n", ".off:4:", "nan");
  expectRefused("NOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off:3:", "nothing");
}

TEST(ScanOff, StoresLines) {
  const Polygons polygons = read("# a\nOFF # b\n\n4 2 0\n# c\n" + kPoints + "\n3 0 1 2\n# d\n4 0 1 2 3\n");
  EXPECT_FALSE(polygons.locationsAreBytes);
  EXPECT_EQ(polygons.vertexLocations, (std::vector<std::uint64_t>{6, 7, 8, 9}));
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{11, 13}));
}

TEST(ScanOff, KeepsDoublePrecision) {
  EXPECT_EQ(read("OFF\n3 1 0\n0.1234567890123456 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").positions[0].x, 0.1234567890123456);
}

TEST(ScanOff, RefusesCountsAboveTheFileSize) {
  expectRefused("4 1 0\n" + kPoints + "3 0 1 2\n", ".off:1:", "insert a line OFF");
  expectRefused("OFF\n4000000000 1 0\n", ".off:2:", "4000000000");
  expectRefused("OFF\n3 4000000000 0\n", ".off:2:", "4000000000");
  expectRefused("OFF\n-3 1 0\n", ".off:2:", "-3");
  expectRefused("OFF\n4 2 0\n" + kPoints + "3 0 1 2\n", ".off", "unexpected end of file");
  expectRefused("OFF\n4 1 0\n0.00000 0.00000 0\n1.00000 0.000000 0\n", ".off", "unexpected end of file");
  expectRefused("OFF\n4 1 0\n" + kPoints + "3 0 1 2\n3 0 2 3\n", ".off:8:", "content after the elements");
}

TEST(ScanOff, RefusesInvalidNumbersAndIndices) {
  expectRefused("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", ".off:3:", "nan");
  expectRefused("OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off:3:", "nothing");
  expectRefused("OFF\n4 1 0\n" + kPoints + "3 0 1 4\n", ".off:7:", "0 to 3, found 4");
  expectRefused("OFF\n4 1 0\n" + kPoints + "3 0 1 -1\n", ".off:7:", "-1");
  expectRefused("OFF\n4 1 0\n" + kPoints + "-2 0 1\n", ".off:7:", "found -2");
  expectRefused("OFF\n4 1 0\n" + kPoints + "4 0 1 2\n", ".off:7:", "4 corners");
  expectRefused("OFF\n4 1 0\n" + kPoints + "4000000000 0 1 2\n", ".off:7:", "corners");
}

TEST(ScanOff, RefusesOtherVariants) {
  expectRefused("OFF BINARY\n", ".off:1:", "binary");
  expectRefused("4OFF\n", ".off:1:", "dimension");
  expectRefused("nOFF\n3\n", ".off:1:", "dimension");
  expectRefused("4 1 0\n", ".off:1:", "insert a line OFF");
  expectRefused("SKEL\n", ".off:1:", "OFF");
  expectRefused("OFF\n0 0 0\n", ".off", "no vertices");
}

TEST(ScanOff, LeavesOutInvalidVerticesAndFaces) {
  const Polygons polygons = read("OFF\n5 5 0\n" + kPoints + "nan 0 0\n3 0 1 2\n3 0 1 9\n3 0 1\n3 0 1 4\n3 0 1 3\n");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3}));
  EXPECT_EQ(polygons.faceLocations.size(), 2u);
  ASSERT_EQ(polygons.notes.size(), 2u);
  EXPECT_TRUE(contains(polygons.notes[0], "invalid vertices: 1")) << polygons.notes[0];
  EXPECT_TRUE(contains(polygons.notes[1], "invalid faces: 3")) << polygons.notes[1];
}

}  // namespace
}  // namespace malus::prep

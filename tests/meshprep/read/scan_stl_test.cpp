#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::binaryStl;
using test::contains;
using test::errorMessage;
using test::TemporaryFile;

Polygons read(const std::string& text) { return test::readCrosschecked(".stl", text); }

void expectRefused(const std::string& text, const std::string& location, const std::string& part) {
  const std::string error = errorMessage([&] {
    const test::TemporaryFile file(".stl", text);
    readMesh(file.path(), true);
  });
  EXPECT_TRUE(contains(error, location)) << text << "\n" << error;
  EXPECT_TRUE(contains(error, part)) << text << "\n" << error;
}

const std::string kFacet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 0.1\n"
    "    endloop\n  endfacet\n";

TEST(ScanStl, KeepsCornersOfBinaryFiles) {
  const Polygons polygons = read(binaryStl(test::tetrahedronTriangles()));
  EXPECT_EQ(polygons.faceCount(), 4u);
  EXPECT_EQ(polygons.positions.size(), 12u);
  EXPECT_EQ(polygons.positions[5], glm::dvec3(0, 0, static_cast<double>(0.1f)));
}

TEST(ScanStl, RecognizesBinaryFilesThatBeginWithSolid) {
  EXPECT_EQ(read(binaryStl(test::tetrahedronTriangles(), "solid of a binary exporter")).faceCount(), 4u);
}

TEST(ScanStl, KeepsFacesWithoutArea) {
  auto triangles = test::tetrahedronTriangles();
  triangles.insert(triangles.begin() + 1, {1, 1, 1, 1, 1, 1, 2, 2, 2});
  triangles.push_back({0, 0, 0, 0, 1, 0, -0.0f, 0, 0});
  EXPECT_EQ(read(binaryStl(triangles)).faceCount(), 6u);
}

TEST(ScanStl, ReadsSeveralSolids) {
  EXPECT_EQ(read("solid\n" + kFacet + kFacet + "endsolid\n").faceCount(), 2u);
  EXPECT_EQ(read("solid a\n" + kFacet + "endsolid a\nsolid b\n" + kFacet + "endsolid b").faceCount(), 2u);
  EXPECT_EQ(read("solid a\n" + kFacet + "endsolid a\n").positions[2], glm::dvec3(0, 1, 0.1));
}

TEST(ScanStl, MakesPartsOfSolids) {
  const Polygons polygons = read("solid  T\xc3\xbcr left \n" + kFacet + kFacet +
                                 "endsolid\nsolid empty\nendsolid\nsolid\n" + kFacet + "endsolid\n");
  EXPECT_EQ(polygons.parts, (std::vector<Part>{{"T\xc3\xbc"
                                                "r left",
                                                ""},
                                               {"", ""}}));
  EXPECT_EQ(polygons.partOf, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(read("solid a\n" + kFacet + "endsolid\n").parts, (std::vector<Part>{{"a", ""}}));
  EXPECT_TRUE(read("solid\n" + kFacet + "endsolid\n").parts.empty());
}

TEST(ScanStl, StoresLinesOrBytes) {
  const Polygons text = read("solid a\n\n" + kFacet + kFacet + "endsolid a\n");
  EXPECT_FALSE(text.locationsAreBytes);
  EXPECT_EQ(text.vertexLocations, (std::vector<std::uint64_t>{5, 6, 7, 12, 13, 14}));
  EXPECT_EQ(text.faceLocations, (std::vector<std::uint64_t>{3, 10}));
  auto triangles = test::tetrahedronTriangles();
  triangles.resize(2);
  const Polygons binary = read(binaryStl(triangles));
  EXPECT_TRUE(binary.locationsAreBytes);
  EXPECT_EQ(binary.vertexLocations, (std::vector<std::uint64_t>{96, 108, 120, 146, 158, 170}));
  EXPECT_EQ(binary.faceLocations, (std::vector<std::uint64_t>{84, 134}));
}

TEST(ScanStl, NotesAttributes) {
  std::string bytes = binaryStl(test::tetrahedronTriangles());
  EXPECT_TRUE(read(bytes).notes.empty());
  bytes[84 + 50 + 49] = '\x80';
  EXPECT_EQ(read(bytes).notes, (std::vector<std::string>{"colours of faces"}));
}

TEST(ScanStl, IgnoresPadding) {
  const std::string binary = binaryStl(test::tetrahedronTriangles());
  const std::string text = "solid x\n" + kFacet + "endsolid x\n";
  for (const std::string& padding :
       {std::string(2, '\0'), std::string(512, '\0'), std::string("\0\r\n\x1a", 4), std::string(5, '\0') + " "}) {
    EXPECT_EQ(read(binary + padding).notes, (std::vector<std::string>{"padding at the end of the file"}));
    EXPECT_EQ(read(binary + padding).faceCount(), 4u);
    EXPECT_EQ(read(text + padding).notes, (std::vector<std::string>{"padding at the end of the file"}));
  }
  EXPECT_EQ(read(binary + "   \n").notes.size(), 1u);
  EXPECT_TRUE(read(text + "  \n \n").notes.empty());
  expectRefused(binary + std::string(50, '\0') + "x", ".stl", "wrong size");
}

// Four facets, whatever the header states; also if it begins as a text file does.
TEST(ScanStl, NamesTheWrongNumberOfFacets) {
  std::string binary = binaryStl(test::tetrahedronTriangles());
  for (const std::string begin : {"made by a program", "solid by a program"}) {
    binary.replace(0, begin.size(), begin);
    binary[80] = 5;
    expectRefused(binary, ".stl, byte 80", "expected 4");
    expectRefused(binary, ".stl, byte 80", "found 5");
    binary[83] = '\x7f';
    expectRefused(binary, ".stl, byte 80", "expected 4");
    binary[83] = 0;
    expectRefused(binary.substr(0, 200), ".stl", "wrong size");
    expectRefused(binary.substr(0, 200), ".stl", "334 bytes");
  }
}

TEST(ScanStl, AcceptsCrLineEnds) {
  std::string text = "solid x\n" + kFacet + kFacet + "endsolid x\n";
  std::replace(text.begin(), text.end(), '\n', '\r');
  const Polygons polygons = read(text);
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{2, 9}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"accepted: CR line ends"}));
}

TEST(ScanStl, AcceptsEmptyLines) {
  // OpenMesh fails at empty lines between corners.
  std::string spaced = "\n";
  for (const char c : "solid x\n" + kFacet + kFacet + "endsolid x\n")
    spaced += c == '\n' ? "\r\n \r\n" : std::string(1, c);
  const Polygons polygons = read(spaced);
  EXPECT_EQ(polygons.faceCount(), 2u);
  EXPECT_EQ(polygons.positions[5], glm::dvec3(0, 1, 0.1));
}

TEST(ScanStl, IgnoresNormalsOfFacets) {
  EXPECT_EQ(
      read("solid\nfacet normal nan 0 x\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
           "endsolid\n")
          .corners,
      (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ScanStl, AcceptsNamesThatContainStatements) {
  EXPECT_EQ(read("solid outer facet normal\n" + kFacet + "endsolid outer loop\n").faceCount(), 1u);
}

TEST(ScanStl, AcceptsUpperCase) {
  std::string upper;
  for (const char c : "solid x\n" + kFacet + "endsolid x\n")
    upper += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(read(upper).faceCount(), 1u);
}

TEST(ScanStl, RefusesTruncatedFiles) {
  const std::string whole = binaryStl(test::tetrahedronTriangles());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(errorMessage([&] { read(whole.substr(0, size)); }).empty()) << size;
  const std::string text = "solid x\n" + kFacet + "endsolid";
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(errorMessage([&] { read(text.substr(0, size)); }).empty()) << size;
}

TEST(ScanStl, SurvivesEveryFlippedBit) {
  const std::string whole = binaryStl(test::tetrahedronTriangles());
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    try {
      const std::size_t faces = read(flipped).faceCount();
      EXPECT_TRUE(faces == 4 || faces == 3) << faces;  // one face may have an invalid number
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), ".stl")) << error.what();
    }
  }
}

TEST(ScanStl, RefusesInvalidFiles) {
  auto triangles = test::tetrahedronTriangles();
  triangles[2][4] = std::numeric_limits<float>::infinity();
  expectRefused(binaryStl(triangles), ", byte 212", "invalid number in face 2");
  expectRefused(binaryStl({}), ".stl", "no vertices");
  expectRefused(binaryStl(test::tetrahedronTriangles()) + "x", ".stl", "found 285 bytes");
  expectRefused("solid x\n" + kFacet, ".stl", "endsolid");
  expectRefused("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", ".stl:4:", "nan");
  expectRefused("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", ".stl:6:", "vertex");
  expectRefused("solid of a binary exporter" + binaryStl(test::tetrahedronTriangles()).substr(28) + "x", ".stl",
                "wrong size");
  expectRefused("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0 0\n", ".stl:4:", "x y z");
  expectRefused("hello", ".stl", "\"solid\"");
}

TEST(ScanStl, LeavesOutFacesWithInvalidNumbers) {
  auto triangles = test::tetrahedronTriangles();
  triangles[2][4] = std::numeric_limits<float>::infinity();
  const Polygons polygons = read(binaryStl(triangles));
  EXPECT_EQ(polygons.faceCount(), 3u);
  EXPECT_TRUE(contains(polygons.notes.back(), "invalid faces: 1")) << polygons.notes.back();
  std::string text = "solid x\n" + kFacet;
  text += kFacet;
  text.replace(text.rfind("vertex"), text.find('\n', text.rfind("vertex")) - text.rfind("vertex"), "vertex 0 nan 0");
  EXPECT_EQ(read(text + "endsolid x\n").faceCount(), 1u);
}

}  // namespace
}  // namespace malus::prep

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "meshprep/read/scan.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::TemporaryFile;

Polygons read(const std::string& text) { return test::readCrosschecked(".obj", text); }

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Expects an error of a strict reading, with the location and this part of the message.
void expectRefused(const std::string& text, const std::string& location, const std::string& part) {
  const std::string error = errorMessage([&] {
    const TemporaryFile file(".obj", text);
    readMesh(file.path(), true);
  });
  EXPECT_TRUE(contains(error, location)) << text << "\n" << error;
  EXPECT_TRUE(contains(error, part)) << text << "\n" << error;
}

TEST(ScanObj, KeepsQuads) {
  const Polygons polygons = read(kSquare + "f 1 2 3 4\n");
  EXPECT_EQ(polygons.positions.size(), 4u);
  ASSERT_EQ(polygons.faceCount(), 1u);
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

// Bytes are tested eight at a time.
TEST(ScanObj, RefusesControlCharactersAtEveryOffset) {
  for (std::size_t blanks = 0; blanks < 20; ++blanks)
    for (const char control : {'\x01', '\x1f', '\0'})
      expectRefused(kSquare + "v" + std::string(blanks, blanks % 2 == 0 ? '\t' : ' ') + control + " 0 0\nf 1 2 3\n",
                    ":5: ", "control character");
  EXPECT_EQ(read(kSquare + "# \xc3\xa4 \x7f\xff\nv\t\t0\t \t\t\t\t\t\t\t 0   0\nf 1 2 5\n").positions.size(), 5u);
}

TEST(ScanObj, KeepsDoublePrecision) {
  EXPECT_EQ(read("v 0.1234567890123456 +2 -3e-2\nv 1 0 0\nv .5 1. 0\nf 1 2 3\n").positions[0],
            glm::dvec3(0.1234567890123456, 2, -0.03));
}

TEST(ScanObj, ReadsAllKindsOfCorners) {
  const Polygons polygons = read("vt 0 0\nvn 0 0 1\nf 1/1/1 2/1 3//1\n" + kSquare + "f 1 2 3\n");
  EXPECT_EQ(polygons.faceCount(), 2u);
}

TEST(ScanObj, CountsNegativeIndicesFromTheLine) {
  const Polygons polygons = read(kSquare + "f -4 -3 -2\nv 9 9 9\nf -1 -4 -5\n");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 4, 1, 0}));
}

TEST(ScanObj, AcceptsCrLfTabsBlankLinesAndMaterials) {
  const Polygons polygons = read(
      "# \xc3\xa4\r\nmtllib /dev/zero\r\n\r\n\tv 0 0\t0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 0 1\r\n"
      "usemtl x\r\ng a b\r\ns off\r\nf 1 2 3\r\n");
  EXPECT_EQ(polygons.faceCount(), 1u);
}

TEST(ScanObj, SkipsAByteOrderMark) {
  EXPECT_EQ(read("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions.size(), 3u);
}

TEST(ScanObj, KeepsVerticesOfNonManifoldFaces) {
  // Five triangles on one edge, one of them flipped: a half-edge mesh would duplicate vertices.
  const Polygons polygons = read(
      "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 1 1 0\n"
      "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\nf 2 1 7\n");
  EXPECT_EQ(polygons.positions.size(), 7u);
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 1, 0, 6}));
}

TEST(ScanObj, KeepsFacesWithRepeatedCorners) {
  const Polygons polygons = read(kSquare + "f 1 2 2\nf 1 2 2 3\nf 1 2 3 4\nf 1 1 1\n");
  EXPECT_EQ(polygons.faceCount(), 4u);
  EXPECT_EQ(polygons.face(1).size(), 4u);
}

TEST(ScanObj, RefusesInvalidNumbers) {
  expectRefused("v 0 0 0\nv nan 0 0\n" + kSquare + "f 1 2 3\n", ".obj:2:", "a finite decimal number, found \"nan\"");
  expectRefused("v 0 -inf 0\n", ".obj:1:", "finite");
  expectRefused("v 0 0 1e39\n", ".obj:1:", "out of range");
  expectRefused("v 0 0 1e999\n", ".obj:1:", "out of range");
  expectRefused("v 0 0 1,5\n", ".obj:1:", "\"1,5\"");
  expectRefused("v 0 0 0x10\n", ".obj:1:", "0x10");
  expectRefused("v 0 0\n", ".obj:1:", "3 (x y z)");
  expectRefused("v 0 0 +-1\n", ".obj:1:", "+-1");
}

TEST(ScanObj, RoundsTinyNumbersToZero) {
  EXPECT_EQ(read("v 1e-400 0 -1e-400\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions[0], glm::dvec3(0, 0, 0));
  EXPECT_EQ(read("v 1e-42 0 1e-60\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions.size(), 3u);
}

TEST(ScanObj, RefusesInvalidIndices) {
  expectRefused(kSquare + "f 1 2 5\n", ".obj:5:", "1 to 4, found 5");
  expectRefused(kSquare + "f 0 1 2\n", ".obj:5:", "found 0");
  expectRefused(kSquare + "f 1 2 -5\n", ".obj:5:", "found -5");
  expectRefused(kSquare + "vt 0 0\nf 1/1 2/2 3/1\n", ".obj:6:", "texture coordinate index");
  expectRefused(kSquare + "f 1//1 2//1 3//1\n", ".obj:5:", "normal index");
  expectRefused(kSquare + "f 1 2 99999999999999999999\n", ".obj:5:", "integer");
  expectRefused(kSquare + "f 1 2 4000000000\n", ".obj:5:", "4000000000");
}

TEST(ScanObj, RefusesInvalidFaces) {
  expectRefused(kSquare + "f 1/1/1/1 2 3\n", ".obj:5:", "v/vt");
  expectRefused(kSquare + "f /1 2 3\n", ".obj:5:", "nothing");
}

TEST(ScanObj, LeavesOutInvalidParts) {
  // Invalid vertices keep their numbers; faces that use them, and invalid faces, are left out.
  const Polygons polygons =
      read(kSquare + "v nan 0 0\nv 2 0\nv 9 9 9\nvn 0 x 0\nvn 0 0 1\n" +
           "s 1\ng a\nf 1 2 3\nf 1 2 5\ng b\nf 1 2 99\nf 1 x 3\nf 6 1 2\ns 2\nf 1//2 2//1 7//9\nf 0 1 2\nbmat a b\n");
  EXPECT_EQ(polygons.positions.size(), 7u);
  for (const glm::dvec3& p : polygons.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 6}));
  EXPECT_EQ(polygons.firstCorner, (std::vector<std::size_t>{0, 3, 6}));
  EXPECT_EQ(polygons.smoothingGroups, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(polygons.partOf, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{12, 19}));
  ASSERT_EQ(polygons.cornerNormals.size(), 6u);
  EXPECT_EQ(polygons.cornerNormals[3], glm::vec3(0, 0, 1));
  EXPECT_EQ(polygons.cornerNormals[4], glm::vec3(0));  // invalid
  EXPECT_EQ(polygons.cornerNormals[5], glm::vec3(0));  // missing
  const auto hasNote = [&](std::string_view what, std::string_view location) {
    return std::any_of(polygons.notes.begin(), polygons.notes.end(),
                       [&](const std::string& note) { return contains(note, what) && contains(note, location); });
  };
  EXPECT_TRUE(hasNote("invalid vertices: 2", ".obj:5:"));
  EXPECT_TRUE(hasNote("invalid normals: 1", ".obj:8:"));
  EXPECT_TRUE(hasNote("invalid faces: 5", ".obj:16:"));
  EXPECT_TRUE(hasNote("invalid statements: 1", "bmat"));
}

TEST(ScanObj, RefusesAFileOfInvalidLines) {
  EXPECT_CONTAINS(errorMessage([&] { read(kSquare + "f 1 2 9\n"); }), ".obj:5:", "1 to 4, found 9");
  EXPECT_CONTAINS(errorMessage([&] { read("v 0 0 nan\n"); }), ".obj:1:", "nan");
  std::string text = kSquare + "f 1 2 3\n";
  for (int i = 0; i < 10'001; ++i) text += "f x y z\n";
  EXPECT_CONTAINS(errorMessage([&] { read(text); }), "too many invalid");
}

TEST(ScanObj, AcceptsCommentsAfterStatements) {
  const Polygons polygons = read(
      "mtllib a.mtl # colours\nv 0 0 0 # a\nv 1 0 0# b\nv 1 1 0 #\nv 0 1 0\t#c 5\nvn 0 0 1#n\nvt 0 0 # t\n"
      "s 1# smooth\ng left # group\nusemtl red # C:\\\nf 1//1 2//1 3//1# 4\\\nf 1 2 \\\n 3 # C:\\\nf 1 2 4 #\n");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 3}));
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{11, 12, 14}));
  EXPECT_EQ(polygons.parts, (std::vector<Part>{{"left", "red"}}));
  EXPECT_EQ(polygons.materialFiles, (std::vector<std::string>{"a.mtl"}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"texture coordinates", "accepted: comments at line ends"}));
}

// Numbers that are not finite, as old runtimes of Microsoft write them, contain the character of comments.
TEST(ScanObj, RefusesNumbersThatAreNotFinite) {
  for (const char* number : {"1.#IND", "-1.#IND00", "1.#INF", "1.#QNAN", "1.#SNAN0"}) {
    expectRefused(std::string("v 0 0 ") + number + "\n" + kSquare + "f 1 2 3\n", ".obj:1:", number);
    expectRefused(std::string("v 0 0 0 1 1 ") + number + "\n" + kSquare + "f 1 2 3\n", ".obj:1:", number);
  }
  EXPECT_EQ(read("v 0 0 0.# not a number\n" + kSquare + "f 1 2 3\n").positions.size(), 5u);
}

TEST(ScanObj, KeepsHashesInNames) {
  const Polygons polygons = read("mtllib a#1.mtl\n" + kSquare + "g part#2\nusemtl Material #25\nf 1 2 3\n");
  EXPECT_EQ(polygons.parts, (std::vector<Part>{{"part#2", "Material #25"}}));
  EXPECT_EQ(polygons.materialFiles, (std::vector<std::string>{"a#1.mtl"}));
  EXPECT_TRUE(polygons.notes.empty());
}

TEST(ScanObj, AcceptsEmptySlotsOfCorners) {
  const Polygons polygons =
      read(kSquare + "vt 0 0\nvn 0 0 1\nf 1/ 2// 3/\nf 1/1/ 2/1/ 3/1/1\nf 1/ 2/1 3//1# c\nf 1// 2// 4//\n");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 3}));
  const glm::vec3 none(0), up(0, 0, 1);
  EXPECT_EQ(polygons.cornerNormals,
            (std::vector<glm::vec3>{none, none, none, none, none, up, none, none, up, none, none, none}));
  EXPECT_EQ(std::count(polygons.notes.begin(), polygons.notes.end(), "accepted: empty slots of corners"), 1);
}

TEST(ScanObj, AcceptsColoursWithAlpha) {
  const Polygons polygons = read("v 0 0 0 .5 .5 .5 1.0\nv 1 0 0 1 .5 .5 .25 # c\nv 0 1 0 255 0 0\nf 1 2 3\n");
  EXPECT_EQ(polygons.positions[1], glm::dvec3(1, 0, 0));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"colours of vertices", "accepted: comments at line ends"}));
  expectRefused("v 0 0 0 1 1\n", ".obj:1:", "6 (colour)");
  expectRefused("v 0 0 0 1 1 1 1 1\n", ".obj:1:", "too many numbers");
}

TEST(ScanObj, KeepsFacesOfFewerCorners) {
  // They keep the numbers of the faces after them; triangulate() leaves them out.
  const Polygons polygons = read(kSquare + "vn 0 0 1\nf 1 2\nf 1//1 2//1 3//1\nf 3\nf\nf 1 3 4\n");
  EXPECT_EQ(polygons.firstCorner, (std::vector<std::size_t>{0, 2, 5, 6, 6, 9}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"faces of fewer than three corners"}));
  expectRefused(kSquare + "f 1 5\nf 1 2 3\n", ".obj:5:", "found 5");
}

TEST(ScanObj, AcceptsCrLineEnds) {
  const Polygons polygons = read("# a\rv 0 0 0\rv 1 0 0\rv 1 1 0 # b\r\rf 1 2 \\\r3\rusemtl red\rf 3 2 1\r");
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{6, 9}));
  EXPECT_EQ(polygons.parts, (std::vector<Part>{{"", ""}, {"", "red"}}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"accepted: CR line ends", "accepted: comments at line ends"}));
  EXPECT_EQ(read("v 0 0 0\r\r\nv 1 0 0\r\nv 1 1 0\rf 1 2 3").faceCount(), 1u);  // mixed
}

TEST(ScanObj, IgnoresPadding) {
  const Polygons polygons = read(kSquare + "f 1 2 3\n" + std::string("\0\0 \x1a\n\0", 6));
  EXPECT_EQ(polygons.faceCount(), 1u);
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"padding at the end of the file"}));
  expectRefused(kSquare + std::string("f 1 2 3\n\0\nf 1 2 3\n", 19), ".obj:6:", "byte 0x00");
}

TEST(ScanObj, JoinsContinuedLines) {
  const Polygons polygons = read("v 0 0 0\nv 1 \\\n 0 \\\r\n0\nv 1 1 0\nv 0 1 0\nf 1 2\\\n3\\\n\\\n4\nf 1 2 3\n");
  EXPECT_EQ(polygons.positions[1], glm::dvec3(1, 0, 0));
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 2}));
  EXPECT_EQ(polygons.vertexLocations, (std::vector<std::uint64_t>{1, 2, 5, 6}));
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{7, 11}));
}

TEST(ScanObj, JoinsLinesWithBlanksBehindTheBackslash) {
  EXPECT_EQ(read(kSquare + "f 1 2 \\ \n3 \\\t\r\n4\n").corners, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(read(kSquare + "f 1 2 \\ # half of it\n3\n").corners, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ScanObj, ReportsTheFirstContinuedLine) {
  expectRefused(kSquare + "f 1 \\\n 2 \\\n 9\n", ".obj:5:", "found 9");
  expectRefused(kSquare + "f 1 \\\n 2 \\\n 3\nf 1 2 x\n", ".obj:8:", "\"x\"");
  expectRefused(kSquare + "f 1 2 3 \\", ".obj:5:", "backslash");
}

TEST(ScanObj, DoesNotContinueComments) { EXPECT_EQ(read(kSquare + "# C:\\models\\\nf 1 2 3\n").faceCount(), 1u); }

TEST(ScanObj, MakesPartsOfGroupsObjectsAndMaterials) {
  const Polygons polygons =
      read("mtllib my colours.mtl\n" + kSquare +
           "f 1 2 3\no Glas-Schale \xc3\xa4 \xe2\x98\x83\nusemtl gold\nf 1 2 3\nf 2 3 4\ng \tfront side \t\nf 1 2 4\n"
           "o Glas-Schale \xc3\xa4 \xe2\x98\x83\ng never used\no Glas-Schale \xc3\xa4 \xe2\x98\x83\nf 1 3 "
           "4\ng\nusemtl\nf 1 2 3 4\n");
  EXPECT_EQ(polygons.parts,
            (std::vector<Part>{{"", ""}, {"Glas-Schale \xc3\xa4 \xe2\x98\x83", "gold"}, {"front side", "gold"}}));
  EXPECT_EQ(polygons.partOf, (std::vector<std::uint32_t>{0, 1, 1, 2, 1, 0}));
  EXPECT_EQ(polygons.materialFiles, (std::vector<std::string>{"my colours.mtl"}));
}

TEST(ScanObj, HasNoPartsWithoutGroups) {
  const Polygons polygons = read(kSquare + "f 1 2 3\ng\nf 1 2 4\ng unused\n");
  EXPECT_TRUE(polygons.parts.empty());
  EXPECT_TRUE(polygons.partOf.empty());
  EXPECT_TRUE(polygons.smoothingGroups.empty());
  EXPECT_TRUE(polygons.cornerNormals.empty());
  EXPECT_TRUE(polygons.materialFiles.empty());
  EXPECT_TRUE(polygons.notes.empty());
}

TEST(ScanObj, ConvertsNamesFromLatin1) {
  const Polygons polygons = read(kSquare + "g T\xfcr\nusemtl \xc3\xbc\xff\nf 1 2 3\n");
  EXPECT_EQ(polygons.parts, (std::vector<Part>{{"T\xc3\xbcr", "\xc3\x83\xc2\xbc\xc3\xbf"}}));
  expectRefused(kSquare + "g " + std::string(300, 'x') + "\nf 1 2 3\n",
                ".obj:5:", "at most 255 bytes, found 300 bytes");
}

TEST(ScanObj, ListsMaterialFilesOnce) {
  EXPECT_EQ(read("mtllib a.mtl\nmtllib b.mtl\nmtllib a.mtl\n" + kSquare + "f 1 2 3\n").materialFiles,
            (std::vector<std::string>{"a.mtl", "b.mtl"}));
}

TEST(ScanObj, ReadsSmoothingGroups) {
  EXPECT_EQ(
      read(kSquare + "f 1 2 3\ns 1\nf 1 2 3\nf 1 2 4\ns off\nf 1 2 3\ns 7\nf 1 2 3\ns 0\nf 1 2 3\n").smoothingGroups,
      (std::vector<std::uint32_t>{0, 1, 1, 0, 7, 0}));
  EXPECT_EQ(read(kSquare + "s off\nf 1 2 3\n").smoothingGroups, (std::vector<std::uint32_t>{0}));
  expectRefused(kSquare + "s x\nf 1 2 3\n", ".obj:5:", "off or an integer");
  expectRefused(kSquare + "s -1\nf 1 2 3\n", ".obj:5:", "off or an integer");
  expectRefused(kSquare + "s 4294967296\nf 1 2 3\n", ".obj:5:", "off or an integer");
}

TEST(ScanObj, KeepsNormalsPerCorner) {
  // Two faces share an edge, with different normals of its vertices.
  const Polygons polygons =
      read(kSquare + "f 1 2 3\nvn 0 0 1\nvn 0 .6 .8\nf 1//1 2//-2 3//1\nf 1//2 3/1/3 4\nvt 0 0\nvn 2 0 0\n");
  const glm::vec3 none(0), a(0, 0, 1), b(0, 0.6f, 0.8f), c(2, 0, 0);
  EXPECT_EQ(polygons.cornerNormals, (std::vector<glm::vec3>{none, none, none, a, a, a, b, c, none}));
  expectRefused(kSquare + "vn 0 nan 1\nf 1 2 3\n", ".obj:5:", "nan");
  expectRefused(kSquare + "vn 0 1\nf 1 2 3\n", ".obj:5:", "nothing");
  expectRefused(kSquare + "vn 0 0 1 0\nf 1 2 3\n", ".obj:5:", "x y z");
  expectRefused(kSquare + "vn 0 0 1\nf 1//1 2//1 3//2\n", ".obj:6:", "normal index");
}

TEST(ScanObj, NotesIgnoredContentOnce) {
  EXPECT_EQ(read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nl 1 2\nl 2 3\np 1\nlod 3\nf 1 2 3\n").notes,
            (std::vector<std::string>{"colours of vertices", "texture coordinates", "lines", "points",
                                      "display attributes"}));
}

TEST(ScanObj, ReadsLargeFaces) {
  // Above the limit of the comparison with OpenMesh.
  std::string text, face = "f";
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("v {} {} 0\n", std::cos(i * 0.001 * 6.28), std::sin(i * 0.001 * 6.28));
    face += fmt::format(" {}", i + 1);
  }
  const Polygons polygons = read(text + face + "\nf 1 2 3\n");
  ASSERT_EQ(polygons.faceCount(), 2u);
  EXPECT_EQ(polygons.face(0).size(), 1000u);
  EXPECT_EQ(polygons.face(0)[999], 999u);
  EXPECT_EQ(polygons.faceLocations, (std::vector<std::uint64_t>{1001, 1002}));
}

TEST(ScanObj, RefusesTooManyCornersPerVertex) {
  std::string faces;
  for (int i = 0; i < 22000; ++i) faces += "f 1 2 3\n";
  expectRefused(kSquare + faces, ".obj", "at most 65792 corners for 4 vertices, found 66000");
}

TEST(ScanObj, RefusesOtherFiles) {
  expectRefused("<html>\n", ".obj:1:", "unknown statement");
  expectRefused("\xff\xfev", ".obj", "UTF-16");
  expectRefused(std::string("v\0 \0000\0", 7), ".obj:1:", "byte 0x00");
  expectRefused(kSquare, ".obj", "no faces");
  expectRefused("# nothing\n", ".obj", "no vertices");
  expectRefused(kSquare + "surf 0 1 0 1 1 2 3 4\n", ".obj:5:", "surf");
  expectRefused(kSquare + "call other.obj\nf 1 2 3\n", ".obj:5:", "call");
  expectRefused("v 0 0 0 0.5\n", ".obj:1:", "rational");
}

}  // namespace
}  // namespace malus::prep

// PLY files with unusual types and elements. Expected values are written by hand.
#include <array>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::putInteger;
using test::putReal;
using test::TemporaryFile;

using Corners = std::vector<std::uint32_t>;
using Notes = std::vector<std::string>;

Polygons read(const std::string& text) { return test::readCrosschecked(".ply", text); }

std::string refusal(const std::string& text) {
  return errorMessage([&] {
    const test::TemporaryFile file(".ply", text);
    readMesh(file.path(), true);
  });
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFourPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string header(const std::string& elements, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

struct IntegerType {
  std::string name;
  std::size_t bytes;
};
const std::array<IntegerType, 12> kIntegers = {{{"char", 1},
                                                {"uchar", 1},
                                                {"short", 2},
                                                {"ushort", 2},
                                                {"int", 4},
                                                {"uint", 4},
                                                {"int8", 1},
                                                {"uint8", 1},
                                                {"int16", 2},
                                                {"uint16", 2},
                                                {"int32", 4},
                                                {"uint32", 4}}};

TEST(PlyVariants, ReadsListsOfAllIntegerTypesInAllEncodings) {
  for (const IntegerType& count : kIntegers)
    for (const IntegerType& index : kIntegers) {
      const std::string elements = "element vertex 4\n" + kXyz + "element face 2\nproperty list " + count.name + " " +
                                   index.name + " vertex_indices\n";
      const Corners expected = {0, 1, 2, 3, 3, 1, 0};
      EXPECT_EQ(read(header(elements) + kFourPoints + "4 0 1 2 3\n3 3 1 0\n").corners, expected) << elements;
      for (const bool bigEndian : {false, true}) {
        std::string bytes = header(elements, bigEndian ? "binary_big_endian" : "binary_little_endian");
        for (const double x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) putReal(bytes, x, false, bigEndian);
        for (const Corners& face : {Corners{0, 1, 2, 3}, Corners{3, 1, 0}}) {
          putInteger(bytes, face.size(), count.bytes, bigEndian);
          for (const std::uint32_t corner : face) putInteger(bytes, corner, index.bytes, bigEndian);
        }
        EXPECT_EQ(read(bytes).corners, expected) << elements << bigEndian;
      }
    }
}

TEST(PlyVariants, ReadsLargeUnsignedIndices) {
  // 200 as uchar and 40000 as ushort are negative if read as signed.
  for (const auto& [name, bytes, vertices] : {std::tuple{"uchar", 1u, 201u}, std::tuple{"ushort", 2u, 40001u}}) {
    std::string text = header(fmt::format("element vertex {}\n{}element face 1\nproperty list ushort {} vertex_index\n",
                                          vertices, kXyz, name),
                              "binary_big_endian");
    for (unsigned i = 0; i < vertices; ++i)
      for (int axis = 0; axis < 3; ++axis) putReal(text, i * axis, false, true);
    putInteger(text, 3, 2, true);
    for (const unsigned corner : {0u, vertices - 1, 1u}) putInteger(text, corner, bytes, true);
    EXPECT_EQ(read(text).corners, (Corners{0, vertices - 1, 1}));
  }
}

TEST(PlyVariants, SkipsOtherLists) {
  const Polygons before =
      read(header("element vertex 4\n" + kXyz +
                  "property list uchar float weights\nelement face 2\nproperty list uchar float "
                  "texcoord\nproperty uchar red\nproperty list uchar int vertex_indices\nproperty list "
                  "int uchar flags\n") +
           "0 0 0 0\n1 0 0 1 0.5\n1 1 0 2 0.5 nan\n0 1 0 0\n2 0.5 0.5 255 3 0 1 2 0\n0 0 4 3 2 1 0 1 9\n");
  EXPECT_EQ(before.corners, (Corners{0, 1, 2, 3, 2, 1, 0}));
  EXPECT_EQ(before.notes, (Notes{"lists of vertices", "lists of faces", "colours of faces"}));

  std::string bytes =
      header("element vertex 3\nproperty list ushort double a\n" + kXyz +
                 "element face 1\nproperty list uchar short b\nproperty list uint ushort vertex_indices\n"
                 "property list uchar uchar c\n",
             "binary_little_endian");
  for (int i = 0; i < 3; ++i) {
    putInteger(bytes, static_cast<unsigned>(i), 2);
    for (int k = 0; k < i; ++k) putReal(bytes, std::numeric_limits<double>::quiet_NaN(), true);
    for (const double x : {i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, 0.0}) putReal(bytes, x, false);
  }
  const std::string withoutFace = bytes;
  putInteger(bytes, 1, 1);
  putInteger(bytes, 7, 2);
  putInteger(bytes, 3, 4);
  for (const unsigned corner : {2u, 0u, 1u}) putInteger(bytes, corner, 2);
  putInteger(bytes, 0, 1);
  const Polygons binary = read(bytes);
  EXPECT_EQ(binary.corners, (Corners{2, 0, 1}));
  EXPECT_EQ(binary.positions[2], glm::dvec3(0, 1, 0));

  // A list that is longer than the file.
  EXPECT_TRUE(contains(refusal(withoutFace + "\xff 3 0 1 2 and so on"), "end of file", "face 0"));
}

TEST(PlyVariants, FlipsEverySecondTriangleOfStrips) {
  // 0 1 2 3 4: (0 1 2) (2 1 3) (2 3 4); -1 ends a strip; a repeated corner connects strips.
  const std::string elements =
      "element vertex 6\n" + kXyz + "element tristrips 2\nproperty list int int vertex_indices\n";
  const std::string points = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  const Polygons text = read(header(elements) + points + "9 0 1 2 3 4 -1 3 5 4\n7 0 1 2 2 3 3 4\n");
  const Corners expected = {0, 1, 2, 2, 1, 3, 2, 3, 4, 3, 5, 4, 0, 1, 2};
  EXPECT_EQ(text.corners, expected);
  EXPECT_EQ(text.faceCount(), 5u);
  EXPECT_EQ(text.faceLocations, (std::vector<std::uint64_t>{16, 16, 16, 16, 17}));
  EXPECT_TRUE(text.notes.empty());

  for (const bool bigEndian : {false, true}) {
    std::string bytes = header(elements, bigEndian ? "binary_big_endian" : "binary_little_endian");
    const std::size_t begin = bytes.size();
    for (const double x : {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0}) putReal(bytes, x, false, bigEndian);
    for (const std::vector<int>& strip : {std::vector<int>{0, 1, 2, 3, 4, -1, 3, 5, 4}, {0, 1, 2, 2, 3, 3, 4}}) {
      putInteger(bytes, strip.size(), 4, bigEndian);
      for (const int corner : strip) putInteger(bytes, static_cast<std::uint32_t>(corner), 4, bigEndian);
    }
    const Polygons binary = read(bytes);
    EXPECT_EQ(binary.corners, expected);
    EXPECT_EQ(binary.faceLocations.front(), begin + 72);
    EXPECT_EQ(binary.faceLocations.back(), begin + 72 + 40);
  }

  // Connected strips keep the parity of their corners.
  EXPECT_EQ(read(header(elements) + points + "6 0 1 2 2 3 5\n3 0 1 2\n").corners, (Corners{0, 1, 2, 3, 2, 5, 0, 1, 2}));
  EXPECT_TRUE(contains(refusal(header(elements) + points + "3 0 1 6\n3 0 1 2\n"), ".ply:16", "strip"));
  EXPECT_TRUE(contains(refusal(header(elements) + points + "3 0 1 -2\n3 0 1 2\n"), "found -2"));
  EXPECT_TRUE(contains(refusal(header(elements) + points + "2 0 1\n0\n"), "no faces"));
}

TEST(PlyVariants, ReadsStripsAndFaces) {
  const std::string elements = "element vertex 4\n" + kXyz +
                               "element tristrips 1\nproperty list uchar char vertex_indices\nelement face "
                               "1\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(read(header(elements) + kFourPoints + "3 0 1 2\n3 0 2 3\n").corners, (Corners{0, 1, 2, 0, 2, 3}));
}

TEST(PlyVariants, SkipsOtherElementsWithANote) {
  const std::string elements =
      "element material 2\nproperty uchar red\nproperty list uchar float curve\nelement vertex 4\n" + kXyz +
      "element edge 2\nproperty int vertex1\nproperty int vertex2\nelement face 1\nproperty list uchar int "
      "vertex_indices\nelement camera 1\nproperty double focus\n";
  const Polygons text = read(header(elements) + "9 0\n8 2 1 1\n" + kFourPoints + "0 1\n1 2\n4 0 1 2 3\n50\n");
  EXPECT_EQ(text.corners, (Corners{0, 1, 2, 3}));
  EXPECT_EQ(text.positions.size(), 4u);
  ASSERT_EQ(text.notes.size(), 1u);
  EXPECT_CONTAINS(text.notes[0], "elements other than");

  std::string bytes = header(elements, "binary_big_endian");
  bytes += std::string("\x09\x00\x08\x02", 4) + std::string(8, '\x7f');
  for (const double x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) putReal(bytes, x, false, true);
  bytes += std::string(16, '\x7f') + '\4';
  for (const unsigned corner : {3u, 2u, 1u, 0u}) putInteger(bytes, corner, 4, true);
  bytes += std::string(8, '\x7f');
  EXPECT_EQ(read(bytes).corners, (Corners{3, 2, 1, 0}));
  EXPECT_TRUE(contains(refusal(bytes + "x"), "content after the elements"));
}

TEST(PlyVariants, ReadsFacesBeforeVertices) {
  const std::string elements = "element face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n" + kXyz;
  const Polygons polygons = read(header(elements) + "4 0 1 2 3\n" + kFourPoints);
  EXPECT_EQ(polygons.corners, (Corners{0, 1, 2, 3}));
  EXPECT_EQ(polygons.positions[2], glm::dvec3(1, 1, 0));
  EXPECT_TRUE(contains(refusal(header(elements) + "4 0 1 2 4\n" + kFourPoints), ".ply:10:"));
}

TEST(PlyVariants, RefusesNumbersOutOfRange) {
  // OpenMesh cannot read these types of list lengths.
  const auto withX = [](const std::string& x) {
    return header("element vertex 4\n" + kXyz + "element face 1\nproperty list ushort int vertex_indices\n") + x +
           " 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n";
  };
  for (const std::string& large :
       {"1" + std::string(310, '0'), "1" + std::string(310, '0') + "e-1", std::string("-1e999")})
    EXPECT_TRUE(contains(refusal(withX(large)), "number out of range")) << large.substr(0, 5);
  for (const std::string& small : {"0." + std::string(400, '0') + "1", std::string("1e-999"), std::string("-1e-400")})
    EXPECT_EQ(read(withX(small)).positions[0].x, 0) << small.substr(0, 5);
}

TEST(PlyVariants, ReadsIntegerCoordinates) {
  const std::string elements =
      "element vertex 3\nproperty int x\nproperty short y\nproperty uchar z\nelement face 1\nproperty list uchar int "
      "vertex_indices\n";
  EXPECT_EQ(read(header(elements) + "-70000 0 200\n1 -300 0\n0 1 0\n3 0 1 2\n").positions[0],
            glm::dvec3(-70000, 0, 200));
  std::string bytes = header(elements, "binary_little_endian");
  for (const std::array<int, 3>& p : {std::array{-16777217, 0, 200}, {1, -300, 0}, {0, 1, 0}}) {
    putInteger(bytes, static_cast<std::uint32_t>(p[0]), 4);
    putInteger(bytes, static_cast<std::uint16_t>(p[1]), 2);
    putInteger(bytes, static_cast<std::uint8_t>(p[2]), 1);
  }
  bytes += '\3';
  for (const unsigned corner : {0u, 1u, 2u}) putInteger(bytes, corner, 4);
  const Polygons binary = read(bytes);
  EXPECT_EQ(binary.positions[0], glm::dvec3(-16777217, 0, 200));  // not representable in float
  EXPECT_EQ(binary.positions[1], glm::dvec3(1, -300, 0));
}

TEST(PlyVariants, KeepsDoublesExactly) {
  const std::string elements =
      "element vertex 3\nproperty double x\nproperty float64 y\nproperty double z\nelement face 1\nproperty list uchar "
      "int "
      "vertex_indices\n";
  EXPECT_EQ(read(header(elements) + "0.1234567890123456 0 1e-300\n1 0 0\n0 1 0\n3 0 1 2\n").positions[0],
            glm::dvec3(0.1234567890123456, 0, 1e-300));
  for (const bool bigEndian : {false, true}) {
    std::string bytes = header(elements, bigEndian ? "binary_big_endian" : "binary_little_endian");
    for (const double x : {0.1234567890123456, 0.0, 1e-300, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0})
      putReal(bytes, x, true, bigEndian);
    bytes += '\3';
    for (const unsigned corner : {0u, 1u, 2u}) putInteger(bytes, corner, 4, bigEndian);
    EXPECT_EQ(read(bytes).positions[0], glm::dvec3(0.1234567890123456, 0, 1e-300));
  }
}

TEST(PlyVariants, NotesColoursAndOtherPropertiesOnce) {
  const std::string elements = "element vertex 3\n" + kXyz +
                               "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar "
                               "alpha\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int "
                               "vertex_indices\nproperty uchar red\nproperty int flags\n";
  EXPECT_EQ(
      read(header(elements) + "0 0 0 1 2 3 4 0 0\n1 0 0 1 2 3 4 0 0\n0 1 0 1 2 3 4 0 0\n3 0 1 2 9 9\n").notes,
      (Notes{"colours of vertices", "other properties of vertices", "colours of faces", "other properties of faces"}));
}

TEST(PlyVariants, SkipsInvalidValues) {
  // MeshLab writes such qualities; OpenMesh fails at them.
  const std::string elements =
      "element vertex 3\n" + kXyz +
      "property float quality\nelement face 1\nproperty list uchar int vertex_indices\nproperty "
      "float quality\n";
  EXPECT_EQ(read(header(elements) + "0 0 0 nan\n1 0 0 -inf\n0 1 0 -nan(ind)\n3 0 1 2 nan\n").faceCount(), 1u);
}

TEST(PlyVariants, ReadsNormals) {
  const std::string elements = "element vertex 3\n" + kXyz +
                               "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list "
                               "uchar int vertex_indices\n";
  const Polygons polygons = read(header(elements) + "0 0 0 0 0 1\n1 0 0 0 .6 .8\n0 1 0 nan 0 1\n3 0 1 2\n");
  EXPECT_EQ(polygons.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 0}}));
  ASSERT_EQ(polygons.notes.size(), 1u);
  EXPECT_CONTAINS(polygons.notes[0], "normals", "finite");
  EXPECT_TRUE(contains(refusal(header(elements) + "0 0 0 0 0 1\n1 0 0 0 x .8\n0 1 0 0 0 1\n3 0 1 2\n"), ".ply:14:"));
}

TEST(PlyVariants, StoresLinesOrBytes) {
  const std::string elements =
      "element vertex 3\n" + kXyz + "element face 2\nproperty list uchar uchar vertex_indices\n";
  const Polygons text = read(header(elements) + "0 0 0\n\n1 0 0\n0 1 0\n3 0 1 2\n\n3 2 1 0\n");
  EXPECT_FALSE(text.locationsAreBytes);
  EXPECT_EQ(text.vertexLocations, (std::vector<std::uint64_t>{10, 12, 13}));
  EXPECT_EQ(text.faceLocations, (std::vector<std::uint64_t>{14, 16}));
  std::string bytes = header(elements, "binary_little_endian");
  const std::size_t begin = bytes.size();
  for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) putReal(bytes, x, false);
  bytes += std::string("\3\0\1\2\3\2\1\0", 8);
  const Polygons binary = read(bytes);
  EXPECT_TRUE(binary.locationsAreBytes);
  EXPECT_EQ(binary.vertexLocations, (std::vector<std::uint64_t>{begin, begin + 12, begin + 24}));
  EXPECT_EQ(binary.faceLocations, (std::vector<std::uint64_t>{begin + 36, begin + 40}));
}

}  // namespace
}  // namespace malus::prep

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::binaryPly;
using test::contains;
using test::errorMessage;
using test::PlyOptions;
using test::TemporaryFile;

Polygons read(const std::string& text) { return test::readCrosschecked(".ply", text); }

void expectRefused(const std::string& text, const std::string& location, const std::string& part) {
  const std::string error = errorMessage([&] {
    const test::TemporaryFile file(".ply", text);
    readMesh(file.path(), true);
  });
  EXPECT_TRUE(contains(error, location)) << text.substr(0, 400) << "\n" << error;
  EXPECT_TRUE(contains(error, part)) << text.substr(0, 400) << "\n" << error;
}

std::string ascii(const std::string& faceProperties = "property list uchar int vertex_indices\n",
                  const std::string& data = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", const std::string& more = "") {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + more +
         "element face 1\n" + faceProperties + "end_header\n" + data;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

void expectTetrahedron(const PlyOptions& options) {
  const Polygons polygons = read(binaryPly(options));
  ASSERT_EQ(polygons.positions.size(), 4u);
  EXPECT_EQ(polygons.positions[3].z, options.doubles ? 0.1 : static_cast<double>(0.1f));
  EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
}

TEST(ScanPly, ReadsBinaryFilesOfAllTypes) {
  PlyOptions options;
  expectTetrahedron(options);
  options.bigEndian = true;
  expectTetrahedron(options);
  options.doubles = true;
  expectTetrahedron(options);
  options.bigEndian = false;
  expectTetrahedron(options);
  options.countType = "int";
  expectTetrahedron(options);
  options.indexType = "uint";
  expectTetrahedron(options);
  options.indexType = "ushort";
  options.indexBytes = 2;
  expectTetrahedron(options);
  options.indexType = "uchar";
  options.indexBytes = 1;
  expectTetrahedron(options);
}

TEST(ScanPly, SkipsOtherProperties) {
  PlyOptions options;
  options.moreVertexProperties = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty double q\n";
  options.moreVertexBytes = 11;
  options.moreFaceProperties = "property ushort a\nproperty float b\n";
  options.moreFaceBytes = 6;
  expectTetrahedron(options);
}

TEST(ScanPly, AcceptsHeadersWithCr) {
  PlyOptions options;
  options.moreVertexProperties = "property uchar q\n";
  options.moreVertexBytes = 1;
  options.lineEnd = "\r\n";
  expectTetrahedron(options);
  EXPECT_EQ(read(binaryPly(options)).notes.back(), "accepted: CR LF line ends in the header of a binary file");
  options.lineEnd = "\r";
  expectTetrahedron(options);
  EXPECT_EQ(read(binaryPly(options)).notes.back(), "accepted: CR line ends");
  expectTetrahedron({.bigEndian = true, .lineEnd = "\r\n"});

  // The last line only; and data that begin with LF after lines that end in CR.
  EXPECT_EQ(read(replaced(binaryPly(), "end_header\n", "end_header\r\n")).faceCount(), 4u);
  std::string shifted = binaryPly({.lineEnd = "\r"});
  shifted[shifted.find("end_header\r") + 11] = '\n';
  EXPECT_EQ(read(shifted).positions[0].x, static_cast<double>(std::bit_cast<float>(0x0000000au)));
}

TEST(ScanPly, RefusesConvertedBinaryData) {
  PlyOptions options;
  options.moreVertexProperties = "property uchar q\n";
  options.moreVertexBytes = 1;
  std::string bytes = binaryPly(options), converted;
  for (char& c : bytes)
    if (c == '\7') c = '\n';
  for (const char c : bytes) converted += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expectRefused(converted, ".ply, byte ", "binary mode");
  converted.replace(converted.size() - 4, 4, std::string(4, '\0'));
  expectRefused(converted, ".ply, byte ", "binary mode");  // zeros at the end are not padding
}

TEST(ScanPly, IgnoresPadding) {
  EXPECT_EQ(read(binaryPly() + std::string(512, '\0')).notes.back(), "padding at the end of the file");
  EXPECT_EQ(read(ascii() + std::string("\0\x1a", 2)).notes.back(), "padding at the end of the file");
  expectRefused(binaryPly() + std::string("\0x", 2), ".ply", "the end of the file");
}

TEST(ScanPly, KeepsFacesOfFewerCorners) {
  const Polygons polygons =
      read(replaced(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n0\n"),
                    "face 1", "face 3"));
  EXPECT_EQ(polygons.firstCorner, (std::vector<std::size_t>{0, 2, 5, 5}));
  EXPECT_EQ(polygons.notes, (std::vector<std::string>{"faces of fewer than three corners"}));
}

TEST(ScanPly, ReadsAsciiVariants) {
  EXPECT_EQ(read(ascii()).faceCount(), 1u);
  std::string crLf;
  for (const char c : ascii()) crLf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(crLf).faceCount(), 1u);
  EXPECT_TRUE(read(crLf).notes.empty());
  std::string cr = ascii();
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  EXPECT_EQ(read(cr).notes, (std::vector<std::string>{"accepted: CR line ends"}));
  EXPECT_EQ(read(ascii("property list uchar int vertex_index\nproperty float q\n", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n"))
                .faceCount(),
            1u);
  EXPECT_EQ(read(replaced(ascii(), "element vertex",
                          "comment end_header\ncomment\nobj_info element vertex 7\nelement vertex"))
                .positions.size(),
            3u);
  EXPECT_EQ(read(replaced(ascii(), "end_header", "element edge 0\nproperty int vertex1\nend_header")).faceCount(), 1u);
}

TEST(ScanPly, RefusesTruncatedFiles) {
  const std::string whole = binaryPly();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(errorMessage([&] { read(whole.substr(0, size)); }).empty()) << size;
  const std::string text = ascii();
  for (std::size_t size = 0; size + 2 < text.size(); ++size)
    EXPECT_FALSE(errorMessage([&] { read(text.substr(0, size)); }).empty()) << size;
}

TEST(ScanPly, SurvivesEveryFlippedBit) {
  const std::string whole = binaryPly();
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    try {
      const Polygons polygons = read(flipped);
      for (const std::uint32_t corner : polygons.corners) ASSERT_LT(corner, polygons.positions.size());
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), ".ply")) << error.what();
    }
  }
}

TEST(ScanPly, RefusesInvalidNumbersAndIndices) {
  expectRefused(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
                ".ply:11:", "nan");
  expectRefused(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                ".ply:13:", "below 3");
  expectRefused(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n"), ".ply:13:", "-1");
  expectRefused(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
                ".ply:11:", "missing numbers");
  std::string bytes = binaryPly();
  std::string nan;
  test::putReal(nan, std::numeric_limits<double>::quiet_NaN(), false);
  bytes.replace(bytes.find("end_header\n") + 11 + 16, 4, nan);
  expectRefused(bytes, ", byte ", "invalid number in vertex 1");
}

TEST(ScanPly, RefusesInvalidHeaders) {
  expectRefused(replaced(ascii(), "end_header\n", ""), ".ply", "unknown statement");
  expectRefused("ply\nformat ascii 1.0\nelement vertex 3\n", ".ply", "end_header");
  expectRefused(ascii("property list float int vertex_indices\n"), ".ply:8:", "not an integer");
  expectRefused(ascii("property list uchar float vertex_indices\n"), ".ply:8:", "integer");
  expectRefused(ascii("property list uchar int corners\n"), ".ply:9:", "vertex_indices");
  expectRefused(ascii("property list uchar int vertex_index\nproperty list uchar int vertex_indices\n"),
                ".ply:10:", "one list");
  expectRefused(ascii("property int vertex_indices\n"), ".ply:9:", "missing corners");
  expectRefused(ascii("property list uchar int vertex_indices\n", "", "property quad q\n"), ".ply:7:", "quad");
  expectRefused(ascii("property list uchar int vertex_indices\n", "", "property float x\n"), ".ply:10:", "duplicate");
  expectRefused(replaced(ascii(), "float z", "float q"), ".ply:9:", "coordinates");
  expectRefused(replaced(ascii(), "float z", "list uchar float z"), ".ply:9:", "coordinates");
  expectRefused(replaced(ascii(), "format ascii 1.0", "comment x\nformat ascii 1.0"), ".ply:2:", "format");
  expectRefused(replaced(ascii(), "ascii", "binary"), ".ply:2:", "binary");
  expectRefused(replaced(ascii(), "1.0", "2.0"), ".ply:2:", "version");
  expectRefused(replaced(ascii(), "vertex 3", "vertex 4000000000"), ".ply:3:", "4000000000");
  expectRefused(replaced(ascii(), "vertex 3", "vertex 100"), ".ply:3:", "found 100");
  expectRefused(replaced(ascii(), "face 1", "face 100"), ".ply:7:", "found 100");
  expectRefused(replaced(ascii(), "vertex 3", "vertex -1"), ".ply:3:", "-1");
  expectRefused(replaced(ascii(), "ply", "Ply"), ".ply:1:", "ply");
  expectRefused(replaced(ascii(), "face 1", "face 0"), ".ply", "content after the elements");
  expectRefused(replaced(ascii(), "element face 1", "property float q\nelement face 1\nelement face 1"),
                ".ply:9:", "duplicate");
  expectRefused(replaced(ascii(), "element vertex 3", "property float q\nelement vertex 3"),
                ".ply:3:", "without an element");
  expectRefused(replaced(ascii(), "end_header", "element camera 1\nend_header"), ".ply:10:", "without properties");
  expectRefused(replaced(ascii(), "element face 1\nproperty list uchar int vertex_indices\n", ""),
                ".ply:7:", "face or tristrips");
  expectRefused("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n",
                ".ply:5:", "expected vertex");
  expectRefused(
      replaced(ascii("property list uchar int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n"), "face 1", "face 0"), ".ply",
      "no faces");
}

TEST(ScanPly, LeavesOutInvalidVerticesAndFaces) {
  const std::string list = "property list uchar int vertex_indices\n";
  for (const char* bad : {"nan 0 0\n", "0 1e99 0\n", "0 0,5 0\n"}) {
    const Polygons polygons = read(replaced(
        replaced(ascii(list, std::string("0 0 0\n1 0 0\n0 1 0\n") + bad + "3 0 1 2\n3 0 1 3\n3 0 1 9\n3 -1 1 2\n"),
                 "face 1", "face 4"),
        "vertex 3", "vertex 4"));
    EXPECT_EQ(polygons.corners, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(polygons.positions.size(), 4u);
    EXPECT_TRUE(std::isfinite(polygons.positions[3].x));
    ASSERT_EQ(polygons.notes.size(), 3u);
    EXPECT_TRUE(contains(polygons.notes[0], "invalid vertices: 1") && contains(polygons.notes[0], ".ply:13")) << bad;
    EXPECT_TRUE(contains(polygons.notes[2], "invalid faces: 3")) << polygons.notes[2];
  }
}

}  // namespace
}  // namespace malus::prep

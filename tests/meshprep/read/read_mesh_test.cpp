#include "meshprep/read/read_mesh.h"

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/read/crosscheck.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::TemporaryFile;

TEST(ReadMesh, RefusesFoldersAndUnknownExtensions) {
  EXPECT_TRUE(contains(errorMessage([] { readMesh("/no/such/file.obj"); }), "/no/such/file.obj: cannot open"));
  EXPECT_TRUE(contains(errorMessage([] { readMesh("mesh.fbx"); }), ".gltf", ".glb", ".fbx"));
  EXPECT_TRUE(contains(errorMessage([] { readMesh("mesh"); }), "no extension"));
  const std::filesystem::path folder = test::temporaryPath(".obj");
  std::filesystem::create_directory(folder);
  EXPECT_TRUE(contains(errorMessage([&] { readMesh(folder); }), "not a regular file"));
  std::filesystem::remove(folder);
}

TEST(ReadMesh, RefusesEmptyFiles) {
  for (const char* extension : {".obj", ".ply", ".stl", ".off"}) {
    const TemporaryFile file(extension, "");
    EXPECT_TRUE(contains(errorMessage([&] { readMesh(file.path()); }), "is empty")) << extension;
  }
}

TEST(ReadMesh, AcceptsExtensionsInUpperCase) {
  const TemporaryFile file(".OBJ", test::objText(test::cube()));
  EXPECT_EQ(readMesh(file.path()).faceCount(), 12u);
}

TEST(ReadMesh, ReadsFormatsInAnyOrder) {
  // OpenMesh's readers keep state between files.
  const TemporaryFile binary(".ply", test::binaryPly());
  const TemporaryFile text(
      ".ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const TemporaryFile off(".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(test::readCrosschecked(binary.path()).faceCount(), 4u);
    EXPECT_EQ(test::readCrosschecked(off.path()).faceCount(), 1u);
    EXPECT_EQ(test::readCrosschecked(text.path()).faceCount(), 1u);
  }
}

TEST(ReadMesh, AgreesWithOpenMeshOnNumbersOfAllSizes) {
  std::string text;
  for (int exponent = -45; exponent <= 38; ++exponent)
    text += fmt::format("v 1.23456789e{} -3.4e{} {}\n", exponent, exponent, exponent / 7.0);
  const TemporaryFile file(".obj", text + "f 1 2 3\n");
  EXPECT_EQ(test::readCrosschecked(file.path()).positions.size(), 84u);
}

TEST(ReadMesh, RefusesPipes) {
  const std::filesystem::path pipe = test::temporaryPath(".obj");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(test::contains(test::errorMessage([&] { readMesh(pipe); }), "regular file"));
  std::filesystem::remove(pipe);
}

}  // namespace
}  // namespace malus::prep

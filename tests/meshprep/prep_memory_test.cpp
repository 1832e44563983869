// Memory of `malus prep` by the placed triangles: a file that places a mesh 200 times, apart, mirrored and in pairs
// that nearly touch. A separate program, because the largest memory of a process counts.
#include <unistd.h>

#include <algorithm>
#include <cstddef>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/cli.h"
#include "meshprep/compress/mesh_file.h"
#include "tests/largest_memory.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

constexpr unsigned kAlarmSeconds = 240;  // far above the usual time of a second
constexpr int kPlaces = 200;
constexpr std::size_t kBytesPerTriangle = 140;  // mesh, normals, Draco's input, its tables and its result
constexpr std::size_t kProgram = std::size_t{24} << 20u;

TEST(PrepMemory, IsThatOfThePlacedTriangles) {
  ::alarm(kAlarmSeconds);
  const Mesh mesh = test::sphere(51, 100);
  test::GltfFile gltf;
  gltf.addMesh(mesh, "ball");
  for (int i = 0; i < kPlaces; ++i)
    gltf.addNode({{"mesh", 0},
                  {"scale", {i % 2 == 0 ? 1.0 : -1.0, 1.0, 1.0}},
                  {"translation", {5.0 * (i % 20) + (i % 3 == 0 ? 2.9999 : 0.0), 5.0 * (i / 20), 0.0}}});
  const test::TemporaryFile input(".glb", gltf.glb());
  const std::filesystem::path output = test::temporaryPath(".mesh.drc");
  std::vector<std::string> arguments = {"prep", input.path().string(), "-o", output.string(), "--certify", "glass"};
  std::reverse(arguments.begin(), arguments.end());
  CLI::App app;
  addPrepCommand(app);
  app.parse(arguments);
  const std::size_t triangles = kPlaces * mesh.triangles.size();
  EXPECT_LT(malus::test::largestMemory(), triangles * kBytesPerTriangle + kProgram);

  // The file is that of all triangles.
  const compress::TriangleMesh delivered = compress::decodeMeshFile(readFile(output), "file");
  EXPECT_EQ(delivered.triangles.size(), triangles);
  ::alarm(0);
  std::filesystem::remove(output);
}

}  // namespace
}  // namespace malus::prep

// Memory by the stored triangles: a file that places a mesh of 20000 triangles 200 times is baked in the memory of a
// few such meshes. A separate program, because the largest memory of a process counts.
#include <unistd.h>

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/meshes/glass_bodies.h"
#include "bake/pack/instances.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/largest_memory.h"
#include "tests/meshprep/read/gltf_files.h"

namespace malus::bake {
namespace {

constexpr unsigned kAlarmSeconds = 120;  // far above the usual time of less than a second
constexpr std::uint32_t kAround = 100, kRings = 101;
constexpr int kPlaces = 200;

prep::Mesh sphere() {
  prep::Mesh mesh;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double theta = std::numbers::pi * ring / kRings, phi = 2 * std::numbers::pi * i / kAround;
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround, c = a + kAround,
                          d = b + kAround;
      if (ring > 0) mesh.triangles.emplace_back(a, b, c);
      if (ring + 1 < kRings) mesh.triangles.emplace_back(b, d, c);
    }
  return mesh;
}

TEST(InstancesMemory, IsThatOfTheStoredTriangles) {
  ::alarm(kAlarmSeconds);
  prep::test::GltfFile gltf;
  gltf.document["materials"] = {{{"name", "steel"}, {"pbrMetallicRoughness", {{"roughnessFactor", 0.0}}}}};
  const prep::Mesh mesh = sphere();
  gltf.addMesh(mesh, "ball", 0);
  for (int i = 0; i < kPlaces; ++i)
    gltf.addNode({{"name", fmt::format("ball {}", i)},
                  {"mesh", 0},
                  {"scale", {i % 2 == 0 ? 1.0 : -1.0, 1.0, 1.0 + 0.01 * i}},
                  {"translation", {5.0 * (i % 20), 5.0 * (i / 20), 0.0}}});
  test::TemporaryFolder folder;
  folder.write("model.glb", gltf.glb());
  const nlohmann::json document = nlohmann::json::parse(R"({
    "malus": 1, "name": "test", "origin": [0, 0, 0],
    "camera": {"position": [0, 1, 50], "target": [0, 0, 0], "verticalFovDegrees": 30},
    "resolution": [64, 48], "depth": 4, "materials": {"gold": {"type": "metal", "preset": "gold"}},
    "imports": [{"file": "model.glb"}]})");
  const SceneDescription description = readSceneFile(folder.write("scene.json", document.dump()));

  const std::size_t before = malus::test::largestMemory();
  const Baked baked = bake(description, {}, [](std::string_view) {}, {});
  const pack::Scene scene = pack::parse(pack::serialize(baked.scene, {}).bytes, "test").scene;
  const std::size_t used = malus::test::largestMemory() - before;
  const pack::InstanceCounts counts = pack::countInstances(scene);
  EXPECT_EQ(scene.triangleCount(), mesh.triangles.size());
  EXPECT_EQ(counts.placements, static_cast<std::uint64_t>(kPlaces));
  EXPECT_EQ(counts.placedTriangles, kPlaces * mesh.triangles.size());
  // Positions, normals and triangles of the copies alone would take more than four times as much.
  EXPECT_LT(used, counts.placedTriangles * 12 + (std::size_t{16} << 20));
  ::alarm(0);
}

}  // namespace
}  // namespace malus::bake

// Small scenes, packs and files shared by the tests of baking.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bake/pack/scene.h"
#include "meshprep/base/error.h"
#include "tests/messages.h"

namespace malus::bake::test {

// A temporary folder, removed by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> counter{0};
    path_ = std::filesystem::path(testing::TempDir()) / fmt::format("malus-bake-{}-{}", ::getpid(), counter++);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(std::string_view name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream stream(file, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream.flush()) throw Error(file.string(), "cannot write");
    return file;
  }

 private:
  std::filesystem::path path_;
};

using malus::test::contains;
using malus::test::errorMessage;

// A cube of side 1 about the origin, as quads of an OBJ file, facing outward.
inline constexpr std::string_view kCubeObj =
    "v -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv 0.5 0.5 -0.5\nv -0.5 0.5 -0.5\n"
    "v -0.5 -0.5 0.5\nv 0.5 -0.5 0.5\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
// A square of side 1 in the plane y = 0, facing up.
inline constexpr std::string_view kSquareObj = "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nf 4 3 2 1\n";

// A scene with all required sections, small enough to flip every bit of its pack.
inline pack::Scene smallScene() {
  pack::Scene scene;
  scene.name = "small";
  scene.title = "A title with \xc3\xa4";
  scene.origin = {1e5, -2, 3.25};
  scene.width = 64;
  scene.height = 48;
  scene.depth = 5;
  scene.exposureEv = -0.5;
  scene.camera.position = {0.25, 1.5, 4};
  scene.camera.right = {0, 0, 1};
  scene.camera.up = {0, 1, 0};
  scene.camera.forward = {1, 0, 0};
  scene.camera.verticalFovDegrees = 33;
  scene.camera.mediumEta = 1.33;
  scene.environment.radiance = {0.1, 0.2, 0.3};
  scene.environment.size = 2;
  for (int i = 0; i < 16; ++i)
    scene.environment.texels.emplace_back(0.25f * static_cast<float>(i), 0.5f, static_cast<float>(i));
  scene.environment.ambientIrradiance = 0.75;
  for (std::size_t i = 0; i < 9; ++i) scene.environment.irradiance[i] = {0.5, -0.25, static_cast<double>(i)};
  scene.lights = {{{1, 2, 3}, {10, 11, 12}}, {{-1, -2, -3}, {0, 0, 5}}};
  pack::Material glass;
  glass.name = "glass";
  glass.kind = pack::MaterialKind::glass;
  glass.eta = glm::dvec3(1.5195);
  glass.outsideEta = 1.25;
  pack::Material gold;
  gold.name = "gold";
  gold.kind = pack::MaterialKind::metal;
  gold.eta = {0.1884, 0.5439, 1.3319};
  gold.k = {3.4034, 2.2309, 1.8693};
  gold.albedo = {0.125, 0.25, 0.5};
  gold.highlightStrength = 0.5;
  gold.highlightExponent = 200;
  pack::Material lamp;
  lamp.name = "lamp";
  lamp.kind = pack::MaterialKind::emitter;
  lamp.radiance = {7, 8, 9};
  scene.materials = {glass, gold, lamp};
  pack::Mesh tetrahedron;
  tetrahedron.name = "tetrahedron";
  tetrahedron.material = 1;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.normals = {{-0.57735026f, -0.57735026f, -0.57735026f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  pack::Mesh sheet;
  sheet.name = "sheet";
  sheet.material = 0;
  sheet.openSurface = true;
  sheet.positions = {{2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {tetrahedron, sheet};
  scene.effects = {{"metal", true, "there is gold"}, {"textures", false, "none"}};
  scene.provenance = R"({"malus":"0"})";
  return scene;
}

// A small scene whose gold has maps by texture coordinates.
inline pack::Scene mappedScene() {
  pack::Scene scene = smallScene();
  scene.textures = {{"image", 2, 1, {{0.25f, 0.5f, 1}, {0, 0.125f, 0.75f}}}};
  pack::MeshMaps& maps = scene.materials[1].meshMaps;
  maps.albedo = {0, 1, pack::Wrap::clamp, pack::Wrap::mirror, {1, 2, 3}, {-4, 5, 6}};
  maps.normal.texture = 0;
  maps.normalScale = -2;
  maps.cutoff = 0.25;
  return scene;
}

// A small scene with all optional sections.
inline pack::Scene unusualScene() {
  pack::Scene scene = smallScene();
  scene.environment.sun = {0.6, 0.8, 0};
  scene.environment.skyDegree = 0.75;
  scene.wavelengthsNm = {650, 550, 450};
  pack::Texture letters{"letters.png", 2, 1, {{0.25f, 0.5f, 1}, {0, 0.125f, 0.75f}}};
  pack::Texture metal{"metal.exr", 1, 2, {{0.5f, 1, 1.5f}, {2, 3, 4}}};
  scene.textures = {letters, metal};
  pack::Material& glass = scene.materials[0];
  glass.absorption = {1, 2, 3};
  glass.outsideAbsorption = {0, 0.5, 0};
  glass.coating = {{1.38, 1.37, 1.36}, 96.4};
  pack::Material& gold = scene.materials[1];
  gold.roughness = 0.25;
  gold.maps = {0, 1, 1, {1, 2, 3}, {0.5, 0, 0}, {0, -0.5, 0}};
  pack::Material& lamp = scene.materials[2];
  lamp.axis = {0, 0.6, -0.8};
  lamp.polarization = 0.875;
  pack::Material polarizer;
  polarizer.name = "polarizer";
  polarizer.kind = pack::MaterialKind::polarizer;
  polarizer.axis = {1, 0, 0};
  polarizer.transmittanceParallel = {0.9, 0.8, 0.7};
  polarizer.transmittanceCrossed = {0.01, 0.02, 0.03};
  pack::Material plate;
  plate.name = "plate";
  plate.kind = pack::MaterialKind::wavePlate;
  plate.axis = {0, 0.8, 0.6};
  plate.retardanceDegrees = {76, 90, 103};
  lamp.twoSided = true;
  pack::Mesh& mesh = scene.meshes[0];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto step = static_cast<float>(i);
    mesh.textureCoordinates[0].emplace_back(step * 0.25f, 1 - step * 0.125f);
    mesh.textureCoordinates[1].emplace_back(-step, step * 2);
    mesh.tangents.emplace_back(0.6f, 0, i % 2 == 0 ? 0.8f : -0.8f, i < 2 ? 1.0f : -1.0f);
  }
  scene.instances = {{"mirrored", 1, {{-2, 0, 0}, {0, 2, 0}, {0, 0.5, 2}}, {1, 2, 3}},
                     {"far", 1, glm::dmat3(0.5), {1e5, 0, 0}}};
  scene.lightBeyond = {0.75, 0.25, 0.25, 0.001};
  scene.materials.push_back(polarizer);
  scene.materials.push_back(plate);
  return scene;
}

}  // namespace malus::bake::test

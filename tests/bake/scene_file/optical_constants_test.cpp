// Optical constants of a scene from files and presets, at its wavelengths.
#include <cmath>

#include <nlohmann/json.hpp>

#include "bake/scene_file/scene_file.h"
#include "tests/bake/scene_file/scene_texts.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;
using test::minimal;

TEST(SceneOpticalConstants, FromAFile) {
  const test::TemporaryFolder folder;
  folder.write("a.csv", "wl,n,k\n0.4,1.6,4e-8\n0.7,1.3,1e-8\n");
  const auto read = [&](const char* material, const char* wavelengths) {
    json scene = minimal();
    scene["materials"]["floor"] = json::parse(material);
    if (*wavelengths != 0) scene["wavelengthsNm"] = json::parse(wavelengths);
    return readSceneFile(folder.write("scene.json", scene.dump()));
  };
  const SceneDescription scene = read(R"({"type": "glass", "preset": "a.csv"})", "[700, 550, 400]");
  EXPECT_NEAR(scene.materials[0].eta.y, 1.45, 1e-12);
  EXPECT_EQ(scene.materials[0].k, glm::dvec3(0));
  // Beer's law: 4 pi k / wavelength.
  EXPECT_NEAR(scene.materials[0].absorption.x, 4 * std::acos(-1.0) * 1e-8 / 700e-9, 1e-12);
  EXPECT_NEAR(scene.materials[0].absorption.z, 4 * std::acos(-1.0) * 4e-8 / 400e-9, 1e-12);
  ASSERT_EQ(scene.opticalFiles.size(), 1u);
  EXPECT_EQ(scene.opticalFiles[0].filename(), "a.csv");
  EXPECT_EQ(read(R"({"type": "glass", "preset": "a.csv", "absorption": 2})", "").materials[0].absorption,
            glm::dvec3(2));
  EXPECT_EQ(read(R"({"type": "thin-glass", "preset": "a.csv"})", "").materials[0].absorption, glm::dvec3(0));
  EXPECT_NEAR(read(R"({"type": "metal", "preset": "a.csv"})", "").materials[0].k.z, 4e-8 - 65.0 / 300 * 3e-8, 1e-15);
  const std::string outside = errorMessage([&] { read(R"({"type": "glass", "preset": "a.csv"})", "[800, 550, 400]"); });
  EXPECT_TRUE(contains(outside, "materials.floor.preset", "a.csv", "400 to 700 nm")) << outside;
  const std::string gold = errorMessage([&] { read(R"({"type": "metal", "preset": "gold"})", "[2000, 550, 400]"); });
  EXPECT_TRUE(contains(gold, "materials.floor.preset", "gold", "2000 nm")) << gold;
  EXPECT_EQ(read(R"({"type": "metal", "preset": "gold"})", "[582.1, 582.1, 582.1]").materials[0].eta, glm::dvec3(0.29));
  EXPECT_TRUE(
      contains(errorMessage([&] { read(R"({"type": "lambert", "albedo": 0.5})", "[0, 1, 2]"); }), "wavelengthsNm"));
}

}  // namespace
}  // namespace malus::bake

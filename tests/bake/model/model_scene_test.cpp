// Scenes from model files alone: camera, lights, environment, depth and exposure by rule, and the scene.json of it.
#include "bake/model/model_scene.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/environment/octahedral_map.h"
#include "bake/environment/studio.h"
#include "bake/model/pack_cache.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/write_scene_file.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/image.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/read/gltf_files.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;

constexpr auto kSilent = [](std::string_view) {};

class Model : public testing::Test {
 protected:
  void SetUp() override {
    prep::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    gltf_.addMesh(mesh, "tetrahedron");
    gltf_.addNode({{"mesh", 0}});
  }

  void addCameras() {
    gltf_.add("cameras",
              {{"name", "lens"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}}}});
    gltf_.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"aspectRatio", 0.5}}}});
    gltf_.addNode({{"name", "front"}, {"camera", 0}, {"translation", {1, 2, 9}}});
    const double half = std::sqrt(0.5);
    gltf_.addNode({{"name", "side"}, {"camera", 1}, {"translation", {9, 0, 0}}, {"rotation", {0, half, 0, half}}});
  }
  void addLights() {
    gltf_.document["extensions"] = {
        {"KHR_lights_punctual",
         {{"lights",
           {{{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}},
            {{"type", "spot"}, {"intensity", 3}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
            {{"type", "directional"}, {"intensity", 5}}}}}}};
    gltf_.document["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf_.addNode(
        {{"name", "bulb"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {1, 5, 2}}});
    gltf_.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}, {"translation", {0, 0, 7}}});
    gltf_.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}});
  }
  std::filesystem::path file() const { return folder_.write("a model.glb", gltf_.glb()); }
  Baked baked(const ModelOptions& options = {}) const { return bake(describeModel(file(), options), {}, kSilent); }
  std::string errorWith(const std::string& camera) const {
    return errorMessage([&] { baked({camera, {}}); });
  }
  std::filesystem::path environmentFile() const {
    image::Image image;
    image.width = 8;
    image.height = 4;
    image.channels = {"R", "G", "B"};
    for (int i = 0; i < 96; ++i) image.pixels.push_back(0.1f * static_cast<float>(i % 7));
    image::writeExr(folder_.path() / "sky.exr", image);
    return folder_.path() / "sky.exr";
  }

  test::TemporaryFolder folder_;
  prep::test::GltfFile gltf_;
};

TEST(ModelFile, IsRecognizedByItsExtension) {
  for (const char* name : {"a.glb", "a.GLTF", "b/a.obj", "a.ply", "a.stl", "a.off"})
    EXPECT_TRUE(isModelFile(name)) << name;
  for (const char* name : {"a.json", "a.pack", "glb", "a.glb.pack", ""}) EXPECT_FALSE(isModelFile(name)) << name;
}

TEST_F(Model, HasAFramingCameraAndAStudio) {
  const Baked result = baked();
  const pack::Scene& scene = result.scene;
  EXPECT_EQ(scene.name, "a-model");
  EXPECT_EQ(scene.title, "a model.glb");
  EXPECT_EQ(scene.width, 1280u);
  EXPECT_EQ(scene.height, 960u);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_GT(scene.environment.size, 0u);
  EXPECT_EQ(scene.environment.ambientIrradiance, 1);
  EXPECT_TRUE(scene.environment.illuminates);
  EXPECT_EQ(result.description.environmentPreset, kStudioPreset);
  EXPECT_GT(glm::dot(scene.camera.position, glm::dvec3(1, 0, 1)), 0);
  EXPECT_TRUE(result.notes.empty());
}

TEST_F(Model, UsesTheFirstCameraOrTheOneAskedFor) {
  addCameras();
  for (const char* camera : {"", "front", "lens", "0"}) {
    const Baked result = baked({camera, {}});
    const pack::Camera& first = result.scene.camera;
    EXPECT_EQ(first.position + result.scene.origin, glm::dvec3(1, 2, 9)) << camera;
    EXPECT_EQ(first.forward, glm::dvec3(0, 0, -1));
    EXPECT_EQ(first.up, glm::dvec3(0, 1, 0));
    EXPECT_DOUBLE_EQ(first.verticalFovDegrees, 0.5 * 180 / std::numbers::pi);
    EXPECT_EQ(result.scene.width, 1280u);
    EXPECT_EQ(result.scene.height, 853u);
    EXPECT_EQ(result.description.cameraTarget, glm::dvec3(1, 2, 1));  // at the depth of the centre
  }
  for (const char* camera : {"side", "1"}) {
    const Baked result = baked({camera, {}});
    EXPECT_NEAR(result.scene.camera.forward.x, -1, 1e-12) << camera;
    EXPECT_EQ(result.scene.width, 640u);
    EXPECT_EQ(result.scene.height, 1280u);
    EXPECT_EQ(result.description.environmentRotationDegrees, 90);  // the studio faces the camera
  }
  EXPECT_EQ(baked({"frame", {}}).scene.camera.verticalFovDegrees, 30);
  EXPECT_CONTAINS(errorWith("frnt"), "a model.glb", "'frnt'", "'front'", "below 2");
  EXPECT_CONTAINS(errorWith("2"), "'2'", "below 2");
  EXPECT_CONTAINS(errorWith("-1"), "'-1'");
}

TEST_F(Model, RefusesCamerasThatASceneCannotHave) {
  EXPECT_CONTAINS(errorWith("front"), "has none");
  gltf_.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 3.1}}}});
  gltf_.addNode({{"name", "fisheye"}, {"camera", 0}});
  EXPECT_CONTAINS(errorWith(""), "'fisheye'", "field of view", "170", "--camera frame");
  EXPECT_EQ(errorWith("frame"), "");
}

TEST_F(Model, UsesOrthographicCameras) {
  gltf_.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}}}});
  gltf_.addNode({{"camera", 0}, {"translation", {0, 0, 5}}});
  const Baked result = baked();
  EXPECT_EQ(result.scene.camera.orthographicHeight, 4);
  EXPECT_EQ(result.scene.width, 1280u);
  EXPECT_EQ(result.scene.height, 853u);
}

TEST_F(Model, UsesTheLightsOfTheFile) {
  addLights();
  const Baked result = baked();
  ASSERT_EQ(result.scene.lights.size(), 3u);
  const pack::LightSource &spot = result.scene.lights[1], &sun = result.scene.lights[2];
  EXPECT_EQ(spot.kind, pack::LightKind::spot);
  EXPECT_EQ(spot.direction, glm::dvec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(spot.innerConeDegrees, 0.25 * 180 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(spot.outerConeDegrees, 0.5 * 180 / std::numbers::pi);
  EXPECT_EQ(sun.kind, pack::LightKind::directional);
  EXPECT_EQ(sun.position, glm::dvec3(0));
  EXPECT_EQ(sun.intensity, glm::dvec3(5));  // lux as W/m^2
  EXPECT_EQ(result.scene.lights[0].position + result.scene.origin, glm::dvec3(1, 5, 2));
  EXPECT_EQ(result.scene.lights[0].intensity, glm::dvec3(8, 4, 2));  // candela as W/sr
  EXPECT_EQ(result.scene.environment.size, 0u);
  EXPECT_EQ(result.scene.environment.radiance, glm::dvec3(0));
  const Baked both = baked({"", environmentFile()});
  EXPECT_EQ(both.scene.lights.size(), 3u);
  EXPECT_GT(both.scene.environment.size, 0u);
}

// All sections but the provenance, which names the sources.
std::vector<pack::Section> sections(const pack::Scene& scene) {
  std::vector<pack::Section> list = pack::parse(pack::serialize(scene, {}).bytes, "test").sections;
  std::erase_if(list, [](const pack::Section& s) { return s.id == std::string("PROV"); });
  return list;
}

TEST_F(Model, TheWrittenSceneGivesTheSamePack) {
  const auto check = [&](const ModelOptions& options) {
    Baked model = baked(options);
    std::vector<std::string> choices;
    applyModelProbe({{0.5, 0.25, 0.01}, {0.125, 0.5}, {}, {}, 0, 0, 0}, model.description, model.scene, choices);
    const std::filesystem::path path = folder_.path() / "scenes" / "scene.json";
    std::filesystem::create_directories(path.parent_path());
    folder_.write("scenes/scene.json", sceneFileText(model.description, path));
    const SceneDescription description = readSceneFile(path);
    EXPECT_TRUE(description.deprecations.empty());
    const Baked again = bake(description, {}, kSilent);
    const std::vector<pack::Section> expected = sections(model.scene), found = sections(again.scene);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i].hash, expected[i].hash) << "section " << found[i].id;
    EXPECT_EQ(again.scene.depth, 3u);
  };
  check({});
  check({"", environmentFile()});
  addCameras();
  check({"side", {}});
  addLights();
  check({"front", {}});
  EXPECT_CONTAINS(readTextFile(folder_.path() / "scenes" / "scene.json"), "../a model.glb", "\"point\"");
}

TEST_F(Model, TheProvenanceNamesTheOptions) {
  addCameras();
  const auto provenance = [&](const ModelOptions& options) {
    return makeProvenance(describeModel(file(), options), {});
  };
  EXPECT_EQ(provenance({}), provenance({}));
  EXPECT_NE(provenance({}), provenance({"side", {}}));
  EXPECT_NE(provenance({}), provenance({"", environmentFile()}));
}

TEST_F(Model, ReportsContentThatIsLeftOutOnce) {
  addCameras();
  gltf_.document["animations"] = {{{"name", "run"}}};
  for (int i = 0; i < 2; ++i) gltf_.add("materials", {{"occlusionTexture", {{"index", 0}}}});
  const std::vector<std::string> notes = baked().notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_CONTAINS(notes[0], "animations (1: 'run'", "occlusion textures (2)");
  EXPECT_FALSE(contains(notes[0], "camera"));
}

TEST(ModelProbe, SetsDepthAndExposure) {
  const auto chosenDepth = [](std::vector<double> beyond) {
    SceneDescription description;
    pack::Scene scene;
    std::vector<std::string> choices;
    applyModelProbe({std::move(beyond), {}, {}, {}, 0, 0, 0}, description, scene, choices);
    EXPECT_EQ(scene.depth, description.depth);
    return scene.depth;
  };
  EXPECT_EQ(chosenDepth({}), kLeastModelDepth);
  EXPECT_EQ(chosenDepth({0.5, 0.3, 0.2, 0.1, 2e-4, 9e-5}), 5u);
  EXPECT_EQ(chosenDepth(std::vector<double>(200, 0.5)), kMostModelDepth);

  // A model that its lights do not reach is reported.
  const auto choicesFor = [](std::vector<double> pixels) {
    SceneDescription description;
    pack::Scene scene;
    std::vector<std::string> choices;
    applyModelProbe({{}, std::move(pixels), {}, {}, 0, 0, 0}, description, scene, choices);
    return choices.back();
  };
  EXPECT_CONTAINS(choicesFor({0, 0, 0}), "black", "--environment");
  EXPECT_CONTAINS(choicesFor({0, 0.1, 0}), "exposure");

  // 0.8 is white enough; half as much light needs a stop more.
  EXPECT_EQ(measuredExposure({}), 0);
  EXPECT_EQ(measuredExposure({0, 0}), 0);
  EXPECT_EQ(measuredExposure(std::vector<double>(100, 0.8)), 0);
  EXPECT_EQ(measuredExposure(std::vector<double>(100, 0.4)), 1);
  EXPECT_EQ(measuredExposure(std::vector<double>(100, 0.8 * 1024)), -10);
  std::vector<double> highlights(100, 0.8);
  for (std::size_t i = 0; i < 4; ++i) highlights[i] = 1e6;
  highlights.resize(1000);  // black
  EXPECT_EQ(measuredExposure(highlights), 0);
}

TEST(Studio, IsNeutralAndOfKnownIrradiance) {
  const image::Image image = studioImage();
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    ASSERT_EQ(image.pixels[i], image.pixels[i + 1]);
    ASSERT_EQ(image.pixels[i], image.pixels[i + 2]);
    ASSERT_GT(image.pixels[i], 0.1f);
  }
  // The irradiance on normals all around, by the sum over the pixels.
  const auto irradiance = [&](const glm::dvec3& normal) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double theta = (y + 0.5) / image.height * std::numbers::pi,
                     phi = ((x + 0.5) / image.width - 0.5) * 2 * std::numbers::pi;
        const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
        const double pixel = image.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                               static_cast<std::size_t>(x))];
        sum += pixel * std::max(glm::dot(d, normal), 0.0) * std::sin(theta);
      }
    return sum * 2 * std::numbers::pi * std::numbers::pi / (image.width * image.height);
  };
  const double key = irradiance(glm::normalize(glm::dvec3(-0.7, 1, 0.6)));
  EXPECT_NEAR(key / std::numbers::pi, 1, 0.06);
  EXPECT_GT(irradiance({-1, 0, 0}), 1.2 * irradiance({1, 0, 0}));  // the key light is to the left
  EXPECT_GT(irradiance({0, -1, 0}), 0.15 * std::numbers::pi);      // nothing is black
}

TEST(PackCache, KeepsThePacksThatWereUsedLast) {
  const test::TemporaryFolder folder;
  const auto now = std::filesystem::file_time_type::clock::now();
  for (int i = 0; i < 4; ++i) {
    const auto file = folder.write("p" + std::to_string(i) + ".pack", std::string(100, 'x'));
    std::filesystem::last_write_time(file, now - std::chrono::hours(10 - i));
  }
  folder.write("other.txt", std::string(1000, 'x'));
  trimPacks(folder.path(), 250, folder.path() / "p0.pack");
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder.path() / name); };
  EXPECT_TRUE(exists("p0.pack"));  // in use
  EXPECT_FALSE(exists("p1.pack"));
  EXPECT_FALSE(exists("p2.pack"));
  EXPECT_TRUE(exists("p3.pack"));
  EXPECT_TRUE(exists("other.txt"));
}

}  // namespace
}  // namespace malus::bake

// Batches: images of frames, acceleration structures that stay, resuming, shards and their merge.
#include "render/batch/batch.h"

#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "bake/environment/rotation.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "render/batch/merge.h"
#include "render/image/output.h"
#include "render/make_renderer.h"
#include "tests/render/batch/batch_folder.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Batch : public test::BatchFolder {
 protected:
  static BatchResult run(const fs::path& folder, const Jobs& jobs, Shard shard = {}, FrameOutputs outputs = {}) {
    FrameRenderer renderer(test::batchPack(), Backend::embree, "", 1);
    FrameDefaults defaults = test::batchDefaults();
    defaults.outputs = outputs;
    return runBatch({folder, defaults, 0, shard}, jobs, renderer);
  }
};

// The image of a scene by a new renderer.
std::vector<float> renderAlone(const pack::Scene& scene, Backend backend = Backend::embree) {
  RenderParameters parameters = defaultParameters(scene);
  return makeRenderer(backend, scene, {"", 1})->render("stokes", parameters).pixels;
}

TEST(FrameRenderer, FramesAreTheImagesOfTheirScenes) {
  const pack::Scene base = test::batchPack().scene;
  pack::Scene moved = base, changed = base, dark = base;
  test::look(moved, {1, -2, 4}, {0.5, 0, 0.5});
  changed.materials[0].eta = glm::dvec3(0.5);
  changed.materials[0].roughness = 0.3;
  changed.materials[1].albedo = {0.1, 0.2, 0.3};
  changed.materials[1].coating = {glm::dvec3(1.8), 120};
  dark.lights.clear();
  dark.materials[3].radiance = glm::dvec3(0);
  const std::pair<const char*, const pack::Scene*> kFrames[] = {
      {"{}", &base},
      {R"({"camera": {"position": [11, -2, 1], "target": [10.5, 0, -2.5]}})", &moved},
      {R"({"materials": {"gold": {"eta": 0.5, "roughness": 0.3},
           "wall": {"albedo": [0.1, 0.2, 0.3], "coating": {"eta": 1.8, "thicknessNm": 120}}}})",
       &changed},
      {R"({"lights": false, "materials": {"lamp": {"radiance": [0, 0, 0]}}})", &dark},
      {"{}", &base}};
  for (const Backend backend : {Backend::embree, Backend::reference}) {
    FrameRenderer renderer(test::batchPack(), backend, "", 1);
    for (const auto& [settings, scene] : kFrames) {
      Frame frame = test::readFrame(settings, renderer.scene());
      frame.job.backend = backend;
      const std::vector<float> pixels = renderer.render(frame).image.pixels, expected = renderAlone(*scene, backend);
      ASSERT_EQ(pixels.size(), expected.size());
      for (std::size_t i = 0; i < pixels.size(); ++i)
        ASSERT_NEAR(pixels[i], expected[i], 1e-6 * (1 + std::abs(expected[i]))) << settings;
    }
    EXPECT_EQ(renderer.builds(), 1u);   // no frame needs another acceleration structure
    EXPECT_EQ(renderer.updates(), 3u);  // changed, dark and the last one; cameras need none
  }
}

// Effects are decided anew per frame, and removed ones come back.
TEST(FrameRenderer, EffectsFollowTheFrame) {
  FrameRenderer renderer(test::batchPack(), Backend::embree, "", 1);
  const auto render = [&](const std::string& settings) {
    return renderer.render(test::readFrame(settings, renderer.scene()));
  };
  const RenderedFrame first = render("{}");
  const RenderedFrame without = render(R"({"effects": "diffuse,dielectric,metal,thin-glass,shadows"})");
  EXPECT_NE(without.image.pixels, first.image.pixels);
  EXPECT_EQ(render("{}").image.pixels, first.image.pixels);
  // Without light that is polarized, a cheaper method is exact for the intensity.
  EXPECT_EQ(render(R"({"outputs": ["png"], "depth": 0, "lights": false,
                       "materials": {"lamp": {"illuminates": false}}})")
                .method,
            "fresnel");
  EXPECT_EQ(first.method, "stokes");
  EXPECT_EQ(renderer.builds(), 1u);
}

// The environment of each frame is rotated from that of the pack, not from that of the frame before.
TEST(FrameRenderer, EnvironmentsRotateFromThatOfThePack) {
  pack::Pack pack = test::batchPack();
  pack::Environment& sky = pack.scene.environment;
  sky.size = 64;
  sky.texels.resize(66 * 66);
  for (std::size_t i = 0; i < sky.texels.size(); ++i) sky.texels[i] = glm::vec3(static_cast<float>(i % 13), 1, 2);
  bake::fillOctahedralBorder(sky);
  pack::Scene rotated = pack.scene;
  bake::rotateEnvironment(70, rotated.environment);
  FrameRenderer renderer(pack, Backend::embree, "", 1);
  const auto render = [&](const std::string& settings) {
    return renderer.render(test::readFrame(settings, renderer.scene())).image.pixels;
  };
  const std::string turned = R"({"environment": {"rotationDegrees": 70}})";
  const std::vector<float> first = render("{}");
  EXPECT_EQ(first, renderAlone(pack.scene));
  EXPECT_EQ(render(turned), renderAlone(rotated));
  EXPECT_NE(render(turned), first);
  EXPECT_EQ(render(R"({"environment": {"rotationDegrees": 20}})").size(), first.size());
  EXPECT_EQ(render(turned), renderAlone(rotated));
  EXPECT_EQ(render("{}"), first);
}

// A surface that vanishes changes the acceleration structure.
TEST(FrameRenderer, RebuildsForSurfacesThatVanish) {
  pack::Scene without = test::batchPack().scene;
  without.materials[2].eta = glm::dvec3(1);
  FrameRenderer renderer(test::batchPack(), Backend::embree, "", 1);
  renderer.render(test::readFrame("{}", renderer.scene()));
  const Frame frame = test::readFrame(R"({"effects": "all", "materials": {"pane": {"eta": 1}}})", renderer.scene());
  EXPECT_EQ(renderer.render(frame).image.pixels, renderAlone(without));
  EXPECT_EQ(renderer.builds(), 2u);
}

TEST(FrameRenderer, GroundTruthFollowsCameraAndMaterials) {
  FrameRenderer renderer(test::batchPack(), Backend::embree, "", 1);
  const auto truth = [&](const std::string& settings) {
    return renderer.render(test::readFrame(settings, renderer.scene())).truth;
  };
  const image::Image near = truth(R"({"outputs": ["truth"]})"),
                     far =
                         truth(R"({"outputs": ["truth"], "camera": {"position": [10, -1, 7], "target": [10, 0, -3]}})");
  const auto middle = [](const image::Image& image, const char* channel) {
    const auto pixel = static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2);
    return image.pixels[pixel * image.channels.size() + static_cast<std::size_t>(image.channel(channel))];
  };
  EXPECT_GT(middle(far, "Depth.Z"), middle(near, "Depth.Z") + 3);
  EXPECT_EQ(renderer.builds(), 0u);  // no image is rendered
}

TEST_F(Batch, WritesTheFilesOfEachFrame) {
  const Jobs two = jobs("{\"name\": \"a\"}\n{\"name\": \"b\", \"outputs\": [\"png\", \"truth\", \"camera\"]}\n");
  const BatchResult result = run(folder_, two, {}, FrameOutputs({"exr", "png", "dolp", "aolp", "truth", "camera"}, ""));
  EXPECT_EQ(result.rendered, 2u);
  EXPECT_EQ(result.builds, 1u);
  EXPECT_EQ(names(folder_), (std::set<std::string>{"a.aolp.exr", "a.dolp.exr", "a.exr", "a.json", "a.png",
                                                   "a.truth.exr", "b.json", "b.png", "b.truth.exr", "manifest.jsonl"}));
  const std::optional<Manifest> manifest = readManifest(folder_);
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->header.frames, 2u);
  EXPECT_EQ(manifest->header.pack, "0000000000001234");
  ASSERT_EQ(manifest->entries.size(), 2u);
  for (const auto& [key, entry] : manifest->entries)
    for (const ManifestFile& file : entry.files) {
      const ManifestFile found = describeFile(folder_, file.name);
      EXPECT_EQ(found.bytes, file.bytes);
      EXPECT_EQ(found.hash, file.hash);
    }
  EXPECT_EQ(manifest->entries.at({1, 0}).files.size(), 3u);
  const json camera = json::parse(bytes(folder_ / "b.json"));
  EXPECT_EQ(camera.at("camera").at("width"), 24);
}

TEST_F(Batch, ContinuesWhereItEnded) {
  const std::string text = "{\"repeat\": 6, \"polarizer\": {\"uniform\": [0, 180]}}";
  run(folder_, jobs(text));
  const std::string first = bytes(folder_ / "frame-000002.exr");
  // Of a killed process: a manifest whose last line has no end, and a file that is missing.
  const std::string manifest = bytes(folder_ / kManifestFile);
  std::ofstream(folder_ / kManifestFile, std::ios::binary) << manifest.substr(0, manifest.size() - 40);
  fs::remove(folder_ / "frame-000002.exr");
  BatchResult again = run(folder_, jobs(text));
  EXPECT_EQ(again.rendered, 2u);  // the missing file, and the frame of the last line
  EXPECT_EQ(again.reused, 4u);
  EXPECT_EQ(bytes(folder_ / "frame-000002.exr"), first);
  EXPECT_EQ(bytes(folder_ / kManifestFile), manifest);
  EXPECT_EQ(run(folder_, jobs(text)).rendered, 0u);
  // Another setting of one frame, another size of all.
  EXPECT_EQ(run(folder_, jobs("{\"repeat\": 6, \"polarizer\": {\"uniform\": [0, 180]}}\n{\"name\": \"new\"}")).rendered,
            1u);
  EXPECT_EQ(run(folder_, jobs("{\"repeat\": 6, \"width\": 12, \"polarizer\": {\"uniform\": [0, 180]}}")).rendered, 6u);
}

TEST_F(Batch, RefusesFoldersOfAnotherScene) {
  run(folder_, jobs("{}"));
  pack::Pack other = test::batchPack();
  other.hash = 5;
  FrameRenderer renderer(std::move(other), Backend::embree, "", 1);
  EXPECT_THROW(runBatch({folder_, test::batchDefaults(), 0, {}}, jobs("{}"), renderer), Error);
  std::ofstream(folder_ / kManifestFile) << "text\n";
  EXPECT_THROW(run(folder_, jobs("{}")), Error);
}

// Nothing is rendered if any job is wrong.
TEST_F(Batch, ReadsEveryJobFirst) {
  EXPECT_THROW(run(folder_, jobs("{}\n{}\n{\"widht\": 3}")), Error);
  EXPECT_FALSE(names(folder_).contains("frame-000000.exr"));
}

// Frames of another program or processor are rendered again.
TEST_F(Batch, FramesOfOtherProducersAreNotReused) {
  run(folder_, jobs("{}"));
  Manifest manifest = *readManifest(folder_);
  manifest.header.producer.processor = "avx9";
  writeManifest(folder_, manifest);
  EXPECT_EQ(run(folder_, jobs("{}")).rendered, 1u);
}

TEST_F(Batch, ShardsMergeToTheWhole) {
  const std::string text =
      "{\"repeat\": 7, \"polarizer\": {\"uniform\": [0, 180]}, \"materials\": {\"gold\": "
      "{\"roughness\": {\"uniform\": [0, 0.5]}}}}";
  run(sub("whole"), jobs(text));
  std::size_t rendered = 0;
  for (std::uint64_t k = 0; k < 3; ++k) rendered += run(sub("part" + std::to_string(k)), jobs(text), {k, 3}).rendered;
  EXPECT_EQ(rendered, 7u);
  const std::vector<fs::path> parts = {sub("part2"), sub("part0"), sub("part1")};
  EXPECT_EQ(mergeBatches(parts, sub("merged")), 7u);
  EXPECT_EQ(names(sub("merged")), names(sub("whole")));
  for (const std::string& name : names(sub("whole")))
    EXPECT_EQ(bytes(sub("merged") / name), bytes(sub("whole") / name)) << name;
  EXPECT_EQ(mergeBatches(parts, sub("merged")), 7u);  // again, over its files
  // A merged folder is a finished batch.
  EXPECT_EQ(run(sub("merged"), jobs(text)).rendered, 0u);
}

TEST_F(Batch, MergeRefusesWhatIsNotOneBatch) {
  const std::string text = "{\"repeat\": 4, \"polarizer\": {\"uniform\": [0, 180]}}";
  for (std::uint64_t k = 0; k < 2; ++k) run(sub("part" + std::to_string(k)), jobs(text), {k, 2});
  const std::vector<fs::path> parts = {sub("part0"), sub("part1")};
  const auto expectRefusal = [&](const std::vector<fs::path>& folders, const std::string& word) {
    try {
      mergeBatches(folders, sub("merged"));
      ADD_FAILURE() << word;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " / " << error.what();
    }
    EXPECT_TRUE(names(sub("merged")).empty()) << word;
  };
  expectRefusal({parts[0]}, "2 of 4");
  expectRefusal({parts[0], parts[1], parts[0]}, "is also in");
  expectRefusal({parts[0], sub("empty")}, "is missing");
  const Manifest manifest = *readManifest(parts[1]);
  const auto expectChanged = [&](const auto& change, const std::string& word) {
    Manifest changed = manifest;
    change(changed);
    writeManifest(parts[1], changed);
    expectRefusal(parts, word);
    writeManifest(parts[1], manifest);
  };
  expectChanged([](Manifest& m) { m.header.producer.processor = "avx9"; }, "processor");
  expectChanged([](Manifest& m) { m.header.producer.program = "malus 0"; }, "program");
  expectChanged([](Manifest& m) { m.header.pack = "5"; }, "pack");
  expectChanged([](Manifest& m) { m.header.seed = 5; }, "seed");
  expectChanged([](Manifest& m) { m.entries.begin()->second.settings["depth"] = 1; }, "hash");
  const fs::path file = parts[1] / "frame-000001.exr";
  const std::string whole = bytes(file);
  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << damaged;
  expectRefusal(parts, "frame-000001.exr");
  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_EQ(mergeBatches(parts, sub("merged")), 4u);
}

TEST(Shard, Texts) {
  EXPECT_EQ(parseShard("1/1")->count, 1u);
  EXPECT_EQ(parseShard("3/4")->number, 2u);
  for (const char* text : {"", "1", "0/2", "3/2", "1/0", "a/2", "1/2/3", "-1/2", "1/2 ", "1.0/2"})
    EXPECT_FALSE(parseShard(text)) << text;
}

}  // namespace
}  // namespace malus::render

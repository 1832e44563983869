// `malus bake`, `render` and `compare` on model files without scene.json.
#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

class ModelCommand : public testing::Test {
 protected:
  void SetUp() override {
    writeText(folder_ / "model.obj",
              "mtllib model.mtl\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nusemtl red\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    writeText(folder_ / "model.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    start_.environment = {{"XDG_CACHE_HOME", folder_ / "cache"}};
  }
  Finished run(std::vector<std::string> arguments) const { return malus(std::move(arguments), start_); }
  std::vector<std::string> packs() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache/malus/packs"))
      names.push_back(entry.path().filename());
    return names;
  }

  Folder folder_;
  Start start_;
};

TEST_F(ModelCommand, BakesAndWritesTheScene) {
  const Finished baked =
      run({"bake", folder_ / "model.obj", "-o", folder_ / "a.pack", "--write-scene", folder_ / "scene.json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.err;
  EXPECT_TRUE(contains(baked.out, "camera:", "studio", "depth:")) << baked.out;
  ASSERT_EQ(run({"bake", folder_ / "scene.json", "-o", folder_ / "b.pack"}).exitCode, 0);
  const Finished difference = run({"info", folder_ / "a.pack", "--diff", folder_ / "b.pack", "--json"});
  for (const json& section : json::parse(difference.out).at("sections")) EXPECT_EQ(section.at("id"), "PROV");
  const Finished again = run({"bake", folder_ / "model.obj", "-o", folder_ / "a.pack"});
  EXPECT_TRUE(contains(again.out, "up to date")) << again.out;

  // A scene that may have been edited is not overwritten.
  EXPECT_EQ(run({"bake", folder_ / "model.obj", "--write-scene", folder_ / "scene.json"}).exitCode, 1);
  EXPECT_EQ(run({"bake", folder_ / "model.obj", "--write-scene", folder_ / "new.json"}).exitCode, 0);
  EXPECT_EQ(readText(folder_ / "new.json"), readText(folder_ / "scene.json"));
}

TEST_F(ModelCommand, RendersFromTheCache) {
  const std::vector<std::string> render = {"render", folder_ / "model.obj", "-o", folder_ / "a.exr", "--width", "32"};
  const Finished first = run(render);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_TRUE(contains(first.err, "baked into", "cache/malus/packs/model-")) << first.err;
  const Finished second = run(render);
  EXPECT_TRUE(contains(second.err, "the pack is")) << second.err;
  EXPECT_EQ(packs().size(), 1u);

  // Another material file is another pack; the same contents elsewhere are not.
  writeText(folder_ / "model.mtl", "newmtl red\nKd 0.1 0.1 0.8\n");
  EXPECT_EQ(run(render).exitCode, 0);
  EXPECT_EQ(packs().size(), 2u);
  std::filesystem::create_directories(folder_ / "copy");
  for (const char* name : {"model.obj", "model.mtl"}) std::filesystem::copy(folder_ / name, folder_ / "copy");
  EXPECT_EQ(run({"render", folder_ / "copy/model.obj", "-o", folder_ / "a.exr", "--width", "32"}).exitCode, 0);
  EXPECT_EQ(packs().size(), 2u);
  EXPECT_EQ(run({"-q", "render", folder_ / "model.obj", "-o", folder_ / "a.exr", "--width", "32"}).err, "");
}

TEST_F(ModelCommand, ComparesAModel) {
  const Finished done = run({"compare", folder_ / "model.obj", "-o", folder_ / "report", "--methods", "fresnel",
                             "--backends", "embree", "--width", "32", "--rounds", "1", "--no-report"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  EXPECT_TRUE(contains(done.err, "baked into")) << done.err;
  EXPECT_TRUE(contains(readText(folder_ / "report/results.json"), "\"model\""));
}

TEST_F(ModelCommand, RefusesWrongOptions) {
  const std::string model = folder_ / "model.obj", pack = folder_ / "a.pack", image = folder_ / "a.png";
  ASSERT_EQ(run({"bake", model, "-o", pack, "--write-scene", folder_ / "scene.json"}).exitCode, 0);
  const auto expectError = [&](int exitCode, std::vector<std::string> arguments, const char* part) {
    const Finished done = run(std::move(arguments));
    EXPECT_EQ(done.exitCode, exitCode) << part;
    EXPECT_TRUE(contains(done.err, part)) << done.err;
    EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
  };
  expectError(2, {"bake", model}, "--output");
  expectError(2, {"bake", folder_ / "scene.json", "-o", pack, "--camera", "x"}, "--camera");
  expectError(2, {"bake", folder_ / "scene.json", "--write-scene", folder_ / "b.json"}, "--write-scene");
  expectError(2, {"bake", model, "--write-scene", model}, "--write-scene");
  expectError(2, {"bake", model, "-o", folder_ / "model.mtl"}, "--output");
  expectError(1, {"bake", model, "-o", pack, "--camera", "front"}, "'front'");
  expectError(1, {"bake", model, "-o", pack, "--environment", folder_ / "none.hdr"}, "none.hdr");
  expectError(2, {"render", pack, "-o", image, "--environment", image}, "--environment");
  expectError(2, {"render", pack, "-o", image, "--allow-open-glass"}, "--allow-open-glass");
  expectError(2, {"compare", pack, "-o", folder_ / "report", "--camera", "1"}, "--camera");
  expectError(1, {"render", folder_ / "none.glb", "-o", image}, "none.glb");
  expectError(2, {"render", model, "-o", folder_ / "model.mtl"}, "--output");
  EXPECT_FALSE(std::filesystem::exists(image));
}

}  // namespace
}  // namespace malus::test

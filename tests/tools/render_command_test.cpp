// `malus render` and `malus sweep`: numeric checks, choice of the method, effects.
#include <nlohmann/json.hpp>

#include "meshprep/base/image.h"
#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

TEST(Render, CheckNumerics) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  for (const char* backend : {"embree", "reference"}) {
    const Finished checked = malus({"render", folder / "tiny.pack", "-o", folder / "a.exr", "--backend", backend,
                                    "--method", "stokes", "--check-numerics"});
    EXPECT_EQ(checked.exitCode, 0) << checked.err;
    EXPECT_TRUE(contains(checked.out, "finite")) << checked.out;
  }
}

TEST(Render, GroundTruth) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", folder / "tiny.pack"});
    return malus(arguments);
  };
  const Finished both = render({"-o", folder / "a.exr", "--ground-truth", folder / "a.truth.exr", "--json"});
  ASSERT_EQ(both.exitCode, 0) << both.err;
  EXPECT_EQ(json::parse(both.out).at("outputs").size(), 2u);
  // Alone, it is the same file, and no image is rendered.
  const Finished alone = render({"--ground-truth", folder / "b.truth.exr", "--json", "--samples", "2"});
  ASSERT_EQ(alone.exitCode, 0) << alone.err;
  EXPECT_EQ(json::parse(alone.out).at("width"), 64);
  EXPECT_FALSE(json::parse(alone.out).contains("traceMs"));
  EXPECT_EQ(readText(folder / "a.truth.exr"), readText(folder / "b.truth.exr"));
  for (const char* layer : {"Depth.Z", "Distance.Z", "Position.X", "Normal.X", "NormalGeometricCamera.Z", "IndexMA.X",
                            "IndexOB.X", "Incidence.V", "Interactions.V", "Valid.V", "gold"})
    EXPECT_TRUE(contains(readText(folder / "a.truth.exr"), layer)) << layer;
  // Compression that loses digits is for images.
  ASSERT_EQ(render({"--ground-truth", folder / "d.truth.exr", "--compression", "dwaa"}).exitCode, 0);
  EXPECT_EQ(readText(folder / "a.truth.exr"), readText(folder / "d.truth.exr"));
  EXPECT_EQ(render({"--ground-truth", folder / "a.png"}).exitCode, 2);
  EXPECT_EQ(render({"--ground-truth", folder / "tiny.pack"}).exitCode, 2);
  EXPECT_EQ(render({"-o", folder / "c.exr", "--ground-truth", folder / "c.exr"}).exitCode, 2);
}

TEST(Render, CompressionOfExrFiles) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto render = [&](const std::string& compression) {
    return malus({"render", folder / "tiny.pack", "-o", folder / (compression + ".exr"), "--method", "stokes",
                  "--width", "128", "--compression", compression});
  };
  for (const char* compression : {"zip", "dwaa", "none"}) EXPECT_EQ(render(compression).exitCode, 0) << compression;
  const auto size = [&](const char* name) { return std::filesystem::file_size(folder / name); };
  EXPECT_LT(size("dwaa.exr"), size("zip.exr"));
  EXPECT_LT(size("zip.exr"), size("none.exr"));
  EXPECT_EQ(malus({"compare-images", folder / "zip.exr", folder / "none.exr", "--fail-over", "0"}).exitCode, 0);
  EXPECT_EQ(malus({"compare-images", folder / "zip.exr", folder / "dwaa.exr", "--fail-over", "0"}).exitCode, 3);
  EXPECT_EQ(malus({"compare-images", folder / "zip.exr", folder / "dwaa.exr", "--fail-over", "0.05"}).exitCode, 0);
  EXPECT_EQ(render("gif").exitCode, 2);
}

TEST(Render, AlphaIsAChannelOfExrFilesOnly) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto render = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", folder / "tiny.pack", "-o", folder / (name + ".exr"), "-o",
                               folder / (name + ".png"), "--method", "stokes", "--width", "64"});
    const Finished done = malus(more);
    EXPECT_EQ(done.exitCode, 0) << done.err;
    return image::read(folder / (name + ".exr"));
  };
  const image::Image with = render("with", {"--alpha"}), without = render("without", {});
  EXPECT_EQ(with.channels.size(), 16u);
  EXPECT_EQ(without.channels.size(), 15u);
  EXPECT_LT(without.channel("A"), 0);
  ASSERT_GE(with.channel("A"), 0);
  EXPECT_EQ(render("intensity", {"--alpha", "--intensity"}).channels.size(), 4u);
  EXPECT_EQ(readText(folder / "with.png"), readText(folder / "without.png"));
  EXPECT_EQ(malus({"compare-images", folder / "with.exr", folder / "without.exr", "--fail-over", "0"}).exitCode, 0);
  const Finished refused = malus({"render", folder / "tiny.pack", "-o", folder / "a.png", "--alpha"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_TRUE(contains(refused.err, "--alpha", ".exr")) << refused.err;
}

TEST(Render, VulkanPath) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto render = [&](const char* limits, const char* method, const char* path) {
    Start start;
    start.environment = {{"MALUS_DEVICE", "llvmpipe"}, {"MALUS_VULKAN_LIMITS", limits}};
    start.timeoutSeconds = 600;
    return malus({"render", folder / "tiny.pack", "-o", folder / "a.exr", "--backend", "vulkan", "--width", "16",
                  "--method", method, "--vulkan-path", path, "--json"},
                 start);
  };
  const auto taken = [](const Finished& done) {
    EXPECT_EQ(done.exitCode, 0) << done.err;
    return json::parse(done.out).at("vulkanPath");
  };
  EXPECT_EQ(taken(render("", "fresnel-iterative", "auto")), "query");
  EXPECT_EQ(taken(render("", "fresnel-iterative", "pipeline")), "pipeline");
  EXPECT_EQ(taken(render("rayQuery=0", "fresnel-iterative", "auto")), "pipeline");
  expectRefusal(render("rayQuery=0", "fresnel-iterative", "query"), "--vulkan-path", "rayQuery", "pipeline");
  EXPECT_EQ(render("", "fresnel", "magic").exitCode, 2);
  // A recursive method that cannot recurse reports it.
  const Finished limited = render("maxRayRecursionDepth=1", "fresnel", "pipeline");
  EXPECT_EQ(taken(limited), "pipeline");
  EXPECT_TRUE(contains(limited.out, "nested rays")) << limited.out;
  EXPECT_TRUE(json::parse(render("", "fresnel", "auto").out).at("withoutRecursion").is_null());
}

TEST(Render, SweepsAgreeBetweenMethods) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto sweep = [&](const char* method) {
    const Finished done = malus({"sweep", folder / "tiny.pack", "-o", folder / method, "--backend", "embree",
                                 "--method", method, "--frames", "2"});
    EXPECT_EQ(done.exitCode, 0) << done.err;
    return std::string(folder / method) + "/frame-001.png";
  };
  const Finished compared = malus({"compare-images", sweep("stokes"), sweep("importance"), "--fail-over", "0.005"});
  EXPECT_EQ(compared.exitCode, 0) << compared.out;
}

TEST(Render, MaxErrorKeepsStokesOutput) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const Finished stokes = malus(
      {"render", folder / "tiny.pack", "--backend", "embree", "--max-error", "10", "--stokes", "-o", folder / "a.exr"});
  EXPECT_EQ(stokes.exitCode, 0) << stokes.err;
  EXPECT_TRUE(contains(stokes.out, "stokes") || contains(stokes.out, "importance")) << stokes.out;
  EXPECT_EQ(malus({"render", folder / "tiny.pack", "--backend", "embree", "--max-error", "10", "--tolerance", "0.1",
                   "-o", folder / "a.exr"})
                .exitCode,
            2);
}

TEST(Render, Effects) {
  const Folder folder;
  writeTinyScene(folder.path());
  ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", folder / "tiny.pack", "--backend", "embree", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return malus(arguments);
  };
  // At depth 0 nothing is reflected: fresnel gives the intensity of stokes, and its use is reported.
  const Finished cheaper = render({"-o", folder / "a.png", "--method", "stokes", "--depth", "0"});
  ASSERT_EQ(cheaper.exitCode, 0) << cheaper.err;
  const json document = json::parse(cheaper.out);
  EXPECT_EQ(document.at("method"), "fresnel");
  EXPECT_TRUE(contains(document.at("substitutedFor").get<std::string>(), "stokes")) << cheaper.out;
  // An EXR file contains Stokes vectors unless --intensity is given.
  EXPECT_EQ(json::parse(render({"-o", folder / "a.exr", "--method", "stokes", "--depth", "0"}).out).at("method"),
            "stokes-linear");
  EXPECT_EQ(json::parse(render({"-o", folder / "b.exr", "--method", "stokes", "--depth", "0", "--intensity"}).out)
                .at("method"),
            "fresnel");
  EXPECT_TRUE(json::parse(render({"-o", folder / "a.png", "--method", "stokes", "--effects", "all"}).out)
                  .at("substitutedFor")
                  .is_null());
  // Effects that are removed although the scene has them: rendered with a warning.
  const Finished less =
      render({"-o", folder / "a.png", "--method", "stokes", "--effects", "diffuse,dielectric,conductor"});
  ASSERT_EQ(less.exitCode, 0) << less.err;
  EXPECT_TRUE(contains(less.err, "linear-polarization")) << less.err;
  EXPECT_TRUE(contains(less.err, "point-lights")) << less.err;
  // An earlier name of an effect is replaced; the note appears with -v only.
  EXPECT_FALSE(contains(less.err, "conductor")) << less.err;
  const Finished noted = render({"-o", folder / "a.png", "--effects", "diffuse,dielectric,conductor", "-v"});
  EXPECT_TRUE(contains(noted.err, "'conductor'", "deprecated", "'metal'")) << noted.err;
  EXPECT_EQ(json::parse(noted.out).at("effects"), "diffuse,dielectric,metal");
  expectRefusal(render({"-o", folder / "c.png", "--effects", "magic"}), "linear-polarization");
  EXPECT_EQ(
      render({"-o", folder / "c.exr", "--method", "stokes", "--intensity", "--output-dolp", folder / "d.png"}).exitCode,
      2);
}

}  // namespace
}  // namespace malus::test

// `malus render --sensor`: its files, that they do not depend on threads, and its errors.
#include <nlohmann/json.hpp>

#include "meshprep/base/image.h"
#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

class SensorCommand : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder_.path());
    ASSERT_EQ(malus({"bake", folder_ / "scene.json", "-o", folder_ / "tiny.pack"}).exitCode, 0);
  }
  // Renders 32 x 24 pixels with Stokes vectors unless the arguments have other values.
  Finished render(std::vector<std::string> arguments) {
    for (const auto& [option, value] : {std::pair{"--method", "stokes"}, {"--width", "32"}, {"--height", "24"}})
      if (std::find(arguments.begin(), arguments.end(), option) == arguments.end())
        arguments.insert(arguments.end(), {option, value});
    arguments.insert(arguments.begin(), {"render", folder_ / "tiny.pack"});
    return malus(arguments);
  }
  void expectUsage(const std::vector<std::string>& arguments, const char* word) {
    const Finished done = render(arguments);
    EXPECT_EQ(done.exitCode, 2) << done.err;
    EXPECT_TRUE(contains(done.err, word)) << done.err;
    EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
  }
  Folder folder_;
};

TEST_F(SensorCommand, WritesRawMaskStokesAndDescription) {
  for (const char* preset : {"imx250mzr", "imx250myr"}) {
    const Finished done =
        render({"--sensor", preset, "--sensor-raw", folder_ / "raw.png", "--sensor-mask", folder_ / "mask.png",
                "--sensor-stokes", folder_ / "stokes.exr", "--sensor-seed", "5", "--exposure", "-2", "--json"});
    ASSERT_EQ(done.exitCode, 0) << done.err;
    EXPECT_EQ(json::parse(done.out).at("outputs"),
              json({folder_ / "raw.png", folder_ / "raw.json", folder_ / "mask.png", folder_ / "stokes.exr"}));
    const json description = json::parse(readText(folder_ / "raw.json"));
    EXPECT_EQ(description.at("seed"), 5);
    EXPECT_EQ(description.at("bits"), 12);
    EXPECT_EQ(description.at("width"), 32);
    EXPECT_EQ(description.at("electronsPerRadiance"), 2750);
    EXPECT_EQ(description.at("polarizerDegrees"), json({{90, 45}, {135, 0}}));
    EXPECT_EQ(description.at("image").at("method"), "stokes");
    const bool isMono = std::string(preset) == "imx250mzr";
    EXPECT_EQ(description.at("channels").size(), isMono ? 1u : 3u);
    EXPECT_EQ(description.at("channelPattern").at(0), isMono ? json({"Y", "Y"}) : json({"R", "R", "G", "G"}));
    EXPECT_EQ(image::read(folder_ / "raw.png").width, 32);
    EXPECT_EQ(image::read(folder_ / "stokes.exr").channel(isMono ? "S1.Y" : "S1.G") >= 0, true);
  }
}

TEST_F(SensorCommand, NoiseDoesNotDependOnThreadsAndRegions) {
  const auto write = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"--sensor", "imx250myr", "--sensor-raw", folder_ / name});
    const Finished done = render(more);
    EXPECT_EQ(done.exitCode, 0) << done.err;
    return readText(folder_ / name);
  };
  const std::string one = write("one.png", {"--threads", "1"});
  EXPECT_EQ(one, write("two.png", {"--threads", "2"}));
  EXPECT_NE(one, write("seed.png", {"--sensor-seed", "1"}));
  EXPECT_NE(one, write("frame.png", {"--sensor-frame", "1"}));
  write("one.exr", {});
  write("region.exr", {"--region", "8", "4", "16", "12"});
  const image::Image whole = image::read(folder_ / "one.exr"), region = image::read(folder_ / "region.exr");
  ASSERT_EQ(region.width, 16);
  for (std::size_t y = 0; y < 12; ++y)
    for (std::size_t x = 0; x < 16; ++x) EXPECT_EQ(region.pixels[16 * y + x], whole.pixels[32 * (y + 4) + x + 8]);
}

TEST_F(SensorCommand, RefusesWrongOptions) {
  const std::string raw = folder_ / "raw.png";
  expectUsage({"--sensor", "imx250mzz", "--sensor-raw", raw}, "nearest is 'imx250mzr'");
  expectUsage({"--sensor", "imx250mzr"}, "--sensor-raw");
  expectUsage({"--sensor-raw", raw, "-o", folder_ / "a.exr"}, "--sensor");
  expectUsage({"--sensor-seed", "1", "-o", folder_ / "a.exr"}, "--sensor");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", folder_ / "raw.jpg"}, ".png");
  expectUsage({"--sensor", "imx250mzr", "--sensor-mask", folder_ / "mask.exr"}, ".png");
  expectUsage({"--sensor", "imx250mzr", "--sensor-stokes", folder_ / "stokes.png"}, ".exr");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--sensor-seed", "-1"}, "--sensor-seed");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--polarizer", "0"}, "every pixel");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--intensity"}, "--sensor");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--method", "fresnel"}, "Stokes");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--width", "31"}, "multiples of 2");
  expectUsage({"--sensor", "imx250myr", "--sensor-raw", raw, "--width", "30"}, "multiples of 4");
  expectUsage({"--sensor", "imx250myr", "--sensor-raw", raw, "--region", "2", "0", "16", "16"}, "--region");
  expectUsage({"--sensor", "imx250mzr", "--sensor-raw", raw, "--sensor-mask", raw}, "--sensor-mask");
  // The description is an output, the sensor file an input.
  writeText(folder_ / "raw.json", R"({"malus": 1, "preset": "imx250mzr"})");
  expectUsage({"--sensor", folder_ / "raw.json", "--sensor-raw", raw}, "--sensor-raw");
  EXPECT_FALSE(std::filesystem::exists(raw));
}

TEST_F(SensorCommand, RefusesWrongFiles) {
  for (const char* text : {R"({"malus": 1, "preset": "imx250mzr", "redNoise": 1})", R"({"malus": 1})", "[]", "{",
                           R"({"malus": 1, "preset": "imx250mzr", "bits": 11})"}) {
    writeText(folder_ / "sensor.json", text);
    expectRefusal(render({"--sensor", folder_ / "sensor.json", "--sensor-raw", folder_ / "raw.png"}), "sensor.json");
  }
  expectRefusal(render({"--sensor", folder_ / "missing.json", "--sensor-raw", folder_ / "raw.png"}), "missing.json");
}

}  // namespace
}  // namespace malus::test

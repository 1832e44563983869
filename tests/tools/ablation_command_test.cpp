// `malus compare --effects`: rows, agreement with a comparison of methods, wrong arguments.
#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

class Ablation : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder_.path());
    ASSERT_EQ(malus({"bake", folder_ / "scene.json", "-o", pack()}).exitCode, 0);
  }
  std::string pack() const { return folder_ / "tiny.pack"; }
  std::string report() const { return folder_ / "report"; }
  Finished compare(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"compare", pack(), "-o", report(), "--width", "64", "--backends", "embree"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return malus(arguments);
  }
  json results() const { return json::parse(readText(report() + "/results.json")); }

  Folder folder_;
};

TEST_F(Ablation, MeasuresEachEffectAndBounce) {
  const Finished finished = compare({"--effects", "--rounds", "2", "--no-report"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  EXPECT_EQ(document.at("settings").at("rounds"), 2);
  const json& rows = document.at("ablation");
  ASSERT_GT(rows.size(), 2u);
  EXPECT_EQ(rows.at(0).at("kind"), "complete");
  double energy = 1 + 1e-6;
  std::size_t bounces = 0;
  for (const json& row : rows) {
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("samplesMs").size(), 2u);
    const std::string image = row.at("image");
    EXPECT_TRUE(std::filesystem::exists(report() + "/" + image));
    EXPECT_FALSE(contains(image, "%")) << image;
    if (row.at("kind") != "depth") continue;
    // Light is not negative: fewer bounces have less energy.
    EXPECT_LE(row.at("error").at("energyRatio"), energy) << row.at("name");
    energy = row.at("error").at("energyRatio");
    ++bounces;
  }
  EXPECT_GT(bounces, 0u);
  EXPECT_EQ(document.at("bounces").size(), bounces);
  EXPECT_TRUE(contains(finished.out, "bounces from")) << finished.out;
  const Finished shown = malus({"compare", "--show", report() + "/results.json"});
  EXPECT_EQ(shown.exitCode, 1);
  EXPECT_TRUE(contains(shown.err, "results of malus compare --effects; expected those of a comparison of methods"))
      << shown.err;
}

TEST_F(Ablation, PolarizationHasTheErrorOfTheMethodWithoutIt) {
  const std::string wall = folder_ / "wall.pack";
  ASSERT_EQ(malus({"bake", std::string(MALUS_SOURCE_DIR) + "/scenes/glass-wall/scene.json", "-o", wall}).exitCode, 0);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"compare",  wall, "-o",          report(),     "--width", "48",
                                          "--rounds", "1",  "--no-report", "--backends", "embree"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return malus(arguments).exitCode;
  };
  ASSERT_EQ(run({"--effects"}), 0);
  double without = -1;
  const json ablation = results();
  for (const json& row : ablation.at("ablation"))
    if (row.at("name") == "linear-polarization") without = row.at("error").at("relRms");
  ASSERT_GT(without, 0);
  ASSERT_EQ(run({"--methods", "fresnel,stokes"}), 0);
  const json methods = results();
  for (const json& row : methods.at("rows")) {
    if (row.at("method") == "fresnel") {
      EXPECT_EQ(row.at("error").at("relRms"), without);
    }
  }
}

TEST_F(Ablation, HasAPage) {
  const Finished finished = compare({"--effects", "--rounds", "1"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const std::string page = readText(report() + "/index.html");
  EXPECT_TRUE(contains(page, "<svg"));
  EXPECT_TRUE(contains(page, "bounces from"));
  EXPECT_FALSE(contains(page, "src=\"images/")) << "the page is self-contained";
}

TEST_F(Ablation, OneSizeOnly) {
  const Finished finished = malus({"compare", pack(), "-o", report(), "--effects", "--width", "32,64"});
  EXPECT_EQ(finished.exitCode, 2) << finished.err;
  EXPECT_TRUE(contains(finished.err, "--width")) << finished.err;
}

// lavapipe may compile the first image for longer than the time limit: everything else is measured before.
TEST_F(Ablation, VulkanOnACpuComesLast) {
  json scene = json::parse(readText(folder_ / "scene.json"));
  scene["name"] = "other";
  writeText(folder_ / "other.json", scene.dump());
  ASSERT_EQ(malus({"bake", folder_ / "other.json", "-o", folder_ / "other.pack"}).exitCode, 0);
  const Finished finished = malus({"compare", pack(), folder_ / "other.pack", "-o", report(), "--effects", "--width",
                                   "16", "--minutes", "0.00001", "--no-report", "--depth", "0"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  ASSERT_EQ(document.at("ablation").size(), 1u) << "the first image is always rendered";
  EXPECT_EQ(document.at("ablation").at(0).at("renderer"), "embree");

  ASSERT_EQ(malus({"compare", pack(), folder_ / "other.pack", "-o", report(), "--effects", "--width", "16", "--rounds",
                   "1", "--no-report", "--depth", "0"})
                .exitCode,
            0);
  const json whole = results();
  std::vector<std::string> images;
  for (const json& row : whole.at("ablation")) {
    EXPECT_EQ(row.at("samplesMs").size(), 1u);
    if (row.at("kind") == "complete")
      images.push_back(row.at("renderer").get<std::string>() + " " + row.at("scene").get<std::string>());
  }
  EXPECT_EQ(images, (std::vector<std::string>{"embree other", "embree tiny", "vulkan other", "vulkan tiny"}));
}

// An option that has no effect is refused.
TEST_F(Ablation, RefusesTheOptionsOfOtherComparisons) {
  for (const auto& [option, value] :
       {std::pair("--methods", "schlick"), {"--scale", "0.5"}, {"--gpu-model", "navi21"}}) {
    const Finished finished = malus({"compare", pack(), "-o", report(), "--effects", option, value});
    EXPECT_EQ(finished.exitCode, 2) << finished.err;
    EXPECT_TRUE(contains(finished.err, "--effects", option)) << finished.err;
  }
}

}  // namespace
}  // namespace malus::test

// `malus bench rays`: what it prints, and the rays that it writes against a program that only traces them. Times are
// printed for both and not judged.
#include <algorithm>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

class Bench : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder_.path());
    ASSERT_EQ(malus({"bake", folder_ / "scene.json", "-o", folder_ / "tiny.pack"}).exitCode, 0);
  }
  Folder folder_;
};

TEST_F(Bench, PrintsFloorAndRatio) {
  const Finished done = malus({"bench", "rays", folder_ / "tiny.pack", "--methods", "schlick,stokes,importance",
                               "--width", "32", "--threads", "1", "--rounds", "2", "--json"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  const json bench = json::parse(done.out);
  EXPECT_EQ(bench.at("width"), 32);
  EXPECT_EQ(bench.at("rounds"), 2);
  double floorMs = 0;
  std::size_t rays = 0;
  for (const json& c : bench.at("classes")) {
    floorMs += c.at("ms").get<double>();
    rays += c.at("rays").get<std::size_t>();
    double least = c.at("calls").at("1");
    for (const auto& [name, ms] : c.at("calls").items()) least = std::min(least, ms.get<double>());
    EXPECT_EQ(c.at("ms"), least);
    EXPECT_EQ(c.at("calls").at(c.at("bestCall")), least);
    EXPECT_EQ(c.at("calls").at("1"), c.at("singleMs"));
    EXPECT_TRUE(c.at("calls").contains("1, sorted"));
  }
  EXPECT_EQ(bench.at("classes").front().at("rays"), 32 * 24);
  EXPECT_NEAR(bench.at("floorMs").get<double>(), floorMs, 1e-9);
  const json& rows = bench.at("rows");
  EXPECT_GE(rows.size(), 3u);
  EXPECT_EQ(rows.front().at("rays"), rays);
  for (const json& row : rows) {
    EXPECT_GT(row.at("ratio").get<double>(), 0);
    EXPECT_NEAR(row.at("ratio").get<double>() * row.at("floorMs").get<double>(), row.at("totalMs").get<double>(), 1e-9);
  }
  const Finished text = malus({"bench", "rays", folder_ / "tiny.pack", "--methods", "schlick", "--rounds", "1"});
  EXPECT_TRUE(contains(text.out, "floor", "fastest call", "schlick", "ratio", "shadow")) << text.out;
}

TEST_F(Bench, AnotherProgramFindsTheSameHits) {
  const Finished done = malus({"bench", "rays", folder_ / "tiny.pack", "--methods", "fresnel", "--threads", "1",
                               "--rounds", "5", "--json", "--write-rays", folder_ / "rays"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  const Finished floor = run({RAY_FLOOR, folder_ / "tiny.pack", folder_ / "rays"});
  ASSERT_EQ(floor.exitCode, 0) << floor.err;
  const json expected = json::parse(floor.out).at("classes");
  const json classes = json::parse(done.out).at("classes");
  ASSERT_EQ(classes.size(), expected.size());
  double single = 0, expectedSingle = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    for (const char* key : {"depth", "shadow", "rays", "hits"})
      EXPECT_EQ(classes[i].at(key), expected[i].at(key)) << key << " of class " << i;
    EXPECT_EQ(expected[i].at("packetHits"), expected[i].at("hits"));
    single += classes[i].at("singleMs").get<double>();
    expectedSingle += expected[i].at("singleMs").get<double>();
  }
  std::printf("single rays: bench %.3f ms, ray_floor %.3f ms\n", single, expectedSingle);
}

TEST_F(Bench, TracesTheSameRaysByVulkan) {
  const Finished done = malus({"bench", "rays", folder_ / "tiny.pack", "--methods", "fresnel,importance", "--backends",
                               "embree,vulkan", "--device", "llvmpipe", "--width", "32", "--rounds", "2", "--json"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  const json bench = json::parse(done.out);
  const json& floor = bench.at("vulkan").at("floors").front();
  EXPECT_TRUE(contains(bench.at("vulkan").at("device").get<std::string>(), "llvmpipe"));
  ASSERT_EQ(floor.at("classes").size(), bench.at("classes").size());
  double sum = 0;
  for (std::size_t i = 0; i < floor.at("classes").size(); ++i) {
    const json &found = floor.at("classes")[i], &expected = bench.at("classes")[i];
    for (const char* key : {"depth", "shadow", "rays"}) EXPECT_EQ(found.at(key), expected.at(key)) << key;
    EXPECT_NEAR(found.at("hits").get<double>(), expected.at("hits").get<double>(), 2);  // edges
    EXPECT_EQ(found.at("calls").size(), 2u);
    EXPECT_EQ(found.at("ms"), std::min(found.at("calls").at("query"), found.at("calls").at("pipeline")));
    sum += found.at("ms").get<double>();
  }
  EXPECT_NEAR(floor.at("floorMs").get<double>(), sum, 1e-9);
  std::set<std::string> rows;
  for (const json& row : bench.at("rows")) {
    rows.insert(row.at("backend").get<std::string>() + " " + row.at("path").get<std::string>());
    EXPECT_GT(row.at("ratio").get<double>(), 0);
  }
  for (const char* row : {"embree scalar", "vulkan pipeline", "vulkan query"}) EXPECT_TRUE(rows.contains(row)) << row;
  const Finished alone = malus({"bench", "rays", folder_ / "tiny.pack", "--methods", "fresnel", "--backends", "vulkan",
                                "--device", "llvmpipe", "--width", "8", "--rounds", "1", "--json"});
  const json vulkanOnly = json::parse(alone.out);
  EXPECT_FALSE(vulkanOnly.contains("floorMs"));
  for (const json& row : vulkanOnly.at("rows")) EXPECT_EQ(row.at("backend"), "vulkan");
}

TEST_F(Bench, RefusesBadInput) {
  EXPECT_EQ(malus({"bench"}).exitCode, 2);
  const Finished unknown = malus({"bench", "ray", folder_ / "tiny.pack"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_TRUE(contains(unknown.err, "'ray'", "'rays'")) << unknown.err;
  const Finished option = malus({"bench", "rays", folder_ / "tiny.pack", "--round", "3"});
  EXPECT_EQ(option.exitCode, 2);
  EXPECT_TRUE(contains(option.err, "'--round'", "'--rounds'")) << option.err;
  EXPECT_EQ(malus({"bench", "rays", folder_ / "tiny.pack", "--rounds", "0"}).exitCode, 2);
  EXPECT_EQ(malus({"bench", "rays", folder_ / "tiny.pack", "--backends", "reference"}).exitCode, 2);
  EXPECT_EQ(malus({"bench", "rays", folder_ / "tiny.pack", "--write-rays", folder_ / "tiny.pack"}).exitCode, 2);
  expectRefusal(malus({"bench", "rays", folder_ / "none.pack"}), "none.pack");
}

}  // namespace
}  // namespace malus::test

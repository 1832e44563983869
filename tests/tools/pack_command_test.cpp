// Packs as files: differences, reuse of unchanged parts, and atomic writing by several or killed processes.
#include <csignal>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

// Two scenes that share a folder and its meshes and differ in the exposure.
struct TwoScenes {
  Folder folder;
  std::string first, second, firstHash, secondHash;
  double seconds = 0;  // the longer of the two bakes

  TwoScenes() {
    writeTinyScene(folder.path());
    first = folder / "scene.json";
    json scene = json::parse(readText(first));
    scene["exposureEv"] = 2;
    second = folder / "second.json";
    writeText(second, scene.dump());
    firstHash = bakeAndHash(first);
    secondHash = bakeAndHash(second);
  }
  std::string bakeAndHash(const std::string& scene) {
    const std::string pack = folder / "alone.pack";
    const Finished baked = malus({"bake", scene, "-o", pack});
    EXPECT_EQ(baked.exitCode, 0) << baked.err;
    seconds = std::max(seconds, baked.seconds);
    return packHash(pack);
  }
  // Returns the hash of a pack whose section hashes are all correct, otherwise "" and a test failure.
  static std::string packHash(const std::string& pack) {
    const Finished info = malus({"info", pack, "--verify", "--json"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    return info.exitCode == 0 ? json::parse(info.out).at("hash").get<std::string>() : "";
  }
};

TEST(Packs, DiffReportsChanges) {
  TwoScenes scenes;
  const std::string a = scenes.folder / "a.pack", b = scenes.folder / "b.pack";
  ASSERT_EQ(malus({"bake", scenes.first, "-o", a}).exitCode, 0);
  ASSERT_EQ(malus({"bake", scenes.second, "-o", b}).exitCode, 0);
  const Finished same = malus({"info", a, "--diff", a});
  EXPECT_EQ(same.exitCode, 0);
  EXPECT_TRUE(contains(same.out, "equal")) << same.out;
  const Finished other = malus({"info", a, "--diff", b});
  EXPECT_EQ(other.exitCode, 3);
  EXPECT_EQ(other.err, "");
  for (const char* part : {"exposureEv", "0.0", "2.0", "META"}) EXPECT_TRUE(contains(other.out, part)) << other.out;
  const Finished text = malus({"info", a, "--diff", b, "--json"});
  EXPECT_EQ(text.exitCode, 3);
  EXPECT_FALSE(json::parse(text.out).at("equal"));
  EXPECT_EQ(malus({"info", a, "--diff", scenes.folder / "none.pack"}).exitCode, 1);
}

TEST(Packs, AreRebuiltOnlyAfterAChange) {
  TwoScenes scenes;
  const std::string pack = scenes.folder / "out.pack";
  const auto upToDate = [&](std::vector<std::string> options = {}) {
    std::vector<std::string> command = {"bake", scenes.first, "-o", pack, "--json"};
    command.insert(command.end(), options.begin(), options.end());
    const Finished baked = malus(command);
    EXPECT_EQ(baked.exitCode, 0) << baked.err;
    return json::parse(baked.out).at("upToDate").get<bool>();
  };
  EXPECT_FALSE(upToDate());
  const std::string bytes = readText(pack);
  EXPECT_TRUE(upToDate());
  EXPECT_FALSE(upToDate({"--force"}));
  EXPECT_EQ(readText(pack), bytes);
  EXPECT_FALSE(upToDate({"--normal-bits", "10"}));  // other settings
  EXPECT_FALSE(upToDate());
  // Only contents count, not the time of modification.
  const std::string floor = scenes.folder / "floor.obj", text = readText(floor);
  writeText(floor, text);
  EXPECT_TRUE(upToDate());
  writeText(floor, "# a comment\n" + text);
  EXPECT_FALSE(upToDate());
  EXPECT_TRUE(upToDate());
  // A damaged pack is not reused.
  std::string damaged = readText(pack);
  damaged[damaged.size() / 2] ^= 1;
  writeText(pack, damaged);
  EXPECT_FALSE(upToDate());
  // A missing source is an error although the pack exists.
  std::filesystem::remove(floor);
  expectRefusal(malus({"bake", scenes.first, "-o", pack}), "floor.obj");
}

TEST(Packs, ReuseUnchangedMeshes) {
  TwoScenes scenes;
  const std::string pack = scenes.folder / "out.pack";
  ASSERT_EQ(malus({"bake", scenes.first, "-o", pack}).exitCode, 0);
  const Finished text = malus({"bake", scenes.second, "-o", pack});  // another exposure, the same meshes
  EXPECT_TRUE(contains(text.out, " 0 of ")) << text.out;
  const Finished again = malus({"bake", scenes.first, "-o", pack, "--json"});
  EXPECT_EQ(json::parse(again.out).at("reencoded"), 0);
  const Finished forced = malus({"bake", scenes.first, "-o", pack, "--json", "--force"});
  const json report = json::parse(forced.out);
  EXPECT_EQ(report.at("reencoded"), report.at("meshes").size());
  EXPECT_EQ(TwoScenes::packHash(pack), scenes.firstHash);
}

// A bake that is killed at any moment leaves the old pack or the complete new one.
TEST(Packs, SurviveBeingKilled) {
  TwoScenes scenes;
  const std::string pack = scenes.folder / "out.pack";
  ASSERT_EQ(malus({"bake", scenes.first, "-o", pack}).exitCode, 0);
  std::mt19937 random(5);
  std::size_t killed = 0;
  for (int i = 0; i < 100; ++i) {
    const double moment = scenes.seconds * (0.1 + static_cast<double>(random() % 1000) / 1000);
    const Finished baked = run({"timeout", "-s", "KILL", std::to_string(moment), MALUS_BINARY, "bake",
                                i % 2 == 0 ? scenes.second : scenes.first, "-o", pack});
    if (baked.exitCode != 0) ++killed;
    const std::string hash = TwoScenes::packHash(pack);
    ASSERT_TRUE(hash == scenes.firstHash || hash == scenes.secondHash) << i << ": " << hash;
  }
  EXPECT_GT(killed, 20u);
  // The next bake removes the temporary files of killed ones.
  EXPECT_EQ(malus({"bake", scenes.first, "-o", pack, "--force"}).exitCode, 0);
  for (const std::string& name : scenes.folder.names()) EXPECT_FALSE(contains(name, ".part")) << name;
  EXPECT_EQ(TwoScenes::packHash(pack), scenes.firstHash);
}

TEST(Packs, ConcurrentBakesDoNotMix) {
  TwoScenes scenes;
  const std::string pack = scenes.folder / "out.pack";
  for (int i = 0; i < 8; ++i) {
    Finished ends[2];
    std::thread one([&] { ends[0] = malus({"bake", scenes.first, "-o", pack}); });
    ends[1] = malus({"bake", scenes.second, "-o", pack});
    one.join();
    for (const Finished& end : ends) EXPECT_EQ(end.exitCode, 0) << end.err;
    const std::string hash = TwoScenes::packHash(pack);
    EXPECT_TRUE(hash == scenes.firstHash || hash == scenes.secondHash);
    // Only the pack remains.
    for (const std::string& name : scenes.folder.names()) EXPECT_FALSE(contains(name, ".part")) << name;
  }
}

}  // namespace
}  // namespace malus::test

// Packs as files: what is different between two, and that they are whole whatever happens to who writes them.
#include <csignal>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

// Two scenes of one folder's meshes, so that one output can be either.
struct TwoScenes {
  Folder folder;
  std::string first, second, firstHash, secondHash;
  double seconds = 0;  // of a bake

  TwoScenes() {
    writeTinyScene(folder.path());
    first = folder / "scene.json";
    json scene = json::parse(textOf(first));
    scene["exposureEv"] = 2;
    second = folder / "second.json";
    writeText(second, scene.dump());
    firstHash = hashOf(first);
    secondHash = hashOf(second);
  }
  std::string hashOf(const std::string& scene) {
    const std::string pack = folder / "alone.pack";
    const Finished baked = malus({"bake", scene, "-o", pack});
    EXPECT_EQ(baked.exitCode, 0) << baked.err;
    seconds = std::max(seconds, baked.seconds);
    return packHash(pack);
  }
  // Of a pack whose every hash holds; "" and a failure where it does not.
  static std::string packHash(const std::string& pack) {
    const Finished info = malus({"info", pack, "--verify", "--json"});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    return info.exitCode == 0 ? json::parse(info.out).at("hash").get<std::string>() : "";
  }
};

TEST(Packs, DiffTellsWhatChanged) {
  TwoScenes scenes;
  const std::string a = scenes.folder / "a.pack", b = scenes.folder / "b.pack";
  ASSERT_EQ(malus({"bake", scenes.first, "-o", a}).exitCode, 0);
  ASSERT_EQ(malus({"bake", scenes.second, "-o", b}).exitCode, 0);
  const Finished same = malus({"info", a, "--diff", a});
  EXPECT_EQ(same.exitCode, 0);
  EXPECT_EQ(same.out, "the packs are equal\n");
  const Finished other = malus({"info", a, "--diff", b});
  EXPECT_EQ(other.exitCode, 3);
  EXPECT_EQ(other.err, "");
  EXPECT_TRUE(contains(other.out, "exposureEv: 0.0 -> 2.0")) << other.out;
  EXPECT_TRUE(contains(other.out, "META  changed")) << other.out;
  const Finished text = malus({"info", a, "--diff", b, "--json"});
  EXPECT_EQ(text.exitCode, 3);
  EXPECT_FALSE(json::parse(text.out).at("equal"));
  EXPECT_EQ(malus({"info", a, "--diff", scenes.folder / "none.pack"}).exitCode, 1);
}

TEST(Packs, AreMadeAnewWhereSomethingChangedAlone) {
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
  const std::string bytes = textOf(pack);
  EXPECT_TRUE(upToDate());
  EXPECT_FALSE(upToDate({"--force"}));
  EXPECT_EQ(textOf(pack), bytes);
  EXPECT_FALSE(upToDate({"--normal-bits", "10"}));  // other settings
  EXPECT_FALSE(upToDate());
  // A touched source is not a changed one; a changed one is.
  const std::string floor = scenes.folder / "floor.obj", text = textOf(floor);
  writeText(floor, text);
  EXPECT_TRUE(upToDate());
  writeText(floor, "# a comment\n" + text);
  EXPECT_FALSE(upToDate());
  EXPECT_TRUE(upToDate());
  // A damaged pack is none.
  std::string damaged = textOf(pack);
  damaged[damaged.size() / 2] ^= 1;
  writeText(pack, damaged);
  EXPECT_FALSE(upToDate());
  // A source that is gone is an error although the pack is there.
  std::filesystem::remove(floor);
  expectRefusal(malus({"bake", scenes.first, "-o", pack}), "floor.obj");
}

TEST(Packs, RedoOnlyTheChangedMesh) {
  TwoScenes scenes;
  const std::string pack = scenes.folder / "out.pack";
  ASSERT_EQ(malus({"bake", scenes.first, "-o", pack}).exitCode, 0);
  const Finished text = malus({"bake", scenes.second, "-o", pack});  // another exposure, the same meshes
  EXPECT_TRUE(contains(text.out, "  0 of ")) << text.out;
  const Finished again = malus({"bake", scenes.first, "-o", pack, "--json"});
  EXPECT_EQ(json::parse(again.out).at("redone"), 0);
  const Finished forced = malus({"bake", scenes.first, "-o", pack, "--json", "--force"});
  const json report = json::parse(forced.out);
  EXPECT_EQ(report.at("redone"), report.at("meshes").size());
  EXPECT_EQ(TwoScenes::packHash(pack), scenes.firstHash);
}

// Killed at any moment: the old pack is there, or the new one, whole.
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
  // What the killed left behind goes with the next bake.
  EXPECT_EQ(malus({"bake", scenes.first, "-o", pack, "--force"}).exitCode, 0);
  for (const std::string& name : scenes.folder.names()) EXPECT_FALSE(contains(name, ".part")) << name;
  EXPECT_EQ(TwoScenes::packHash(pack), scenes.firstHash);
}

TEST(Packs, TwoBakersDoNotMix) {
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
    // Nothing but the pack is left.
    for (const std::string& name : scenes.folder.names()) EXPECT_FALSE(contains(name, ".part")) << name;
  }
}

}  // namespace
}  // namespace malus::test

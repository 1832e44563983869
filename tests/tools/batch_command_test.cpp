// `malus batch` and `malus merge`: images of `malus render`, interrupted and killed batches, bad jobs.
#include <csignal>
#include <map>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// The tiny scene baked, and a folder of jobs.
class BatchCommand : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder.path());
    ASSERT_EQ(malus({"bake", folder / "scene.json", "-o", folder / "tiny.pack"}).exitCode, 0);
  }

  Finished batch(const std::string& jobs, const std::string& output, std::vector<std::string> more = {},
                 const Start& start = {}) {
    writeText(folder / "jobs.jsonl", jobs);
    more.insert(more.begin(), {"batch", folder / "tiny.pack", folder / "jobs.jsonl", "-o", folder / output});
    return malus(more, start);
  }

  // The tiny scene with a replaced part of scene.json, rendered alone.
  std::string renderChanged(const std::string& from, const std::string& to, std::vector<std::string> options = {}) {
    std::string text = readText(folder / "scene.json");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    writeText(folder / "changed.json", text);
    EXPECT_EQ(malus({"bake", folder / "changed.json", "-o", folder / "changed.pack"}).exitCode, 0);
    options.insert(options.begin(),
                   {"render", folder / "changed.pack", "-o", folder / "changed.exr", "--method", "stokes"});
    const Finished rendered = malus(options);
    EXPECT_EQ(rendered.exitCode, 0) << rendered.err;
    return folder / "changed.exr";
  }

  static bool areEqual(const std::string& a, const std::string& b) {
    return malus({"compare-images", a, b, "--fail-over", "1e-6"}).exitCode == 0;
  }

  Folder folder;
};

TEST_F(BatchCommand, FramesAreTheImagesOfRender) {
  const Finished done = batch(
      "{\"name\": \"base\"}\n"
      "{\"name\": \"camera\", \"camera\": {\"position\": [-2, 3, 4], \"target\": [0, 0.4, 0], \"verticalFovDegrees\": "
      "40}}\n"
      "{\"name\": \"metal\", \"materials\": {\"gold\": {\"eta\": [1, 2, 3], \"k\": 2.5}}}\n"
      "{\"name\": \"albedo\", \"materials\": {\"floor\": {\"albedo\": [0.9, 0.1, 0.2]}}}\n"
      "{\"name\": \"dark\", \"lights\": false}\n"
      "{\"name\": \"filter\", \"polarizer\": 30, \"width\": 32}\n"
      "{\"name\": \"again\"}\n",
      "frames", {"--json"});
  ASSERT_EQ(done.exitCode, 0) << done.err;
  EXPECT_EQ(json::parse(done.out).at("rendered"), 7);
  EXPECT_EQ(json::parse(done.out).at("accelerationBuilds"), 1);
  const auto frame = [&](const char* name) { return folder / (std::string("frames/") + name + ".exr"); };
  EXPECT_TRUE(areEqual(frame("base"), renderChanged("tiny", "tiny")));
  EXPECT_TRUE(areEqual(frame("again"), folder / "changed.exr"));
  EXPECT_TRUE(areEqual(frame("camera"),
                       renderChanged("\"position\": [2, 2, 5], \"target\": [0, 0.5, 0], \"verticalFovDegrees\": 35",
                                     "\"position\": [-2, 3, 4], \"target\": [0, 0.4, 0], \"verticalFovDegrees\": 40")));
  EXPECT_TRUE(areEqual(frame("metal"), renderChanged("\"preset\": \"gold\"", "\"eta\": [1, 2, 3], \"k\": 2.5")));
  EXPECT_TRUE(areEqual(frame("albedo"), renderChanged("\"albedo\": 0.5", "\"albedo\": [0.9, 0.1, 0.2]")));
  EXPECT_TRUE(areEqual(frame("dark"), renderChanged("\"intensity\": [20, 20, 20]", "\"intensity\": [0, 0, 0]")));
  EXPECT_TRUE(areEqual(frame("filter"), renderChanged("tiny", "tiny", {"--polarizer", "30", "--width", "32"})));
  EXPECT_FALSE(areEqual(frame("metal"), frame("base")));
  EXPECT_FALSE(areEqual(frame("dark"), frame("base")));
  EXPECT_FALSE(areEqual(frame("camera"), frame("base")));
}

TEST_F(BatchCommand, GroundTruthIsThatOfRender) {
  ASSERT_EQ(batch("{\"name\": \"a\"}", "frames", {"--outputs", "truth,camera,png"}).exitCode, 0);
  ASSERT_EQ(malus({"render", folder / "tiny.pack", "--ground-truth", folder / "truth.exr"}).exitCode, 0);
  EXPECT_EQ(readText(folder / "frames/a.truth.exr"), readText(folder / "truth.exr"));
  const json camera = json::parse(readText(folder / "frames/a.json")).at("camera");
  EXPECT_NEAR(camera.at("cameraToWorld").at(0).at(3).get<double>(), 2, 1e-12);
  EXPECT_NEAR(camera.at("matrix").at(0).at(2).get<double>(), 32, 1e-9);
}

// A batch that is killed leaves whole files, and the next one adds the others.
TEST_F(BatchCommand, SensorsHaveTheNoiseOfTheirFrame) {
  const std::string jobs = "{\"repeat\": 2, \"name\": \"f\"}\n";
  const std::vector<std::string> options = {"--sensor", "imx250mzr", "--outputs", "raw,mask,sensor-stokes",
                                            "--width",  "32"};
  for (const char* output : {"frames", "again"}) {
    const Finished done = batch(jobs, output, options);
    ASSERT_EQ(done.exitCode, 0) << done.err;
  }
  const auto raw = [&](const char* name) { return readText(folder / (std::string(name) + ".raw.png")); };
  EXPECT_EQ(raw("frames/f-0"), raw("again/f-0"));
  EXPECT_NE(raw("frames/f-0"), raw("frames/f-1")) << "the same view with other noise";
  const json description = json::parse(readText(folder / "frames/f-1.raw.json"));
  std::istringstream manifest(readText(folder / "frames/manifest.jsonl"));
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(manifest, line);
  const json entry = json::parse(line);
  EXPECT_EQ(description.at("seed"), entry.at("seed"));
  EXPECT_EQ(entry.at("settings").at("sensor").at("fullWell"), description.at("fullWell"));
  EXPECT_EQ(entry.at("files").size(), 4u);
  EXPECT_TRUE(fs::exists(folder / "frames/f-1.mask.png") && fs::exists(folder / "frames/f-1.sensor.exr"));

  // Without a sensor, with an unknown one, and with a size that does not fit its pattern.
  const auto fails = [&](std::vector<std::string> more, int code, const char* word) {
    const Finished done = batch(jobs, "none", std::move(more));
    EXPECT_EQ(done.exitCode, code) << done.err;
    EXPECT_TRUE(contains(done.err, word)) << done.err;
  };
  fails({"--outputs", "raw"}, 1, "--sensor");
  fails({"--outputs", "raw", "--sensor", "imx250mzz"}, 2, "imx250mzr");
  fails({"--outputs", "raw", "--sensor", "imx250mzr", "--width", "33", "--height", "20"}, 1, "multiples of 2");
}

TEST_F(BatchCommand, ContinuesAfterAKill) {
  const std::string jobs = "{\"repeat\": 30, \"name\": \"f\", \"polarizer\": {\"uniform\": [0, 180]}, \"width\": 200}";
  ASSERT_EQ(batch(jobs, "whole", {"--outputs", "exr,png,truth"}).exitCode, 0);
  Start start;
  start.sendSignal = SIGKILL;
  start.sendSignalWhen = [](std::string_view text) { return contains(text, "frame 9 of 30"); };
  const Finished killed = batch(jobs, "part", {"--outputs", "exr,png,truth", "-v"}, start);
  ASSERT_EQ(killed.signal, SIGKILL) << killed.err;
  std::size_t whole = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "part")) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") || name == "manifest.jsonl") continue;
    ++whole;
    EXPECT_EQ(readText(entry.path()), readText(folder / ("whole/" + name))) << name;
  }
  EXPECT_GE(whole, 9u);
  EXPECT_LT(whole, 90u);
  const Finished rest = batch(jobs, "part", {"--outputs", "exr,png,truth", "--json"});
  ASSERT_EQ(rest.exitCode, 0) << rest.err;
  EXPECT_GE(json::parse(rest.out).at("reused"), 3);
  EXPECT_EQ(json::parse(rest.out).at("reused").get<int>() + json::parse(rest.out).at("rendered").get<int>(), 30);
  EXPECT_EQ(readText(folder / "part/manifest.jsonl"), readText(folder / "whole/manifest.jsonl"));
  for (const auto& entry : fs::directory_iterator(folder.path() / "whole"))
    EXPECT_EQ(readText(entry.path()), readText(folder / ("part/" + entry.path().filename().string()))) << entry.path();
}

TEST_F(BatchCommand, KeepsFinishedFramesWhenInterrupted) {
  const std::string jobs = "{\"repeat\": 200, \"name\": \"f\", \"polarizer\": {\"uniform\": [0, 180]}, \"width\": 200}";
  Start start;
  start.sendSignal = SIGINT;
  start.sendSignalWhen = [](std::string_view text) { return contains(text, "frame 5 of 200"); };
  const Finished stopped = batch(jobs, "frames", {"-v"}, start);
  EXPECT_EQ(stopped.exitCode, 130) << stopped.err;
  EXPECT_TRUE(contains(stopped.err, "of 200 frames are finished")) << stopped.err;
  std::istringstream lines(readText(folder / "frames/manifest.jsonl"));
  std::size_t listed = 0;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    ++listed;
    for (const json& file : json::parse(line).at("files"))
      EXPECT_EQ(fs::file_size(folder / ("frames/" + file.at("file").get<std::string>())), file.at("bytes"));
  }
  EXPECT_GE(listed, 4u);
  EXPECT_LT(listed, 200u);
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "frames"))
    if (entry.path().extension() == ".exr") ++files;
  EXPECT_EQ(files, listed);
}

// A disk that is full: one line, and what was finished stays.
TEST_F(BatchCommand, FullDisk) {
  writeText(folder / "jobs.jsonl", "{\"name\": \"small\", \"width\": 8}\n{\"name\": \"large\", \"width\": 400}\n");
  const Finished full = malusWithFileLimit(
      64, {"batch", folder / "tiny.pack", folder / "jobs.jsonl", "-o", folder / "frames", "--compression", "none"});
  expectRefusal(full, "large.exr");
  EXPECT_TRUE(fs::exists(folder / "frames/small.exr"));
  EXPECT_FALSE(fs::exists(folder / "frames/large.exr"));
  const Finished rest = batch(readText(folder / "jobs.jsonl"), "frames", {"--json", "--compression", "none"});
  ASSERT_EQ(rest.exitCode, 0) << rest.err;
  EXPECT_EQ(json::parse(rest.out).at("reused"), 1);
}

TEST_F(BatchCommand, ShardsMerge) {
  const std::string jobs = "{\"repeat\": 5, \"polarizer\": {\"uniform\": [0, 180]}}";
  ASSERT_EQ(batch(jobs, "whole", {"--seed", "4"}).exitCode, 0);
  ASSERT_EQ(batch(jobs, "one", {"--seed", "4", "--shard", "1/2", "--threads", "1"}).exitCode, 0);
  ASSERT_EQ(batch(jobs, "two", {"--seed", "4", "--shard", "2/2"}).exitCode, 0);
  const auto merge = [&](std::vector<std::string> folders) {
    std::vector<std::string> arguments = {"merge", "-o", folder / "merged"};
    for (const std::string& name : folders) arguments.push_back(folder / name);
    return malus(arguments);
  };
  expectRefusal(merge({"one"}), "manifest.jsonl", "2 of 5");
  EXPECT_FALSE(fs::exists(folder / "merged"));
  const Finished merged = merge({"one", "two"});
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  for (const auto& entry : fs::directory_iterator(folder.path() / "whole"))
    EXPECT_EQ(readText(entry.path()), readText(folder / ("merged/" + entry.path().filename().string())))
        << entry.path();
  EXPECT_EQ(malus({"merge", folder / "one", "-o", folder / "one"}).exitCode, 2);
}

// One image in tiles: the first shard is killed, the second is interrupted, both continue.
TEST_F(BatchCommand, TilesContinueAndMerge) {
  const std::string job = "{\"name\": \"large\", \"width\": 1530, \"height\": 1100, \"outputs\": \"exr,png\"}";
  ASSERT_EQ(batch(job, "whole").exitCode, 0);
  const auto shard = [&](const char* number, int signal) {
    Start start;
    start.sendSignal = signal;
    start.sendSignalWhen = [](std::string_view text) { return contains(text, "tile 8 of 15"); };
    return batch(job, std::string("part") + number, {"--tiles", "--shard", number + std::string("/2"), "-v", "--json"},
                 signal == 0 ? Start() : start);
  };
  EXPECT_EQ(shard("1", SIGKILL).signal, SIGKILL);
  const Finished stopped = shard("2", SIGINT);
  EXPECT_EQ(stopped.exitCode, 130);
  EXPECT_TRUE(contains(stopped.err, "of 15 tiles are finished")) << stopped.err;
  const auto merge = [&] { return malus({"merge", folder / "part1", folder / "part2", "-o", folder / "merged"}); };
  expectRefusal(merge(), "manifest.jsonl", "of 30 tiles", "'large'");
  for (const char* number : {"1", "2"}) {
    const std::string part = std::string("part") + number;
    std::map<std::string, std::string> before;  // complete tiles
    for (const auto& entry : fs::directory_iterator(folder.path() / part)) {
      const std::string name = entry.path().filename();
      if (!name.starts_with(".") && name != "manifest.jsonl") before[name] = readText(entry.path());
    }
    EXPECT_GE(before.size(), 3u);
    EXPECT_LT(before.size(), 16u);
    const Finished rest = shard(number, 0);
    ASSERT_EQ(rest.exitCode, 0) << rest.err;
    const json document = json::parse(rest.out);
    EXPECT_EQ(document.at("tiles"), 30);
    EXPECT_GE(document.at("reused"), 1);
    EXPECT_EQ(document.at("reused").get<int>() + document.at("rendered").get<int>(), 15);
    for (const auto& [name, text] : before) EXPECT_TRUE(readText(folder / (part + "/" + name)) == text) << name;
  }
  const Finished merged = merge();
  ASSERT_EQ(merged.exitCode, 0) << merged.err;
  for (const auto& entry : fs::directory_iterator(folder.path() / "whole"))
    EXPECT_TRUE(readText(entry.path()) == readText(folder / ("merged/" + entry.path().filename().string())))
        << entry.path();
}

TEST_F(BatchCommand, BadJobsAreOneLine) {
  expectRefusal(batch("{}\n{\"camra\": 1}", "frames"), "jobs.jsonl:2", "camra", "'camera'");
  expectRefusal(batch("{\"materials\": {\"gold\": {\"eta\": -1}}}", "frames"), "jobs.jsonl:1", "materials.gold.eta",
                "-1");
  expectRefusal(batch("{\"width\": 16", "frames"), "jobs.jsonl:1", "JSON");
  expectRefusal(batch("{\"wavelengthsNm\": [600, 500, 400]}", "frames"), "jobs.jsonl:1", "wavelengthsNm", "preset");
  EXPECT_FALSE(fs::exists(folder / "frames"));
  writeText(folder / "jobs.csv", "name,widht\na,3\n");
  expectRefusal(malus({"batch", folder / "tiny.pack", folder / "jobs.csv", "-o", folder / "frames"}), "jobs.csv:2",
                "widht", "'width'");
  expectRefusal(malus({"batch", folder / "tiny.pack", folder / "none.jsonl", "-o", folder / "frames"}), "none.jsonl");
}

TEST_F(BatchCommand, WrongCommandLines) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--outputs", "exr,gif"},
                                               {"--shard", "3/2"},
                                               {"--shard", "x"},
                                               {"--seed", "-1"},
                                               {"--polarizer", "1", "--analyser", "left"},
                                               {"--method", "stoks"}})
    EXPECT_EQ(batch("{}", "frames", more).exitCode, 2) << more[0] << ' ' << more[1];
  EXPECT_EQ(malus({"batch", folder / "tiny.pack", "-o", folder / "frames"}).exitCode, 2);
  EXPECT_FALSE(fs::exists(folder / "frames"));
  // A frame must not replace a file that is read.
  fs::create_directories(folder.path() / "in");
  fs::copy_file(folder / "tiny.pack", folder / "in/a.png");
  writeText(folder / "jobs.jsonl", "{\"name\": \"a\"}");
  EXPECT_EQ(malus({"batch", folder / "in/a.png", folder / "jobs.jsonl", "-o", folder / "in"}).exitCode, 2);
}

}  // namespace
}  // namespace malus::test

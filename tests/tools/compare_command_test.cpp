// `malus compare` and `malus render --max-error`: results, wrong arguments, failing rows, interruption.
#include <algorithm>
#include <csignal>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

class Compare : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder_.path());
    ASSERT_EQ(malus({"bake", folder_ / "scene.json", "-o", pack()}).exitCode, 0);
  }
  std::string pack() const { return folder_ / "tiny.pack"; }
  std::string report() const { return folder_ / "report"; }
  Finished compare(std::vector<std::string> more,
                   std::vector<std::pair<std::string, std::string>> environment = {}) const {
    std::vector<std::string> arguments = {"compare", pack(), "-o", report(), "--width", "32", "--no-report"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Start start;
    start.environment = std::move(environment);
    start.environment.emplace_back("MALUS_DEVICE", "llvmpipe");
    start.timeoutSeconds = 1500;
    return malus(arguments, start);
  }
  json results() const { return json::parse(readText(report() + "/results.json")); }

  Folder folder_;
};

TEST_F(Compare, EveryMethodOnBothRenderers) {
  const Finished finished = compare({"--rounds", "2"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  EXPECT_EQ(document.at("settings").at("rounds"), 2);
  ASSERT_EQ(document.at("rows").size(), 24u);
  std::map<std::string, std::set<std::uint64_t>> rays;
  for (const json& row : document.at("rows")) {
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("width"), 32);
    EXPECT_EQ(row.at("height"), 24);
    EXPECT_EQ(row.at("samplesMs").size(), 2u);
    EXPECT_GT(row.at("medianMs"), 0);
    EXPECT_TRUE(std::filesystem::exists(report() + "/" + row.at("image").get<std::string>()));
    for (const char* number : {"meanAbs", "maxAbs", "relRms", "shareOver1Percent", "perceptual", "energyRatio"})
      for (const char* part : {"error", "precision", "errorToReference"})
        EXPECT_TRUE(row.at(part).at(number).is_number()) << part << ' ' << number;
    EXPECT_EQ(row.at("errorAgainst"), "stokes");
    const double method = row.at("error").at("relRms"), precision = row.at("precision").at("relRms"),
                 both = row.at("errorToReference").at("relRms");
    // Differences of the same images: the triangle inequality, with room for the two sums that divide them.
    EXPECT_LE(both, 1.01 * (method + precision));
    EXPECT_GE(both, 0.99 * std::abs(method - precision));
    EXPECT_LT(precision, 1e-3);
    EXPECT_GT(precision, 0);
    rays[row.at("renderer")].insert(row.at("rays").get<std::uint64_t>());
    if (row.at("method") == "stokes") {
      EXPECT_EQ(method, 0);
      EXPECT_EQ(both, precision);
    }
    if (row.at("method") == "schlick") {
      EXPECT_EQ(row.at("ratioToSchlick").at("median"), 1);
    }
  }
  // Iterative methods once more by pipelines, and some by single rays, with the same rays and the same image.
  std::multiset<std::string> secondPaths;
  for (const json& row : document.at("rowsOnSecondPath")) {
    EXPECT_EQ(row.at("status"), "ok");
    const bool isVulkan = row.at("renderer") == "vulkan";
    EXPECT_EQ(row.at(isVulkan ? "embreePath" : "vulkanPath"), json());
    secondPaths.insert(row.at(isVulkan ? "vulkanPath" : "embreePath").get<std::string>());
    if (isVulkan) {
      EXPECT_EQ(row.at("payloadBytes"), 16);
    }
    EXPECT_EQ(row.at("samplesMs").size(), 2u);
    rays[row.at("renderer")].insert(row.at("rays").get<std::uint64_t>());
  }
  EXPECT_EQ(secondPaths,
            (std::multiset<std::string>{"pipeline", "pipeline", "pipeline", "scalar", "scalar", "scalar"}));
  ASSERT_EQ(document.at("paths").size(), 6u);
  for (const json& entry : document.at("paths")) {
    const bool isVulkan = entry.at("renderer") == "vulkan";
    EXPECT_GT(entry.at(isVulkan ? "query" : "packet").at("medianMs"), 0);
    EXPECT_GT(entry.at(isVulkan ? "pipeline" : "scalar").at("medianMs"), 0);
    EXPECT_GT(entry.at(isVulkan ? "pipelineToQuery" : "scalarToPacket").at("median"), 0);
    EXPECT_LE(entry.at("largestDifference"), isVulkan ? 0 : 1e-6);
  }
  EXPECT_TRUE(contains(finished.out, "pipeline / query"));
  EXPECT_TRUE(contains(finished.out, "scalar / packet"));
  // Fairness: every method sends the same rays.
  for (const auto& [renderer, counts] : rays) EXPECT_EQ(counts.size(), 1u) << renderer;
  EXPECT_TRUE(contains(finished.out, "ratio to schlick"));
  EXPECT_TRUE(contains(readText(report() + "/results.csv"), "tiny,embree,stokes-half,auto,32,24,4,24,"));
}

TEST_F(Compare, SizesAndDepths) {
  const Finished finished =
      malus({"compare", pack(), "-o", report(), "--backends", "embree", "--methods", "fresnel", "--width", "16,20",
             "--height", "10,30", "--depth", "0,3", "--rounds", "1", "--no-report"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  std::set<std::string> views;
  const json document = results();
  for (const json& row : document.at("rows"))
    if (row.at("method") == "fresnel")
      views.insert(row.at("width").dump() + "x" + row.at("height").dump() + " " + row.at("depth").dump());
  EXPECT_EQ(views, (std::set<std::string>{"16x10 0", "16x10 3", "20x30 0", "20x30 3"}));
  expectRefusal(malus({"compare", pack(), "-o", report(), "--width", "16,20", "--height", "10", "--no-report"}),
                "--height");
}

TEST_F(Compare, OnePathOfEmbreeOnRequest) {
  const Finished finished =
      compare({"--rounds", "1", "--backends", "embree", "--methods", "fresnel", "--embree-path", "scalar"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  ASSERT_EQ(document.at("rows").size(), 2u);
  for (const json& row : document.at("rows")) EXPECT_EQ(row.at("embreePath"), "scalar");
  EXPECT_TRUE(document.at("rowsOnSecondPath").empty());
  EXPECT_TRUE(document.at("paths").empty());
}

TEST_F(Compare, OnePathOnRequest) {
  const Finished finished = compare(
      {"--rounds", "1", "--backends", "vulkan", "--methods", "fresnel,fresnel-iterative", "--vulkan-path", "query"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  ASSERT_EQ(document.at("rows").size(), 3u);
  for (const json& row : document.at("rows")) {
    EXPECT_EQ(row.at("vulkanPath"), "query");
    EXPECT_EQ(row.at("withoutRecursion").is_null(), row.at("method") == "fresnel-iterative");
  }
  EXPECT_TRUE(document.at("rowsOnSecondPath").empty());
  EXPECT_TRUE(document.at("paths").empty());
  EXPECT_TRUE(contains(finished.out, "without recursion: schlick fresnel")) << finished.out;
}

TEST_F(Compare, FailedRowsKeepTheirReasonAndOthersContinue) {
  const Finished finished = compare({"--rounds", "1", "--methods", "fresnel", "--vulkan-path", "query"},
                                    {{"MALUS_VULKAN_LIMITS", "rayQuery=0"}});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  std::size_t failed = 0;
  const json document = results();
  for (const json& row : document.at("rows")) {
    if (row.at("renderer") == "embree") {
      EXPECT_EQ(row.at("status"), "ok");
      continue;
    }
    ++failed;
    EXPECT_TRUE(contains(row.at("status").get<std::string>(), "--vulkan-path")) << row.at("status");
    EXPECT_TRUE(row.at("medianMs").is_null());
  }
  EXPECT_EQ(failed, 2u);
  EXPECT_TRUE(contains(finished.out, "failed")) << finished.out;
}

TEST_F(Compare, Refusals) {
  EXPECT_EQ(compare({"--methods", "magic"}).exitCode, 2);
  EXPECT_EQ(compare({"--backends", "magic"}).exitCode, 2);
  EXPECT_EQ(malus({"compare", "-o", report()}).exitCode, 2);
  EXPECT_EQ(compare({"--rounds", "0"}).exitCode, 2);
  expectRefusal(malus({"compare", pack(), pack(), "-o", report()}), "'tiny'");
  expectRefusal(malus({"compare", folder_ / "no.pack", "-o", report()}), "no.pack");
  writeText(folder_ / "taken", "");
  expectRefusal(malus({"compare", pack(), "-o", folder_ / "taken/report"}), "taken");
  expectRefusal(compare({"--rounds", "1", "--backends", "embree", "--methods", "fresnel", "--gpu-model", "magic"}),
                "magic");
}

// In a pipe a line about the current step appears at least every 30 seconds, also within a long step; -q prints none.
TEST_F(Compare, PrintsItsStepInAPipe) {
  Start start;
  start.sendSignalWhen = [](std::string_view err) { return contains(err, "round ", " of 1000000"); };
  start.sendSignal = SIGINT;
  start.timeoutSeconds = 120;
  const Finished finished = malus({"compare", pack(), "-o", report(), "--backends", "embree", "--methods", "fresnel",
                                   "--width", "200", "--rounds", "1000000", "--no-report"},
                                  start);
  EXPECT_EQ(finished.exitCode, 130) << finished.err;
  EXPECT_LT(finished.seconds, 40);
}

TEST_F(Compare, InterruptingKeepsTheFinishedRounds) {
  Start start;
  // Progress is printed on a terminal; -v prints it to a pipe as well.
  start.sendSignalWhen = [](std::string_view err) { return contains(err, "round 3 of 100000"); };
  start.sendSignal = SIGINT;
  const Finished finished = malus({"-v", "compare", pack(), "-o", report(), "--backends", "embree", "--width", "200",
                                   "--rounds", "100000", "--no-report"},
                                  start);
  ASSERT_EQ(finished.exitCode, 130) << finished.err;
  const json document = results();
  const auto rounds = document.at("settings").at("rounds").get<std::size_t>();
  EXPECT_GE(rounds, 2u);
  EXPECT_LT(rounds, 100000u);
  EXPECT_EQ(document.at("settings").at("interrupted"), true);
  ASSERT_EQ(document.at("rows").size(), 12u);
  for (const json& row : document.at("rows")) EXPECT_EQ(row.at("samplesMs").size(), rounds);
  EXPECT_TRUE(contains(finished.err, "interrupted")) << finished.err;
}

// Each error has one row, whose error it bounds; rows are timed in the same rounds as the methods.
TEST_F(Compare, ShowsWhatMaxErrorChooses) {
  ASSERT_EQ(compare({"--rounds", "2", "--backends", "embree"}).exitCode, 0);
  const json document = results();
  std::vector<double> errors;
  for (const json& row : document.at("rowsWithinError")) {
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("samplesMs").size(), 2u);
    EXPECT_LE(row.at("tracedDepth"), row.at("depth"));
    for (const double maxError : row.at("maxErrors")) {
      errors.push_back(maxError);
      EXPECT_LE(row.at("displayRelRms"), maxError) << row.dump(1);
    }
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_EQ(errors, (std::vector<double>{0.001, 0.01, 0.05}));

  ASSERT_EQ(compare({"--rounds", "1", "--backends", "embree", "--methods", "fresnel"}).exitCode, 0);
  EXPECT_TRUE(results().at("rowsWithinError").empty()) << "only some methods are compared";
}

TEST_F(Compare, InterruptingAnImageOfSeveralLaunchesKeepsTheFinishedRounds) {
  Start start;
  start.environment = {{"MALUS_DEVICE", "llvmpipe"}};
  start.sendSignalWhen = [](std::string_view err) { return contains(err, "round 2 of 100000"); };
  start.sendSignal = SIGINT;
  const Finished finished = malus({"-v", "compare", pack(), "-o", report(), "--backends", "vulkan", "--methods",
                                   "fresnel", "--width", "100", "--rounds", "100000", "--no-report"},
                                  start);
  ASSERT_EQ(finished.exitCode, 130) << finished.err;
  const json document = results();
  const auto rounds = document.at("settings").at("rounds").get<std::size_t>();
  EXPECT_GE(rounds, 1u);
  for (const json& row : document.at("rows")) EXPECT_EQ(row.at("samplesMs").size(), rounds);
}

TEST_F(Compare, ATimeLimitKeepsTheFirstMethodsAndTheFinishedRounds) {
  const Finished finished = malus({"compare", pack(), "-o", report(), "--backends", "embree", "--width", "200",
                                   "--rounds", "100000", "--minutes", "0.05", "--no-report"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json document = results();
  EXPECT_EQ(document.at("settings").at("timeIsOver"), true);
  EXPECT_LT(document.at("settings").at("rounds").get<int>(), 100000);
  EXPECT_TRUE(contains(finished.err, "--minutes")) << finished.err;
  ASSERT_GE(document.at("rows").size(), 1u);
  EXPECT_EQ(document.at("rows")[0].at("method"), "schlick");
  EXPECT_EQ(compare({"--minutes", "-1"}).exitCode, 2);
}

TEST_F(Compare, ALimitThatIsTooShortStillTimesTheFirstMethod) {
  ASSERT_EQ(compare({"--backends", "embree", "--methods", "stokes,schlick", "--minutes", "0.00001"}).exitCode, 0);
  const json document = results();
  ASSERT_EQ(document.at("rows").size(), 1u);
  EXPECT_EQ(document.at("rows")[0].at("status"), "ok");
  EXPECT_EQ(document.at("rows")[0].at("samplesMs").size(), 1u);
}

// lavapipe may compile a method for minutes.
TEST_F(Compare, VulkanOnACpuComesLast) {
  ASSERT_EQ(compare({"--methods", "schlick", "--minutes", "0.00001"}).exitCode, 0);
  const json rows = results().at("rows");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("renderer"), "embree");
  EXPECT_EQ(rows[1].at("renderer"), "vulkan");
  for (const json& row : rows) EXPECT_EQ(row.at("samplesMs").size(), 1u);
}

TEST_F(Compare, ResultsAreWrittenAsTheyCome) {
  Start start;
  start.sendSignalWhen = [](std::string_view err) { return contains(err, "round 2 of"); };
  start.sendSignal = SIGKILL;
  malus({"-v", "compare", pack(), "-o", report(), "--backends", "embree", "--width", "200", "--rounds", "100000",
         "--no-report"},
        start);
  const json document = results();
  ASSERT_EQ(document.at("rows").size(), 12u);
  for (const json& row : document.at("rows")) EXPECT_TRUE(row.at("error").is_object());
}

TEST_F(Compare, ShowPutsDevicesSideBySide) {
  ASSERT_EQ(compare({"--rounds", "1", "--methods", "schlick,stokes"}).exitCode, 0);
  json other = results();
  EXPECT_TRUE(other.at("deviceInfo").at("values").contains("maxRayRecursionDepth"));
  EXPECT_EQ(other.at("deviceInfo").at("rayTracingCores"), "no");
  other.at("devices").at("vulkan") = "Quick GPU";
  for (json& row : other.at("rows"))
    if (row.at("method") == "stokes") row.at("ratioToSchlick") = {{"median", 1.375}, {"low", 1.25}, {"high", 1.5}};
  writeText(folder_ / "other.json", other.dump());
  const Finished shown =
      malus({"compare", "--show", report() + "/results.json", folder_ / "other.json", "-o", folder_ / "page"});
  ASSERT_EQ(shown.exitCode, 0) << shown.err;
  EXPECT_TRUE(contains(shown.out, "Quick GPU", "llvmpipe", "Embree", "stokes", "1.375", "ray-tracing cores"))
      << shown.out;
  const std::string page = readText(folder_ / "page/index.html");
  EXPECT_TRUE(contains(page, "Quick GPU", "llvmpipe", "1.375", "ray-tracing cores")) << page.size();
}

TEST_F(Compare, ShowRefusesOtherFiles) {
  writeText(folder_ / "text.json", "no");
  writeText(folder_ / "list.json", "[]");
  writeText(folder_ / "row.json", R"({"devices": {}, "scenes": {}, "rows": [{"scene": "a"}]})");
  for (const char* name : {"text.json", "list.json", "row.json", "missing.json"})
    expectRefusal(malus({"compare", "--show", folder_ / name}), name);
  EXPECT_EQ(malus({"compare", pack(), "--show", folder_ / "list.json"}).exitCode, 2);
  EXPECT_EQ(malus({"compare"}).exitCode, 2);
  EXPECT_EQ(malus({"compare", pack()}).exitCode, 2);
}

// The time of the exact method in cached measurements.
double completeMs(const json& measured) {
  for (const json& choice : measured.at("choices"))
    if (choice.at("kind") == "method" && choice.at("name") == "stokes") return choice.at("medianMs");
  return 0;
}

TEST_F(Compare, MaxErrorChoosesAMethodAndCachesItsMeasurements) {
  Start start;
  start.environment = {{"XDG_CACHE_HOME", folder_ / "cache"}};
  const auto render = [&](const char* bound) {
    return malus({"render", pack(), "-o", folder_ / "a.exr", "--backend", "embree", "--max-error", bound, "--json"},
                 start);
  };
  const Finished exact = render("1e-4");
  ASSERT_EQ(exact.exitCode, 0) << exact.err;
  const json chosen = json::parse(exact.out).at("method");
  for (const char* wrong : {"schlick", "fresnel", "sp", "sp-cosine", "sp-ratio"}) EXPECT_NE(chosen, wrong);
  EXPECT_TRUE(contains(exact.err, "RMS")) << exact.err;
  // The measurements are cached by the hash of the pack.
  const auto cached = [&] {
    std::vector<std::filesystem::path> files;
    for (const auto& e : std::filesystem::directory_iterator(folder_.path() / "cache/malus/errors"))
      files.push_back(e.path());
    return files;
  };
  ASSERT_EQ(cached().size(), 1u);
  const auto written = std::filesystem::last_write_time(cached()[0]);
  const Finished coarse = render("1000");
  ASSERT_EQ(coarse.exitCode, 0) << coarse.err;
  ASSERT_EQ(cached().size(), 1u);
  EXPECT_EQ(std::filesystem::last_write_time(cached()[0]), written);
  const json measured = json::parse(readText(cached()[0]));
  const json budget = json::parse(coarse.out).at("budget");
  EXPECT_FALSE(budget.at("parts").empty());
  EXPECT_GT(budget.at("expectedMs"), 0);
  // The exact method is exact, whatever the precision of the renderer.
  EXPECT_GT(measured.at("precision"), 0);
  const Finished strict = render("0");
  ASSERT_EQ(strict.exitCode, 0) << strict.err;
  EXPECT_TRUE(contains(strict.err, "precision")) << strict.err;
  EXPECT_EQ(json::parse(strict.out).at("budget").at("parts").size(), 0u);
  EXPECT_EQ(json::parse(strict.out).at("budget").at("method"), "stokes");
}

TEST_F(Compare, MaxMsIsTheDualOfMaxError) {
  Start start;
  start.environment = {{"XDG_CACHE_HOME", folder_ / "cache"}};
  const auto render = [&](const char* option, const char* value) {
    return malus({"render", pack(), "-o", folder_ / "a.exr", "--backend", "embree", option, value, "--json"}, start);
  };
  const Finished slow = render("--max-ms", "1e6");
  ASSERT_EQ(slow.exitCode, 0) << slow.err;
  EXPECT_EQ(json::parse(slow.out).at("budget").at("expectedRelRms"), 0) << slow.out;
  const Finished impossible = render("--max-ms", "0.001");
  EXPECT_EQ(impossible.exitCode, 1) << impossible.err;
  EXPECT_TRUE(contains(impossible.err, "--max-ms")) << impossible.err;
  for (const char* bad : {"0", "-1", "nan"}) EXPECT_EQ(render("--max-ms", bad).exitCode, 2) << bad;
  for (const char* bad : {"-1", "nan"}) EXPECT_EQ(render("--max-error", bad).exitCode, 2) << bad;
}

// Cached times that are too short by a thousand, as if the machine had become slower.
TEST_F(Compare, MaxMsMeasuresTheMachineAsItIs) {
  Start start;
  start.environment = {{"XDG_CACHE_HOME", folder_ / "cache"}};
  const auto render = [&](const std::string& ms) {
    return malus({"render", pack(), "-o", folder_ / "a.exr", "--backend", "embree", "--max-ms", ms, "--json"}, start);
  };
  ASSERT_EQ(render("1e6").exitCode, 0);
  double complete = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "cache/malus/errors")) {
    json measured = json::parse(readText(entry.path()));
    complete = completeMs(measured);
    for (json& choice : measured.at("choices")) choice["medianMs"] = choice.at("medianMs").get<double>() / 1000;
    writeText(entry.path(), measured.dump());
  }
  const Finished slow = render("1e6");
  ASSERT_EQ(slow.exitCode, 0) << slow.err;
  const json budget = json::parse(slow.out).at("budget");
  EXPECT_GT(budget.at("completeMs"), complete / 50) << "not the cached time";
  // The least time that is reported is longer than the time that nothing kept.
  const Finished impossible = render("0.001");
  ASSERT_EQ(impossible.exitCode, 1) << impossible.err;
  const std::string expected = "expected ";
  EXPECT_GT(std::stod(impossible.err.substr(impossible.err.find(expected) + expected.size())), 0.001) << impossible.err;
}

TEST_F(Compare, ABudgetDoesNotWarnOfTheDepthThatItChooses) {
  Start start;
  start.environment = {{"XDG_CACHE_HOME", folder_ / "cache"}};
  const auto render = [&](const char* option, const char* value) {
    return malus({"render", pack(), "-o", folder_ / "a.exr", "--backend", "embree", option, value, "--json"}, start);
  };
  EXPECT_TRUE(contains(render("--depth", "0").err, "lost", "--depth"));
  const Finished chosen = render("--max-error", "1000");
  EXPECT_LT(json::parse(chosen.out).at("depth"), 4);
  EXPECT_FALSE(contains(chosen.err, "lost")) << chosen.err;
}

TEST_F(Compare, ABudgetRefusesWhatItChooses) {
  for (const auto& [option, value] : {std::pair("--max-error", "1"), {"--max-ms", "5"}})
    for (const auto& [other, chosen] :
         {std::pair("--method", "stokes"), {"--effects", "metal"}, {"--effects", "nothing"}, {"--tolerance", "0.1"}}) {
      const Finished finished = malus({"render", pack(), "-o", folder_ / "a.exr", option, value, other, chosen});
      EXPECT_EQ(finished.exitCode, 2) << option << other;
      EXPECT_TRUE(contains(finished.err, option, other)) << finished.err;
    }
  EXPECT_EQ(malus({"render", pack(), "-o", folder_ / "a.exr", "--max-ms", "5", "--max-error", "1"}).exitCode, 2);
}

}  // namespace
}  // namespace malus::test

// The GPU model compiles on Mesa's null device, without a GPU. These tests fail without the radeon driver.
#include "render/vulkan/gpu_model.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "bake/pack/writer.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"
#include "render/vulkan/glsl_compiler.h"
#include "render/vulkan/variant.h"
#include "tests/render/test_scene.h"

namespace malus::vulkan {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pack::MaterialKind;

constexpr std::uint32_t kDepth = 8;
constexpr const char* kFamilies[] = {"navi21", "navi31"};

// A pack with paint, metal and a point light; no glass, lambert or emitter.
class GpuModel : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    pack::Scene scene = test::emptyScene(kDepth);
    scene.environment.radiance = {1, 1, 1};
    scene.environment.ambientIrradiance = 0.5;
    scene.environment.irradiance[0] = {1, 1, 1};
    const auto paint = test::addMaterial(scene, test::dielectric(MaterialKind::paint, 1.5, 0.6));
    const auto gold = test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
    test::addSquare(scene, paint, {0, -1, 0}, {0, 1, 0}, 3);
    test::addSquare(scene, gold, {-2, 0, 0}, {1, 0, 0.4}, 1.5);
    scene.lights.push_back({{1, 1.5, 2}, {6, 6, 6}});
    test::look(scene, {0, 0, 4}, {0, 0, 0});
    path_ = fs::path(testing::TempDir()) / fmt::format("gpu_model_{}.pack", ::getpid());
    pack::write(path_, scene, {});
  }
  static void TearDownTestSuite() { fs::remove(path_); }

  // All methods, compiled once per family in this program.
  static const std::vector<PipelineStatistics>& all(const std::string& family) {
    static std::map<std::string, std::vector<PipelineStatistics>> cache;
    std::vector<PipelineStatistics>& result = cache[family];
    if (result.empty()) result = gpuModel(path_, family, render::methodNames(), kDepth);
    return result;
  }

  static fs::path path_;
};
fs::path GpuModel::path_;

json listToJson(const std::vector<PipelineStatistics>& list) {
  json result = json::array();
  for (const PipelineStatistics& s : list) result.push_back(toJson(s));
  return result;
}

// The numbers that gpu_model_golden.json contains, so that a change of the shaders cannot change them unnoticed. Per
// stage [instructions, inverse throughput, vector registers, scalar registers, spilled vector registers, spilled scalar
// registers, stack bytes].
json goldenNumbers(const PipelineStatistics& s) {
  json result;
  for (const StageStatistics& stage : s.stages) {
    json& row = result[stage.stage];
    for (const auto& number : {stage.instructions, stage.inverseThroughput, stage.vectorRegisters,
                               stage.scalarRegisters, stage.spilledVectorRegisters, stage.spilledScalarRegisters})
      row.push_back(number.value());
    if (const auto stack = s.groupStackBytes.find(stage.stage); stack != s.groupStackBytes.end())
      row.push_back(stack->second);
  }
  return result;
}

// The versions that the numbers depend on, without the package's revision: "Mesa 25.0.7, glslang 12.0.0".
std::string compilers(const PipelineStatistics& s) {
  std::string mesa = s.driver.substr(std::min(s.driver.size(), s.driver.find("Mesa")));
  if (const std::size_t space = mesa.find(' '); space != std::string::npos)
    mesa.resize(std::min(mesa.size(), mesa.find_first_not_of("0123456789.", space + 1)));
  return mesa + ", " + glslangVersion();
}

TEST_F(GpuModel, IsDeterministic) {
  for (const char* family : kFamilies)
    EXPECT_EQ(listToJson(all(family)), listToJson(gpuModel(path_, family, render::methodNames(), kDepth))) << family;
}

TEST_F(GpuModel, ReportsEveryMethodAndStage) {
  for (const char* family : kFamilies) {
    const auto& list = all(family);
    ASSERT_EQ(list.size(), render::methods().size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      const PipelineStatistics& s = list[i];
      SCOPED_TRACE(fmt::format("{} {}", family, s.method));
      EXPECT_EQ(s.family, family);
      EXPECT_EQ(s.method, render::methods()[i].name);
      EXPECT_EQ(s.payloadBytes, render::methods()[i].payloadBytes);
      EXPECT_NE(s.driver.find("radv"), std::string::npos) << s.driver;
      std::vector<std::string> names;
      for (const StageStatistics& stage : s.stages) {
        names.push_back(stage.stage);
        EXPECT_GT(stage.instructions.value_or(0), 0u) << stage.stage;
        EXPECT_GT(stage.inverseThroughput.value_or(0), 0u) << stage.stage;
        EXPECT_GE(stage.latency.value_or(0), stage.inverseThroughput.value_or(1)) << stage.stage;
        EXPECT_GT(stage.codeBytes.value_or(0), 0u) << stage.stage;
        EXPECT_GT(stage.vectorRegisters.value_or(0), 0u) << stage.stage;
        EXPECT_LE(stage.vectorRegisters.value_or(999), 256u) << stage.stage;
        EXPECT_GT(stage.wavesPerSimd.value_or(0), 0u) << stage.stage;
        EXPECT_TRUE(stage.scalarRegisters && stage.spilledVectorRegisters && stage.spilledScalarRegisters &&
                    stage.ldsBytes && stage.scratchBytes)
            << stage.stage;
      }
      if (render::methods()[i].isIterative) {  // one shader, which includes the traversal
        EXPECT_EQ(names, std::vector<std::string>{"ray generation"});
        continue;
      }
      // Only the kinds of surface in the pack are compiled.
      const std::vector<std::string> expected = {"ray generation",     "miss: environment",  "miss: shadow",
                                                 "closest hit: paint", "closest hit: metal", "traversal"};
      EXPECT_EQ(names, expected);
    }
  }
}

// The stack of a stage that traces contains the payload of its ray and the values that it needs after the trace. The
// stack of paint contains no spilled registers, which would hide the payload. RADV rounds stacks up to 16 bytes.
TEST_F(GpuModel, StacksGrowWithPayloads) {
  for (const char* family : kFamilies) {
    std::map<std::size_t, std::set<std::uint32_t>> stacks;  // by payload
    for (const PipelineStatistics& s : all(family)) {
      if (render::methodNamed(s.method).isIterative) continue;
      for (const char* stage : {"ray generation", "closest hit: paint", "closest hit: metal"})
        EXPECT_GE(s.groupStackBytes.at(stage), s.payloadBytes) << family << " " << s.method << " " << stage;
      stacks[s.payloadBytes].insert(s.groupStackBytes.at("closest hit: paint"));
    }
    std::uint32_t smaller = 0;
    for (const auto& [payloadBytes, bytes] : stacks) {
      EXPECT_GE(*bytes.begin(), smaller) << family << " " << payloadBytes;
      smaller = *bytes.rbegin();
    }
    EXPECT_LT(*stacks.at(12).rbegin(), *stacks.at(36).begin()) << family;
    EXPECT_LT(*stacks.at(36).rbegin(), *stacks.at(48).begin()) << family;
  }
}

TEST_F(GpuModel, JsonRoundTripIsExact) {
  for (const PipelineStatistics& s : all("navi31")) {
    const json first = toJson(s);
    EXPECT_EQ(first, toJson(statisticsFromJson(json::parse(first.dump()))));
    EXPECT_TRUE(first.at("stages").at(0).at("registers").at("vector").is_number());
    EXPECT_TRUE(first.at("stages").at(0).at("spills").at("scalar").is_number());
  }
}

// MALUS_GPU_MODEL_OUT=FILE writes the golden file with the numbers found, for review.
TEST_F(GpuModel, EqualsTheGoldenNumbers) {
  std::ifstream in(MALUS_GPU_MODEL_GOLDEN);
  ASSERT_TRUE(in) << MALUS_GPU_MODEL_GOLDEN;
  json golden = json::parse(in);
  const std::string key = compilers(all("navi21").front());
  json found;
  for (const char* family : kFamilies)
    for (const PipelineStatistics& s : all(family)) found[family][s.method] = goldenNumbers(s);
  if (const char* file = std::getenv("MALUS_GPU_MODEL_OUT")) {
    json updated = golden;
    updated[key] = found;
    // One line per stage.
    std::string text = "{";
    const char* comma = "\n";
    for (const auto& [compiler, families] : updated.items()) {
      text += fmt::format("{}  {}: {{", std::exchange(comma, ",\n"), json(compiler).dump());
      const char* familyComma = "\n";
      for (const auto& [family, methods] : families.items()) {
        text += fmt::format("{}    {}: {{", std::exchange(familyComma, ",\n"), json(family).dump());
        const char* methodComma = "\n";
        for (const auto& [method, stages] : methods.items()) {
          text += fmt::format("{}      {}: {{", std::exchange(methodComma, ",\n"), json(method).dump());
          const char* stageComma = "\n";
          for (const auto& [stage, row] : stages.items())
            text += fmt::format("{}        {}: {}", std::exchange(stageComma, ",\n"), json(stage).dump(), row.dump());
          text += "\n      }";
        }
        text += "\n    }";
      }
      text += "\n  }";
    }
    std::ofstream(file) << text << "\n}\n";
  }
  if (!golden.contains(key)) {
    fmt::print("no golden numbers for {} in {}; only determinism and ranges are tested\n", key, MALUS_GPU_MODEL_GOLDEN);
    return;
  }
  for (const char* family : kFamilies)
    for (const std::string& method : render::methodNames()) {
      if (!golden.at(key).at(family).contains(method)) {
        fmt::print("no golden numbers for {} on {}; only determinism and ranges are tested\n", method, family);
        continue;
      }
      for (const auto& [stage, row] : found.at(family).at(method).items())
        EXPECT_EQ(row, golden.at(key).at(family).at(method).at(stage)) << family << " " << method << " " << stage;
    }
}

std::string errorMessage(const fs::path& pack, const std::string& family, const std::vector<std::string>& methods,
                         std::uint32_t depth) {
  try {
    gpuModel(pack, family, methods, depth);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(GpuModel, ReportsErrors) {
  for (const char* family : {"", "navi99", "NAVI21", "navi21 --help", "../navi21"})
    EXPECT_NE(errorMessage(path_, family, {"fresnel"}, 4).find("unknown family"), std::string::npos)
        << family << ": " << errorMessage(path_, family, {"fresnel"}, 4);
  EXPECT_NE(errorMessage(path_, "tahiti", {"fresnel"}, 4).find("no ray tracing"), std::string::npos)
      << errorMessage(path_, "tahiti", {"fresnel"}, 4);
  EXPECT_NE(errorMessage("/nowhere/at-all.pack", "navi21", {"fresnel"}, 4).find("/nowhere/at-all.pack"),
            std::string::npos);
  EXPECT_NE(errorMessage(path_, "navi21", {"no-such"}, 4).find("no-such"), std::string::npos);
  EXPECT_TRUE(gpuModel(path_, "navi21", {}, 4).empty());
}

// RADV's recursion limit is 31. Without recursion the ray generation shader contains everything.
TEST_F(GpuModel, MethodsCompileWithoutRecursion) {
  const auto count = [&](std::uint32_t depth) {
    const std::vector<PipelineStatistics> list = gpuModel(path_, "navi21", {"stokes"}, depth);
    EXPECT_EQ(list.size(), 1u);
    return std::count_if(list.front().stages.begin(), list.front().stages.end(),
                         [](const StageStatistics& s) { return s.stage.starts_with("closest hit"); });
  };
  EXPECT_GT(count(29), 0);
  EXPECT_EQ(count(30), 0);
}

// The child process does not inherit the variables that select or change drivers.
TEST_F(GpuModel, IgnoresTheEnvironment) {
  ::setenv("RADV_FORCE_FAMILY", "navi33", 1);
  ::setenv("VK_DRIVER_FILES", "/nowhere.json", 1);
  ::setenv("RADV_PERFTEST", "cswave32", 1);
  const auto list = gpuModel(path_, "navi21", {"stokes"}, kDepth);
  for (const char* name : {"RADV_FORCE_FAMILY", "VK_DRIVER_FILES", "RADV_PERFTEST"}) ::unsetenv(name);
  const auto same = std::find_if(all("navi21").begin(), all("navi21").end(),
                                 [](const PipelineStatistics& s) { return s.method == "stokes"; });
  ASSERT_NE(same, all("navi21").end());
  EXPECT_EQ(listToJson(list), listToJson({*same}));
}

// lavapipe reports no statistics. A driver that does must name all stages.
TEST_F(GpuModel, StatisticsOfThisMachinesDevice) {
  pack::Scene scene = test::emptyScene(4);
  const auto list = deviceStatistics(scene, {"schlick", "stokes"}, 4, "");
  if (list.empty()) return;
  ASSERT_EQ(list.size(), 2u);
  for (const PipelineStatistics& s : list) {
    EXPECT_TRUE(s.family.empty());
    EXPECT_FALSE(s.stages.empty());
    EXPECT_EQ(s.groupStackBytes.size(), stageSources({}).size());
  }
}

}  // namespace
}  // namespace malus::vulkan

// The child of gpuModel() is this program.
int main(int argc, char** argv) {
  if (malus::vulkan::gpuModelMain(argc, argv)) return 0;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

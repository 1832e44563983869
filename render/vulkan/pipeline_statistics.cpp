#include "render/vulkan/pipeline_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/scene/methods.h"
#include "render/scene/render_scene.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/check.h"
#include "render/vulkan/pipeline.h"

namespace malus::vulkan {

namespace {

using Number = std::optional<std::uint64_t>;

// A number's name in JSON (within its object, where it is in one) and in RADV. Other drivers' numbers are in
// `values` alone: under a similar name they may mean something else.
struct Field {
  Number StageStatistics::*member;
  const char* object;
  const char* name;
  const char* radv;
};
const std::array kFields = {
    Field{&StageStatistics::vectorRegisters, "registers", "vector", "VGPRs"},
    Field{&StageStatistics::scalarRegisters, "registers", "scalar", "SGPRs"},
    Field{&StageStatistics::spilledVectorRegisters, "spills", "vector", "Spilled VGPRs"},
    Field{&StageStatistics::spilledScalarRegisters, "spills", "scalar", "Spilled SGPRs"},
    Field{&StageStatistics::ldsBytes, "", "lds", "LDS size"},
    Field{&StageStatistics::codeBytes, "", "codeSize", "Code size"},
    Field{&StageStatistics::scratchBytes, "", "scratch", "Scratch size"},
    Field{&StageStatistics::instructions, "", "instructions", "Instructions"},
    Field{&StageStatistics::latency, "", "latency", "Latency"},
    Field{&StageStatistics::inverseThroughput, "", "inverseThroughput", "Inverse Throughput"},
    Field{&StageStatistics::wavesPerSimd, "", "wavesPerSimd", "Subgroups per SIMD"},
};

void fillFields(StageStatistics& stage) {
  for (const Field& field : kFields)
    if (const auto found = stage.values.find(field.radv); found != stage.values.end())
      stage.*field.member = found->second;
}

// A stage of stageSources() for people: "shaders/stages/paint.rchit" is "closest hit: paint".
std::string stageName(const StageSource& source) {
  const std::string_view path = source.path;
  const std::size_t begin = path.rfind('/') + 1;
  const std::string_view name = path.substr(begin, path.rfind('.') - begin);
  if (source.stage == Stage::raygen) return "ray generation";
  return fmt::format("{}: {}", source.stage == Stage::miss ? "miss" : "closest hit", name);
}

VkShaderStageFlags flagsOf(Stage stage) {
  if (stage == Stage::raygen) return VK_SHADER_STAGE_RAYGEN_BIT_KHR;
  return stage == Stage::miss ? VK_SHADER_STAGE_MISS_BIT_KHR : VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
}

std::uint64_t valueOf(const VkPipelineExecutableStatisticKHR& s) {
  switch (s.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
      return s.value.b32;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
      return s.value.i64 < 0 ? 0 : static_cast<std::uint64_t>(s.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR:
      return s.value.f64 > 0 ? static_cast<std::uint64_t>(std::llround(s.value.f64)) : 0;
    default:
      return s.value.u64;
  }
}

// The executable's statistics by the driver's names. Hashes differ from build to build of a driver and say
// nothing about cost.
std::map<std::string, std::uint64_t> valuesOf(const Device& device, VkPipeline pipeline, std::uint32_t executable) {
  VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
  info.pipeline = pipeline;
  info.executableIndex = executable;
  std::uint32_t count = 0;
  check(device.getPipelineExecutableStatistics(device.get(), &info, &count, nullptr),
        "vkGetPipelineExecutableStatisticsKHR");
  std::vector<VkPipelineExecutableStatisticKHR> list(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
  check(device.getPipelineExecutableStatistics(device.get(), &info, &count, list.data()),
        "vkGetPipelineExecutableStatisticsKHR");
  std::map<std::string, std::uint64_t> values;
  for (const VkPipelineExecutableStatisticKHR& s : list) {
    const std::string name = s.name;
    if (name.find("hash") == std::string::npos && name.find("Hash") == std::string::npos) values[name] = valueOf(s);
  }
  return values;
}

// Drivers name all closest-hit shaders alike, and list them in the order in which the pipeline was given
// them. An executable that is none of the pipeline's shaders, such as the traversal that RADV adds as an
// intersection shader, comes last.
std::vector<StageStatistics> stagesOf(const Device& device, VkPipeline pipeline, const Variant& variant) {
  VkPipelineInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR};
  info.pipeline = pipeline;
  std::uint32_t count = 0;
  check(device.getPipelineExecutableProperties(device.get(), &info, &count, nullptr),
        "vkGetPipelineExecutablePropertiesKHR");
  std::vector<VkPipelineExecutablePropertiesKHR> list(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
  check(device.getPipelineExecutableProperties(device.get(), &info, &count, list.data()),
        "vkGetPipelineExecutablePropertiesKHR");

  const std::vector<StageSource> sources = stageSources(variant);
  std::vector<StageStatistics> stages, others;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    StageStatistics stage;
    stage.values = valuesOf(device, pipeline, i);
    fillFields(stage);
    if (next < sources.size() && list[i].stages == flagsOf(sources[next].stage)) {
      stage.stage = stageName(sources[next]);
      ++next;
      stages.push_back(std::move(stage));
    } else {
      stage.stage = list[i].stages == VK_SHADER_STAGE_INTERSECTION_BIT_KHR ? "traversal" : list[i].name;
      others.push_back(std::move(stage));
    }
  }
  stages.insert(stages.end(), others.begin(), others.end());
  return stages;
}

nlohmann::json jsonOf(const Number& number) { return number ? nlohmann::json(*number) : nlohmann::json(nullptr); }

}  // namespace

std::vector<PipelineStatistics> pipelineStatistics(const Device& device, const pack::Scene& scene,
                                                   const std::vector<std::string>& methods, std::uint32_t depth) {
  // The camera ray and a shadow ray from the last hit come on top of the depth.
  const std::uint32_t limit = device.rayTracing().maxRayRecursionDepth;
  if (limit < 2 || depth > limit - 2)
    throw Error("--depth", fmt::format("device '{}' cannot recurse that deep", device.physical().name),
                fmt::format("at most {}", limit < 2 ? 0 : limit - 2), fmt::format("{}", depth));
  struct Layout {
    const Device& device;
    VkDescriptorSetLayout handle;
    ~Layout() { vkDestroyDescriptorSetLayout(device.get(), handle, nullptr); }
  } const layout{device, createBindingsLayout(device)};

  std::vector<PipelineStatistics> result;
  for (const std::string& method : methods) {
    PipelineStatistics s;
    s.device = device.physical().name;
    s.driver = device.physical().driver;
    s.method = method;
    s.payloadBytes = render::methodNamed(method).payloadBytes;
    render::RenderParameters parameters = render::defaultParameters(scene);
    parameters.depth = depth;
    const Variant variant = variantFor(scene, method, parameters);
    const std::vector<StageSource> sources = stageSources(variant);
    const Pipeline pipeline(device, variant, layout.handle, variant.stackSize > 0 ? 1 : depth + 2,
                            VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR);
    s.stages = stagesOf(device, pipeline.get(), variant);
    for (std::uint32_t group = 0; group < sources.size(); ++group) {
      const StageSource& source = sources[group];
      const VkDeviceSize bytes = device.getRayTracingShaderGroupStackSize(device.get(), pipeline.get(), group,
                                                                          source.stage == Stage::closestHit
                                                                              ? VK_SHADER_GROUP_SHADER_CLOSEST_HIT_KHR
                                                                              : VK_SHADER_GROUP_SHADER_GENERAL_KHR);
      s.groupStackBytes[stageName(source)] = static_cast<std::uint32_t>(bytes);
    }
    result.push_back(std::move(s));
  }
  return result;
}

std::vector<PipelineStatistics> deviceStatistics(const pack::Scene& scene, const std::vector<std::string>& methods,
                                                 std::uint32_t depth, const std::string& wanted) {
  const Instance instance(0);
  const Device device(instance, wanted, true);
  if (!device.hasStatistics()) return {};
  return pipelineStatistics(device, scene, methods, depth);
}

nlohmann::json toJson(const PipelineStatistics& statistics) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageStatistics& s : statistics.stages) {
    nlohmann::json stage = {{"stage", s.stage}, {"values", s.values}};
    for (const Field& field : kFields)
      (*field.object ? stage[field.object][field.name] : stage[field.name]) = jsonOf(s.*field.member);
    stages.push_back(std::move(stage));
  }
  return {{"family", statistics.family},
          {"device", statistics.device},
          {"driver", statistics.driver},
          {"method", statistics.method},
          {"stages", std::move(stages)},
          {"payloadBytes", statistics.payloadBytes},
          {"stackBytes", statistics.groupStackBytes}};
}

PipelineStatistics statisticsFromJson(const nlohmann::json& json) {
  PipelineStatistics result;
  json.at("family").get_to(result.family);
  json.at("device").get_to(result.device);
  json.at("driver").get_to(result.driver);
  json.at("method").get_to(result.method);
  json.at("payloadBytes").get_to(result.payloadBytes);
  json.at("stackBytes").get_to(result.groupStackBytes);
  for (const nlohmann::json& stage : json.at("stages")) {
    StageStatistics& s = result.stages.emplace_back();
    stage.at("stage").get_to(s.stage);
    stage.at("values").get_to(s.values);
    fillFields(s);
  }
  return result;
}

}  // namespace malus::vulkan

#include "render/vulkan/pipeline_statistics.h"

#include <algorithm>
#include <array>
#include <cctype>
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
#include "render/vulkan/tracing_choice.h"
#include "shaders/effects.h"

namespace malus::vulkan {

namespace {

using Number = std::optional<std::uint64_t>;

// A number: its name in JSON, inside `object` unless that is empty, and its name in RADV. Numbers of other drivers are
// only in `values`: a similar name may have another meaning.
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

// "closest hit: paint" for a kind of surface, "miss: shadow" for the stage "shaders/stages/shadow.rmiss".
std::string stageName(const StageSource& source) {
  if (source.stage == Stage::raygen) return "ray generation";
  const std::size_t begin = source.path.rfind('/') + 1;
  std::string name = source.path.substr(begin, source.path.rfind('.') - begin);
  if (source.kind)
    name = std::string_view(shaders::kCompiledEffects[*source.kind].macro).substr(sizeof("MALUS_EFFECT_") - 1);
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  if (source.stage == Stage::anyHit) return fmt::format("any hit: {}", name);
  return fmt::format("{}: {}", source.stage == Stage::miss ? "miss" : "closest hit", name);
}

std::uint64_t toInteger(const VkPipelineExecutableStatisticKHR& s) {
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

// The statistics of an executable by the driver's names. Leaves out hashes, which differ between builds of a driver and
// do not describe cost.
std::map<std::string, std::uint64_t> readValues(const Device& device, VkPipeline pipeline, std::uint32_t executable) {
  VkPipelineExecutableInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR};
  info.pipeline = pipeline;
  info.executableIndex = executable;
  std::uint32_t count = 0;
  check(device.functions().getPipelineExecutableStatistics(device.get(), &info, &count, nullptr),
        "vkGetPipelineExecutableStatisticsKHR");
  std::vector<VkPipelineExecutableStatisticKHR> list(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
  check(device.functions().getPipelineExecutableStatistics(device.get(), &info, &count, list.data()),
        "vkGetPipelineExecutableStatisticsKHR");
  std::map<std::string, std::uint64_t> values;
  for (const VkPipelineExecutableStatisticKHR& s : list) {
    const std::string name = s.name;
    if (name.find("hash") == std::string::npos && name.find("Hash") == std::string::npos) values[name] = toInteger(s);
  }
  return values;
}

// Assigns executables to stages by order: drivers give all closest-hit shaders the same name, and list them in the
// order of the pipeline. Executables without a stage, such as RADV's traversal (an intersection shader), are last.
std::vector<StageStatistics> stageStatistics(const Device& device, VkPipeline pipeline, const Variant& variant) {
  VkPipelineInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR};
  info.pipeline = pipeline;
  std::uint32_t count = 0;
  check(device.functions().getPipelineExecutableProperties(device.get(), &info, &count, nullptr),
        "vkGetPipelineExecutablePropertiesKHR");
  std::vector<VkPipelineExecutablePropertiesKHR> list(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
  check(device.functions().getPipelineExecutableProperties(device.get(), &info, &count, list.data()),
        "vkGetPipelineExecutablePropertiesKHR");

  const std::vector<StageSource> sources = stageSources(variant);
  std::vector<StageStatistics> stages, others;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    StageStatistics stage;
    stage.values = readValues(device, pipeline, i);
    fillFields(stage);
    if (next < sources.size() && list[i].stages == static_cast<VkShaderStageFlags>(shaderStage(sources[next].stage))) {
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

// Bytes of the stack that each shader group keeps across its traces.
std::map<std::string, std::uint32_t> groupStackBytes(const Device& device, VkPipeline pipeline,
                                                     const Variant& variant) {
  std::map<std::string, std::uint32_t> result;
  std::uint32_t group = 0;
  for (const StageSource& source : stageSources(variant)) {
    if (source.stage == Stage::anyHit) continue;  // part of the groups of the closest hits
    const VkShaderGroupShaderKHR shader =
        source.stage == Stage::closestHit ? VK_SHADER_GROUP_SHADER_CLOSEST_HIT_KHR : VK_SHADER_GROUP_SHADER_GENERAL_KHR;
    result[stageName(source)] = static_cast<std::uint32_t>(
        device.functions().getRayTracingShaderGroupStackSize(device.get(), pipeline, group++, shader));
  }
  return result;
}

nlohmann::json numberToJson(const Number& number) { return number ? nlohmann::json(*number) : nlohmann::json(nullptr); }

}  // namespace

std::vector<PipelineStatistics> pipelineStatistics(const Device& device, const pack::Scene& scene,
                                                   const std::vector<std::string>& methods, std::uint32_t depth,
                                                   render::VulkanPath path) {
  const Owned<VkDescriptorSetLayout> layout = createBindingsLayout(device);
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.depth = depth;
  parameters.vulkanPath = path;
  std::vector<PipelineStatistics> result;
  for (const std::string& method : methods) {
    const render::MethodInfo& info = render::methodNamed(method);
    const Variant variant =
        variantFor(scene, method, parameters, chooseTracing(device, info, scene, parameters).tracing);
    const Pipeline pipeline(device, variant, layout.get(), requiredRecursion(variant.tracing, depth),
                            VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR);
    PipelineStatistics& s = result.emplace_back();
    s.device = device.physical().name;
    s.driver = device.physical().driver;
    s.method = method;
    s.payloadBytes = render::payloadBytes(info, vulkanPath(variant.tracing));
    s.stages = stageStatistics(device, pipeline.get(), variant);
    s.groupStackBytes = groupStackBytes(device, pipeline.get(), variant);
  }
  return result;
}

std::vector<PipelineStatistics> deviceStatistics(const pack::Scene& scene, const std::vector<std::string>& methods,
                                                 std::uint32_t depth, const std::string& wanted,
                                                 render::VulkanPath path) {
  const Instance instance(0);
  const Device device(instance, wanted, {.statistics = true});
  if (!device.hasStatistics()) return {};
  return pipelineStatistics(device, scene, methods, depth, path);
}

nlohmann::json toJson(const PipelineStatistics& statistics) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageStatistics& s : statistics.stages) {
    nlohmann::json stage = {{"stage", s.stage}, {"values", s.values}};
    for (const Field& field : kFields)
      (*field.object ? stage[field.object][field.name] : stage[field.name]) = numberToJson(s.*field.member);
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

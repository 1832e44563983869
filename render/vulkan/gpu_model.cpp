#include "render/vulkan/gpu_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <exception>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "bake/pack/reader.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"
#include "render/vulkan/child_process.h"
#include "render/vulkan/device.h"

namespace malus::vulkan {
namespace fs = std::filesystem;

namespace {

constexpr const char* kSubcommand = "gpu-model-child";
constexpr const char* kFamilies = "one that RADV knows, with ray tracing, such as navi21, navi22, navi31 or navi33";

// Variables that choose a driver or a device or that change RADV's compilation. The child does not inherit them.
constexpr std::array<std::string_view, 14> kDropped = {"VK_ICD_FILENAMES",    "VK_DRIVER_FILES",
                                                       "VK_ADD_DRIVER_FILES", "VK_LOADER_LAYERS_DISABLE",
                                                       "VK_INSTANCE_LAYERS",  "MALUS_VALIDATION",
                                                       "MALUS_DEVICE",        "RADV_FORCE_FAMILY",
                                                       "RADV_DEBUG",          "RADV_PERFTEST",
                                                       "RADV_PROFILE_PSTATE", "ACO_DEBUG",
                                                       "AMD_DEBUG",           "MESA_SHADER_CACHE_DISABLE"};

// RADV's manifest in the Vulkan loader's folders; some distributions put the architecture into its name. Empty: none.
fs::path findRadeonDriver() {
  for (const char* folder : {"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"})
    for (const char* name : {"radeon_icd.json", "radeon_icd.x86_64.json", "radeon_icd.aarch64.json"}) {
      std::error_code ignored;
      fs::path path = fs::path(folder) / name;
      if (fs::is_regular_file(path, ignored)) return path;
    }
  return {};
}

std::string lastLine(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  return std::string(text.substr(text.rfind('\n') + 1));  // npos + 1 is 0
}

std::vector<std::string> childEnvironment(const std::string& family, const fs::path& driver) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    if (std::find(kDropped.begin(), kDropped.end(), name) == kDropped.end()) result.emplace_back(text);
  }
  result.push_back("RADV_FORCE_FAMILY=" + family);
  result.push_back("VK_ICD_FILENAMES=" + driver.string());  // loaders before 1.3.207
  result.push_back("VK_DRIVER_FILES=" + driver.string());
  result.emplace_back("VK_LOADER_LAYERS_DISABLE=~implicit~");
  result.emplace_back("MESA_SHADER_CACHE_DISABLE=true");  // statistics only come from a compilation
  return result;
}

// The child's answer: a list of toJson(), or {"error": message}. option: for messages. Throws Error.
std::vector<PipelineStatistics> parseAnswer(const std::string& option, const std::string& text) {
  std::vector<PipelineStatistics> result;
  try {
    const nlohmann::json answer = nlohmann::json::parse(text);
    if (answer.is_object()) {
      const std::string problem = answer.at("error");
      if (problem.find("cannot be used") != std::string::npos)
        throw Error(option, "RADV has no ray tracing for this family", kFamilies);
      throw Error(option, problem);
    }
    for (const nlohmann::json& entry : answer) result.push_back(statisticsFromJson(entry));
  } catch (const nlohmann::json::exception& error) {
    throw Error(option, "the child process printed no statistics", "a list in JSON", error.what());
  }
  return result;
}

// Prints the answer of the child: one line of JSON. Throws Error.
void printStatistics(const fs::path& path, const std::vector<std::string>& methods, std::uint32_t depth) {
  const pack::Pack pack = pack::read(path);
  const Instance instance(0);
  const Device device(instance, "", {.statistics = true});
  if (!device.hasStatistics())
    throw Error("Vulkan", fmt::format("device '{}' reports no statistics of pipelines", device.physical().name),
                "a Mesa driver with VK_KHR_pipeline_executable_properties");
  nlohmann::json answer = nlohmann::json::array();
  for (const PipelineStatistics& s : pipelineStatistics(device, pack.scene, methods, depth))
    answer.push_back(toJson(s));
  fmt::print("\n{}\n", answer.dump());
}

}  // namespace

std::vector<PipelineStatistics> gpuModel(const fs::path& pack, const std::string& family,
                                         const std::vector<std::string>& methods, std::uint32_t depth) {
  const std::string option = fmt::format("--gpu-model {}", family);
  const bool isName = !family.empty() && family.size() < 32 && std::all_of(family.begin(), family.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!isName) throw Error(option, "unknown family", kFamilies);
  for (const std::string& method : methods) render::methodNamed(method);
  const fs::path driver = findRadeonDriver();
  if (driver.empty())
    throw Error(option, "no radeon driver for Vulkan", "Mesa's RADV; install the package mesa-vulkan-drivers");

  std::vector<std::string> arguments = {"malus", kSubcommand, fmt::format("{}", depth), pack.string()};
  arguments.insert(arguments.end(), methods.begin(), methods.end());
  const ChildResult child = runThisProgram(option, std::move(arguments), childEnvironment(family, driver));
  if (child.errors.find("Unknown family") != std::string::npos) throw Error(option, "unknown family", kFamilies);
  if (!child.succeeded)
    throw Error(option, "the child process failed", kFamilies,
                fmt::format("{}; {}", child.status, lastLine(child.errors)));
  std::vector<PipelineStatistics> result = parseAnswer(option, lastLine(child.output));
  for (PipelineStatistics& s : result) s.family = family;
  return result;
}

bool gpuModelMain(int argc, char** argv) {
  if (argc < 4 || std::string_view(argv[1]) != kSubcommand) return false;
  // The driver aborts for an unknown family: leave no core file.
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  try {
    std::uint32_t depth = 0;
    const std::string_view text = argv[2];
    if (std::from_chars(text.data(), text.data() + text.size(), depth).ec != std::errc())
      throw Error(kSubcommand, "invalid depth", "a number", text);
    printStatistics(argv[3], {argv + 4, argv + argc}, depth);
  } catch (const std::exception& error) {
    fmt::print("\n{}\n", nlohmann::json{{"error", error.what()}}.dump());
  }
  std::fflush(stdout);
  return true;
}

}  // namespace malus::vulkan

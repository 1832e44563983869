#include "render/vulkan/gpu_model.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "bake/pack/reader.h"
#include "meshprep/base/error.h"
#include "render/scene/methods.h"
#include "render/vulkan/device.h"

namespace malus::vulkan {
namespace fs = std::filesystem;

namespace {

constexpr const char* kSubcommand = "gpu-model-child";

// Variables that choose the driver and the device or change what RADV compiles. The child gets its own.
constexpr std::array<std::string_view, 14> kDropped = {"VK_ICD_FILENAMES",    "VK_DRIVER_FILES",
                                                       "VK_ADD_DRIVER_FILES", "VK_LOADER_LAYERS_DISABLE",
                                                       "VK_INSTANCE_LAYERS",  "MALUS_VALIDATION",
                                                       "MALUS_DEVICE",        "RADV_FORCE_FAMILY",
                                                       "RADV_DEBUG",          "RADV_PERFTEST",
                                                       "RADV_PROFILE_PSTATE", "ACO_DEBUG",
                                                       "AMD_DEBUG",           "MESA_SHADER_CACHE_DISABLE"};

// The manifest of RADV where the Vulkan loader looks for drivers; some distributions put the architecture
// into its name.
fs::path radeonDriver() {
  for (const char* folder : {"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"})
    for (const char* name : {"radeon_icd.json", "radeon_icd.x86_64.json", "radeon_icd.aarch64.json"}) {
      std::error_code ignored;
      fs::path path = fs::path(folder) / name;
      if (fs::is_regular_file(path, ignored)) return path;
    }
  return {};
}

// A file in memory that takes what the child writes; closed when this ends.
class Capture {
 public:
  explicit Capture(const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error("--gpu-model", "cannot keep what the child says", {}, std::strerror(errno));
  }
  ~Capture() { ::close(descriptor_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const {
    std::string all;
    std::array<char, 65536> part;
    for (ssize_t n; (n = ::pread(descriptor_, part.data(), part.size(), static_cast<off_t>(all.size()))) > 0;)
      all.append(part.data(), static_cast<std::size_t>(n));
    return all;
  }

 private:
  int descriptor_;
};

std::string lastLine(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  return std::string(text.substr(text.rfind('\n') + 1));  // npos + 1 is 0
}

// Runs this program as the child, and waits. Returns its exit status as waitpid tells it.
int runChild(std::vector<std::string> arguments, std::vector<std::string> environment, const Capture& out,
             const Capture& err) {
  std::vector<char*> argv, envp;
  for (std::string& a : arguments) argv.push_back(a.data());
  for (std::string& e : environment) envp.push_back(e.data());
  argv.push_back(nullptr);
  envp.push_back(nullptr);

  struct Actions {
    posix_spawn_file_actions_t list{};
    Actions() { posix_spawn_file_actions_init(&list); }
    ~Actions() { posix_spawn_file_actions_destroy(&list); }
    Actions(const Actions&) = delete;
  } actions;
  posix_spawn_file_actions_adddup2(&actions.list, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions.list, err.descriptor(), STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions.list, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  pid_t child = -1;
  if (const int failed = ::posix_spawn(&child, "/proc/self/exe", &actions.list, nullptr, argv.data(), envp.data()))
    throw Error("--gpu-model", "cannot start a child process", {}, std::strerror(failed));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error("--gpu-model", "lost its child process", {}, std::strerror(errno));
  return status;
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
  result.push_back("VK_LOADER_LAYERS_DISABLE=~implicit~");
  result.push_back("MESA_SHADER_CACHE_DISABLE=true");  // every number is compiled anew
  return result;
}

}  // namespace

std::vector<PipelineStatistics> gpuModel(const fs::path& pack, const std::string& family,
                                         const std::vector<std::string>& methods, std::uint32_t depth) {
  const std::string where = fmt::format("--gpu-model {}", family);
  const char* const kFamilies = "one that RADV knows and that traces rays, such as navi21, navi22, navi31 or navi33";
  const bool plain = !family.empty() && family.size() < 32 && std::all_of(family.begin(), family.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!plain) throw Error(where, "unknown family", kFamilies);
  for (const std::string& method : methods) render::methodNamed(method);
  const fs::path driver = radeonDriver();
  if (driver.empty()) throw Error(where, "no radeon driver", "package mesa-vulkan-drivers");

  std::vector<std::string> arguments = {"malus", kSubcommand, fmt::format("{}", depth), pack.string()};
  arguments.insert(arguments.end(), methods.begin(), methods.end());
  const Capture out("gpu model"), err("gpu model messages");
  const int status = runChild(std::move(arguments), childEnvironment(family, driver), out, err);

  const std::string messages = err.text();
  if (messages.find("Unknown family") != std::string::npos) throw Error(where, "unknown family", kFamilies);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(where, "the child process failed", {},
                fmt::format("{} {}; {}", WIFSIGNALED(status) ? "signal" : "exit code",
                            WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), lastLine(messages)));
  std::vector<PipelineStatistics> result;
  try {
    const nlohmann::json answer = nlohmann::json::parse(lastLine(out.text()));
    if (answer.is_object()) {
      const std::string problem = answer.at("error");
      if (problem.find("no ray tracing") != std::string::npos)
        throw Error(where, "RADV has no ray tracing for this family", kFamilies);
      throw Error(where, problem);
    }
    for (const nlohmann::json& entry : answer) result.push_back(statisticsFromJson(entry));
  } catch (const nlohmann::json::exception& error) {
    throw Error(where, "the child process did not answer", {}, error.what());
  }
  for (PipelineStatistics& s : result) s.family = family;
  return result;
}

void gpuModelChild(const fs::path& pack, const std::vector<std::string>& methods, std::uint32_t depth) {
  const pack::Pack contents = pack::read(pack);
  const Instance instance(0);
  const Device device(instance, "", true);
  if (!device.hasStatistics())
    throw Error("Vulkan", fmt::format("device '{}' tells no statistics", device.physical().name));
  nlohmann::json answer = nlohmann::json::array();
  for (const PipelineStatistics& s : pipelineStatistics(device, contents.scene, methods, depth))
    answer.push_back(toJson(s));
  fmt::print("\n{}\n", answer.dump());
}

bool gpuModelMain(int argc, char** argv) {
  if (argc < 4 || std::string_view(argv[1]) != kSubcommand) return false;
  // An unknown family makes the driver abort: that leaves no core file.
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  // What went wrong is an answer too.
  try {
    std::uint32_t depth = 0;
    const std::string_view text = argv[2];
    if (std::from_chars(text.data(), text.data() + text.size(), depth).ec != std::errc())
      throw Error(kSubcommand, "not a depth", "a number", text);
    gpuModelChild(argv[3], {argv + 4, argv + argc}, depth);
  } catch (const std::exception& error) {
    fmt::print("\n{}\n", nlohmann::json{{"error", error.what()}}.dump());
  }
  std::fflush(stdout);
  return true;
}

}  // namespace malus::vulkan

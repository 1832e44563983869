#include "tests/hard_cases/backends.h"

#include <map>
#include <memory>
#include <tuple>

#include <fmt/format.h>

#include "render/vulkan/glsl_compiler.h"
#include "render/vulkan/variant.h"
#include "shaders/sources.h"
#include "tests/hard_cases/probe_sources.h"
#include "tests/shaders/compute_device.h"

namespace malus::test {

std::vector<std::byte> runOnDevice(bool doublePrecision, std::string_view method, std::string_view in,
                                   std::string_view out, std::string_view call, const std::vector<std::byte>& input,
                                   std::size_t outputBytes, std::size_t count) {
  static const vulkan::Instance instance(0);
  static const ComputeDevice device(instance);
  static std::map<std::tuple<bool, std::string, std::string>, std::vector<std::uint32_t>> compiled;

  std::vector<std::uint32_t>& spirv = compiled[{doublePrecision, std::string(method), std::string(call)}];
  if (spirv.empty()) {
    std::string text = "#version 460\n";
    for (const char* file : {"gpu/language.glsl", "optics/math.h", "optics/all.h"})
      text += fmt::format("#include \"shaders/{}\"\n", file);
    text += "#include \"tests/hard_cases/probes.h\"\n";
    if (!method.empty()) text += "#include \"shaders/methods/selected.h\"\n";
    // The probes that read the buffer come after it.
    std::string rest;
    const auto include = [&](std::string_view file) {
      rest += fmt::format("#include \"tests/hard_cases/{}\"\n", file);
    };
    if (call.starts_with("iterative")) include("iterative_probe.h");
    if (call.starts_with("chain")) include("chain_probe.h");
    if (call.starts_with("handOver")) include("hand_over_probe.h");
    text += fmt::format(
        "layout(local_size_x = 64) in;\n"
        "layout(set = 0, binding = 0, scalar) readonly buffer Input {{ {} given[]; }};\n"
        "#define GIVEN_PARAMETER(T) uint at\n#define GIVEN given[at]\n{}"
        "layout(set = 0, binding = 1, scalar) writeonly buffer Output {{ {} values[]; }};\n"
        "void main() {{ uint at = gl_GlobalInvocationID.x; if (at < given.length()) values[at] = {}; }}\n",
        in, rest, out, call);
    const std::string preamble = fmt::format(
        "#extension GL_EXT_scalar_block_layout : require\n#extension GL_GOOGLE_include_directive : require\n{}"
        "",
        doublePrecision ? "#define MALUS_DOUBLE\n" : "");
    vulkan::Variant variant;
    variant.method = method;
    spirv = vulkan::compileGlsl(text, preamble, vulkan::Stage::compute, call, [&](std::string_view path) {
      constexpr std::string_view kOwn = "tests/hard_cases/";
      if (path.starts_with(kOwn)) return probeSource(path.substr(kOwn.size()));
      return vulkan::includedSource(variant, path);
    });
  }
  return device.run(spirv, input, outputBytes, static_cast<std::uint32_t>((count + 63) / 64));
}

}  // namespace malus::test

#include "render/vulkan/glsl_compiler.h"

#include <mutex>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "meshprep/base/error.h"
#include "render/vulkan/dead_code.h"

namespace malus::vulkan {

namespace {

constexpr const char* kReport = "valid GLSL; this is an error in malus or in a method that was added to it";

EShLanguage shaderLanguage(Stage stage) {
  switch (stage) {
    case Stage::raygen:
      return EShLangRayGen;
    case Stage::miss:
      return EShLangMiss;
    case Stage::closestHit:
      return EShLangClosestHit;
    case Stage::anyHit:
      return EShLangAnyHit;
    case Stage::compute:
      return EShLangCompute;
  }
  return EShLangCompute;
}

// Includes by their paths in the repository.
class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(const Include& include) : include_(include) {}
  IncludeResult* includeLocal(const char* path, const char*, std::size_t) override {
    const std::string_view text = include_(path);
    if (text.empty()) return nullptr;
    return new IncludeResult(path, text.data(), text.size(), nullptr);
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  const Include& include_;
};

}  // namespace

std::string glslangVersion() {
  const glslang::Version version = glslang::GetVersion();
  return fmt::format("glslang {}.{}.{}", version.major, version.minor, version.patch);
}

std::vector<std::uint32_t> compileGlsl(const std::string& text, const std::string& preamble, Stage stage,
                                       std::string_view name, const Include& include) {
  static std::once_flag initialized;
  std::call_once(initialized, [] { glslang::InitializeProcess(); });
  const EShLanguage language = shaderLanguage(stage);
  glslang::TShader shader(language);
  const char* const strings[] = {text.c_str()};
  shader.setStrings(strings, 1);
  shader.setPreamble(preamble.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
  Includer includer(include);
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  if (!shader.parse(GetDefaultResources(), 460, false, kMessages, includer))
    throw Error(name, "the shader does not compile", kReport, shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) throw Error(name, "the shader does not link", kReport, program.getInfoLog());
  std::vector<std::uint32_t> spirv;
  glslang::GlslangToSpv(*program.getIntermediate(language), spirv);
  return withoutDeadCode(spirv);
}

}  // namespace malus::vulkan

#include "render/vulkan/shader_cache.h"

#include <cstring>
#include <filesystem>
#include <set>
#include <span>

#include "render/vulkan/cache_file.h"
#include "render/vulkan/glsl_compiler.h"

namespace malus::vulkan {
namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kSpirvMagic = 0x07230203;

// Appends the text, and each file that it includes, once.
void expand(const Variant& variant, std::string_view text, std::set<std::string>& seen, std::string& out) {
  out += text;
  for (std::size_t at = text.find("#include \""); at != std::string_view::npos; at = text.find("#include \"", at + 1)) {
    const std::size_t begin = at + 10, end = text.find('"', begin);
    const std::string path(text.substr(begin, end - begin));
    if (seen.insert(path).second) expand(variant, includedSource(variant, path), seen, out);
  }
}

// All that affects the compilation.
std::string cacheKey(const Variant& variant, const StageSource& source) {
  std::string all = glslangVersion() + preamble(variant);
  std::set<std::string> seen;
  expand(variant, stageText(source), seen, all);
  return all;
}

// Empty: missing or damaged.
std::vector<std::uint32_t> load(const fs::path& path) {
  const std::vector<std::byte> bytes = loadCacheFile(path);
  if (bytes.size() < 20 || bytes.size() % 4 != 0) return {};  // a SPIR-V header has 5 words
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words.front() == kSpirvMagic ? words : std::vector<std::uint32_t>{};
}

}  // namespace

std::vector<std::uint32_t> cachedSpirv(const Variant& variant, const StageSource& source) {
  const fs::path file = cacheFile("spirv", cacheKey(variant, source), ".spv");
  if (std::vector<std::uint32_t> words = load(file); !words.empty()) return words;
  std::vector<std::uint32_t> words = compileGlsl(stageText(source), preamble(variant), source.stage, source.path,
                                                 [&](std::string_view path) { return includedSource(variant, path); });
  saveCacheFile(file, std::as_bytes(std::span(words)));
  return words;
}

}  // namespace malus::vulkan

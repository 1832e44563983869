#include "render/vulkan/shader_cache.h"

#include <cstring>
#include <filesystem>
#include <set>

#include <xxhash.h>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/cache_folder.h"
#include "meshprep/base/error.h"
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

// File name of a compiled shader: a hash of all that affects the compilation.
std::string cacheFileName(const Variant& variant, const StageSource& source) {
  std::string all = glslangVersion() + preamble(variant);
  std::set<std::string> seen;
  expand(variant, stageText(source), seen, all);
  const XXH128_hash_t hash = XXH3_128bits(all.data(), all.size());
  return fmt::format("{:016x}{:016x}.spv", hash.high64, hash.low64);
}

// A file ends with the hash of its other bytes. Empty: missing or damaged.
std::vector<std::uint32_t> load(const fs::path& path) {
  try {
    const std::vector<std::byte> bytes = readFile(path, std::size_t{1} << 26);
    if (bytes.size() < 28 || bytes.size() % 4 != 0) return {};
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + bytes.size() - 8, 8);
    if (stored != XXH3_64bits(bytes.data(), bytes.size() - 8)) return {};
    std::vector<std::uint32_t> words((bytes.size() - 8) / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words.front() == kSpirvMagic ? words : std::vector<std::uint32_t>{};
  } catch (const Error&) {
    return {};
  }
}

void save(const fs::path& path, const std::vector<std::uint32_t>& words) {
  try {
    fs::create_directories(path.parent_path());
    std::vector<std::byte> bytes(words.size() * 4 + 8);
    std::memcpy(bytes.data(), words.data(), words.size() * 4);
    const std::uint64_t hash = XXH3_64bits(bytes.data(), words.size() * 4);
    std::memcpy(bytes.data() + words.size() * 4, &hash, 8);
    writeFile(path, bytes);
  } catch (const std::exception&) {  // the next run compiles again
  }
}

}  // namespace

std::vector<std::uint32_t> cachedSpirv(const Variant& variant, const StageSource& source) {
  const fs::path folder = cacheFolder("spirv");
  const fs::path file = folder.empty() ? fs::path() : folder / cacheFileName(variant, source);
  if (!file.empty())
    if (std::vector<std::uint32_t> words = load(file); !words.empty()) return words;
  std::vector<std::uint32_t> words = compileGlsl(stageText(source), preamble(variant), source.stage, source.path,
                                                 [&](std::string_view path) { return includedSource(variant, path); });
  if (!file.empty()) save(file, words);
  return words;
}

}  // namespace malus::vulkan

#include "render/vulkan/cache_file.h"

#include <cstdint>
#include <cstring>

#include <xxhash.h>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/cache_folder.h"
#include "meshprep/base/error.h"

namespace malus::vulkan {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHashBytes = sizeof(std::uint64_t);
constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

}  // namespace

fs::path cacheFile(std::string_view folder, std::string_view key, std::string_view extension) {
  const fs::path path = cacheFolder(folder);
  if (path.empty()) return {};
  const XXH128_hash_t hash = XXH3_128bits(key.data(), key.size());
  return path / fmt::format("{:016x}{:016x}{}", hash.high64, hash.low64, extension);
}

// A file ends with the hash of its other bytes.
std::vector<std::byte> loadCacheFile(const fs::path& path) {
  if (path.empty()) return {};
  try {
    std::vector<std::byte> bytes = readFile(path, kMaxBytes);
    if (bytes.size() < kHashBytes) return {};
    const std::size_t size = bytes.size() - kHashBytes;
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + size, kHashBytes);
    if (stored != XXH3_64bits(bytes.data(), size)) return {};
    bytes.resize(size);
    return bytes;
  } catch (const Error&) {
    return {};
  }
}

void saveCacheFile(const fs::path& path, std::span<const std::byte> contents) {
  if (path.empty() || contents.size() > kMaxBytes - kHashBytes) return;
  try {
    fs::create_directories(path.parent_path());
    std::vector<std::byte> bytes(contents.begin(), contents.end());
    const std::uint64_t hash = XXH3_64bits(contents.data(), contents.size());
    bytes.resize(contents.size() + kHashBytes);
    std::memcpy(bytes.data() + contents.size(), &hash, kHashBytes);
    writeFile(path, bytes);
  } catch (const std::exception&) {  // made again by the next run
  }
}

}  // namespace malus::vulkan

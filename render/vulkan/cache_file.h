// Files of the user's cache folder (meshprep/base/cache_folder.h), each with the hash of its contents. A file that is
// missing, damaged or cannot be written is ignored: what it would contain is made again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace malus::vulkan {

// Path of the file for a key in the cache folder `folder`: named by the key's hash. Empty: there is no cache folder.
std::filesystem::path cacheFile(std::string_view folder, std::string_view key, std::string_view extension);

// Contents of a file. Empty: missing or damaged. An empty path is a missing file.
std::vector<std::byte> loadCacheFile(const std::filesystem::path& path);

// Replaces a file at once: a concurrent reader sees the old file or the new one. An empty path is ignored.
void saveCacheFile(const std::filesystem::path& path, std::span<const std::byte> contents);

}  // namespace malus::vulkan

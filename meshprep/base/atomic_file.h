// Whole files, read and written in one go. A file is written beside its final name, flushed to disk and
// renamed: a reader sees the old file or the new one, never half of one.
//
// What a writer that was killed left behind is removed by the next one of the same file (unfinished_files.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace malus {

// Bytes of a regular file. Throws Error: missing, not a regular file, unreadable, larger than maxBytes.
std::vector<std::byte> readFile(const std::filesystem::path& path, std::size_t maxBytes = std::size_t{1} << 33);
std::string readTextFile(const std::filesystem::path& path, std::size_t maxBytes = std::size_t{1} << 33);

// Replaces path by these bytes. Throws Error (unwritable, disk full) and then leaves path as it was.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

// For writers that need a path of their own: calls write(temporary), then renames temporary to path.
// The temporary is there, empty and locked, and has the extension of path: write opens and fills it, and neither
// removes nor replaces it. On any exception the temporary is removed and path is as it was.
void writeBeside(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

// Removes what writeBeside has not finished. Safe in a signal handler that ends the process.
void removeUnfinished() noexcept;

}  // namespace malus

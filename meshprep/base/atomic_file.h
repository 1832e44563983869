// Reading and writing of whole files. A file is written beside its final name, flushed to disk and renamed: a reader
// sees the old file or the new one, never a part of one. A symbolic link is followed: its target is replaced, and the
// link stays. Another hard link of the old file keeps the old contents.
//
// Files that a killed writer left behind are removed by the next writer of the same name (unfinished_files.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace malus {

// Returns the bytes of a regular file. Throws Error if the file is missing, not a regular file, unreadable or larger
// than maxBytes. A file that shrinks while it is read gives the bytes up to its new end.
std::vector<std::byte> readFile(const std::filesystem::path& path, std::size_t maxBytes = std::size_t{1} << 33);
std::string readTextFile(const std::filesystem::path& path, std::size_t maxBytes = std::size_t{1} << 33);

// Replaces the contents of path. Throws Error (no write permission, disk full, missing folder) and then leaves path
// unchanged.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& path, std::string_view text);

// Calls write(temporary) and renames temporary to path, for writers that need a path instead of bytes.
// The temporary exists, is empty and locked, is in the folder of path and has its extension. write must open and fill
// it, and must neither remove nor replace it. If write or the renaming throws, the temporary is removed and path is
// unchanged. Throws Error as writeFile, and everything that write throws. One call at a time per process is removed
// when the process is interrupted (removeUnfinished); concurrent calls are otherwise safe.
void writeBeside(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

// Removes the temporary file of the running writeBeside, if any. Async-signal-safe; call it only if the process ends
// afterwards.
void removeUnfinished() noexcept;

}  // namespace malus

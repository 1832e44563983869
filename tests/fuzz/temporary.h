// Writes the bytes to a temporary file, one per process, for readers that take a path.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

inline std::filesystem::path writeTemporary(const std::uint8_t* data, std::size_t size, const std::string& extension) {
  static const std::filesystem::path kPath =
      std::filesystem::temp_directory_path() / ("malus-fuzz-" + std::to_string(::getpid()) + extension);
  std::error_code ignored;
  std::filesystem::remove(kPath, ignored);  // ext4 flushes a file that is truncated and written again
  std::ofstream(kPath, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return kPath;
}

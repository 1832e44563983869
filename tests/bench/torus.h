// The mesh shared by the mesh benchmarks: a bumpy closed surface without repetitions.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "meshprep/prepare.h"

namespace malus::bench {

// Files that the end of the program removes.
struct TemporaryFiles {
  TemporaryFiles() = default;
  ~TemporaryFiles() {
    std::error_code ignored;
    for (const std::filesystem::path& path : paths) std::filesystem::remove(path, ignored);
  }
  TemporaryFiles(const TemporaryFiles&) = delete;
  TemporaryFiles& operator=(const TemporaryFiles&) = delete;

  std::vector<std::filesystem::path> paths;
};

// Writes an OBJ file of quads with about `triangles` triangles, which lasts as long as the program.
inline std::filesystem::path torusObj(std::int64_t triangles) {
  static TemporaryFiles files;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("malus-bench-{}-{}.obj", ::getpid(), triangles);
  if (std::filesystem::exists(path)) return path;
  files.paths.push_back(path);
  const auto around = static_cast<std::int64_t>(std::sqrt(static_cast<double>(triangles))), across = around / 2;
  std::string text;
  for (std::int64_t i = 0; i < around; ++i)
    for (std::int64_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around),
                   v = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(across);
      const double r = 0.4 + 0.02 * std::sin(7 * u + 3 * v);
      text += fmt::format("v {:.7f} {:.7f} {:.7f}\n", (1 + r * std::cos(v)) * std::cos(u), r * std::sin(v),
                          (1 + r * std::cos(v)) * std::sin(u));
    }
  for (std::int64_t i = 0; i < around; ++i)
    for (std::int64_t j = 0; j < across; ++j) {
      const auto at = [&](std::int64_t a, std::int64_t b) { return (a % around) * across + b % across + 1; };
      text += fmt::format("f {} {} {} {}\n", at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

// Returns the cleaned mesh with normals.
inline prep::Mesh preparedTorus(std::int64_t triangles) {
  prep::Report report;
  return prep::prepare(torusObj(triangles), {}, report);
}

}  // namespace malus::bench

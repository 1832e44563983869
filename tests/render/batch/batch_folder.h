// A temporary folder for batches, and runs of batches in it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "render/batch/batch.h"
#include "tests/render/batch/batch_scene.h"

namespace malus::test {

class BatchFolder : public testing::Test {
 protected:
  BatchFolder() : folder_(std::filesystem::path(testing::TempDir()) / ("malus-batch-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~BatchFolder() override { std::filesystem::remove_all(folder_); }

  static render::Jobs jobs(const std::string& text, std::uint64_t seed = 0) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + "-jobs.jsonl");
    std::ofstream(file) << text;
    return {render::readJobLines(file), seed};
  }
  std::filesystem::path sub(const std::string& name) const {
    std::filesystem::create_directories(folder_ / name);
    return folder_ / name;
  }
  static std::string bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  static std::set<std::string> names(const std::filesystem::path& folder) {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) found.insert(entry.path().filename());
    return found;
  }
  static void expectEqualFolders(const std::filesystem::path& found, const std::filesystem::path& expected) {
    EXPECT_EQ(names(found), names(expected));
    for (const std::string& name : names(expected)) EXPECT_TRUE(bytes(found / name) == bytes(expected / name)) << name;
  }

  std::filesystem::path folder_;
};

}  // namespace malus::test

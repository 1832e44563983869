// The folder that a command writes many files into.
#pragma once

#include <filesystem>

namespace malus::render {

// Created if it is missing, removed again if it stays empty.
class OutputFolder {
 public:
  // Throws Error if path is not a writable folder and cannot become one.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

}  // namespace malus::render

// Refuses command lines that would lose a file. A command registers what it reads and what it writes, and calls check()
// before it writes anything.
//
// Files are compared by identity, not by their names: by device and inode if they exist, so that links, "./", ".." and
// names in another case on such file systems do not matter; else by the folder that exists and the rest of the name.
// Two new files whose names may be equal to the file system are created in a temporary folder beside them to find out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace malus {

class OutputFiles {
 public:
  // A file that the command reads or that belongs to what it reads. It may be missing.
  void addInput(const std::filesystem::path& file);
  // A file that the command writes. option: names it in messages ("--output"). An empty path is ignored.
  void addOutput(const std::filesystem::path& file, std::string_view option);
  // A folder that the command creates or writes into; register its files with addOutput too.
  void addOutputFolder(const std::filesystem::path& folder, std::string_view option);

  // Throws UsageError if an output is an input, if two outputs are one file, or if an output is a device, a pipe, a
  // socket, or a new file in /dev.
  void check() const;

 private:
  struct Output {
    std::filesystem::path file;
    std::string option;
  };
  std::vector<std::filesystem::path> inputs_;
  std::vector<Output> outputs_, folders_;
};

// Returns the file that a write to path changes: follows symbolic links at its end, also one whose target is missing.
std::filesystem::path resolveLinks(const std::filesystem::path& path);

}  // namespace malus

// Files that are being written beside their final name, and what writers that were killed left of them.
//
// A file NAME.EXT is written as `.NAME.HOST-PID-COUNT.part.EXT`, and its writer holds an exclusive flock on it from its
// making to its renaming. The kernel gives a lock up when its holder ends, however that comes about; so a file that can
// be locked has no living writer. A lock may not reach from machine to machine over a network, so files that carry
// another host's name are left alone, and so is everything where locks do not work. A process that was started by a
// writer does not keep the lock: the descriptor is closed on exec.
#pragma once

#include <filesystem>

namespace malus {

// Makes the file that `path` is written as, empty and locked, and removes it again unless it was renamed.
class UnfinishedFile {
 public:
  // Throws Error where the folder cannot be written to.
  explicit UnfinishedFile(const std::filesystem::path& path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

// Removes what killed writers of `path` on this host left behind. Returns how many files that were; what cannot be
// removed is left.
int removeAbandoned(const std::filesystem::path& path) noexcept;

}  // namespace malus

// Temporary files beside the final file, and removal of those that killed writers left behind.
//
// NAME.EXT is written as `.NAME.HOST-PID-COUNT.part.EXT`. Its writer keeps an exclusive flock on it from creation to
// renaming. The kernel releases the lock however the writer ends, so a file that can be locked has no living writer.
// Locks may not reach other machines over a network: files with another host's name are never removed, nor are any
// on file systems without locks. Child processes do not inherit the lock (close on exec).
#pragma once

#include <filesystem>

namespace malus {

// Creates the temporary file of `path`, empty and locked. The destructor removes it, unless it was renamed.
class UnfinishedFile {
 public:
  // Throws Error if the folder is not writable.
  explicit UnfinishedFile(const std::filesystem::path& path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  // Path of the temporary file, in the folder of the final one and with its extension.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // descriptor that owns the lock
};

// Removes temporary files of `path` that killed writers on this host left behind. Returns the number of files removed.
// Files that cannot be listed, locked or removed are left.
int removeAbandoned(const std::filesystem::path& path) noexcept;

}  // namespace malus

#include "meshprep/base/unfinished_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus {
namespace fs = std::filesystem;

namespace {

fs::path parentFolder(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Host name with every separator of the file name replaced.
std::string hostName() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  std::string text = name.data();
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
}

// Parts of the file name before and after PID-COUNT.
std::string namePrefix(const fs::path& path) { return fmt::format(".{}.{}-", path.stem().string(), hostName()); }
std::string nameSuffix(const fs::path& path) { return ".part" + path.extension().string(); }

bool isNumber(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool isTemporaryName(std::string_view name, std::string_view start, std::string_view end) {
  if (name.size() < start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) return false;
  const std::string_view numbers = name.substr(start.size(), name.size() - start.size() - end.size());
  const std::size_t dash = numbers.find('-');
  return dash != std::string_view::npos && isNumber(numbers.substr(0, dash)) && isNumber(numbers.substr(dash + 1));
}

// Returns true if the path still names the open file.
bool refersTo(const fs::path& path, int fd) {
  struct stat opened {
  }, named{};
  return ::fstat(fd, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

// Waits for the lock. Only removeAbandoned can have it at this time, and releases it at once.
void lock(int fd) {
  while (::flock(fd, LOCK_EX) != 0 && errno == EINTR) {
  }
}

}  // namespace

UnfinishedFile::UnfinishedFile(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  while (true) {
    path_ = parentFolder(path) / fmt::format("{}{}-{}{}", namePrefix(path), ::getpid(), counter++, nameSuffix(path));
    lock_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == EEXIST) continue;  // left by an earlier process with this number
    if (lock_ < 0)
      throw Error(path.string(), fmt::format("cannot write: {}", std::strerror(errno)), "a writable folder");
    lock(lock_);
    if (refersTo(path_, lock_)) return;
    ::close(lock_);  // removed as abandoned before it was locked
  }
}

UnfinishedFile::~UnfinishedFile() {
  if (refersTo(path_, lock_)) ::unlink(path_.c_str());
  ::close(lock_);
}

int removeAbandoned(const fs::path& path) noexcept {
  int removed = 0;
  try {
    const std::string start = namePrefix(path), end = nameSuffix(path);
    for (const fs::directory_entry& entry : fs::directory_iterator(parentFolder(path))) {
      if (!isTemporaryName(entry.path().filename().string(), start, end)) continue;
      const int fd = ::open(entry.path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (fd < 0) continue;
      if (::flock(fd, LOCK_EX | LOCK_NB) == 0 && refersTo(entry.path(), fd) && ::unlink(entry.path().c_str()) == 0)
        ++removed;
      ::close(fd);
    }
  } catch (...) {  // the folder cannot be listed: the writer reports it
  }
  return removed;
}

}  // namespace malus

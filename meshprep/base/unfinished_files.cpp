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

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// With nothing in it that the names' own marks could be taken for.
std::string hostName() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  std::string text = name.data();
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
}

// What comes before the numbers of a process, and after them.
std::string startOf(const fs::path& path) { return fmt::format(".{}.{}-", path.stem().string(), hostName()); }
std::string endOf(const fs::path& path) { return ".part" + path.extension().string(); }

bool isNumber(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool isPartOf(std::string_view name, std::string_view start, std::string_view end) {
  if (name.size() < start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) return false;
  const std::string_view numbers = name.substr(start.size(), name.size() - start.size() - end.size());
  const std::size_t dash = numbers.find('-');
  return dash != std::string_view::npos && isNumber(numbers.substr(0, dash)) && isNumber(numbers.substr(dash + 1));
}

// Whether the name still stands for the file that is open.
bool isStill(const fs::path& path, int fd) {
  struct stat opened {
  }, named{};
  return ::fstat(fd, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

// Waits, but never long: who holds such a lock looks at the file and lets go.
void lock(int fd) {
  while (::flock(fd, LOCK_EX) != 0 && errno == EINTR) {
  }
}

}  // namespace

UnfinishedFile::UnfinishedFile(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  while (true) {
    path_ = folderOf(path) / fmt::format("{}{}-{}{}", startOf(path), ::getpid(), counter++, endOf(path));
    lock_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == EEXIST) continue;  // of a process that had this number before
    if (lock_ < 0) throw Error(path.string(), "cannot write", "a writable folder", std::strerror(errno));
    lock(lock_);
    if (isStill(path_, lock_)) return;
    ::close(lock_);  // taken for an abandoned one between making and locking
  }
}

UnfinishedFile::~UnfinishedFile() {
  if (isStill(path_, lock_)) ::unlink(path_.c_str());
  ::close(lock_);
}

int removeAbandoned(const fs::path& path) noexcept {
  int removed = 0;
  try {
    const std::string start = startOf(path), end = endOf(path);
    for (const fs::directory_entry& entry : fs::directory_iterator(folderOf(path))) {
      if (!isPartOf(entry.path().filename().string(), start, end)) continue;
      const int fd = ::open(entry.path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (fd < 0) continue;
      if (::flock(fd, LOCK_EX | LOCK_NB) == 0 && isStill(entry.path(), fd) && ::unlink(entry.path().c_str()) == 0)
        ++removed;
      ::close(fd);
    }
  } catch (...) {  // a folder that cannot be listed: the writer will tell
  }
  return removed;
}

}  // namespace malus

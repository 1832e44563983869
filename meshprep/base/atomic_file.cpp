#include "meshprep/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/output_files.h"
#include "meshprep/base/unfinished_files.h"

namespace malus {
namespace fs = std::filesystem;

namespace {

// Error of the last system call on path: "PATH: ACTION: REASON; expected EXPECTED".
Error systemError(const fs::path& path, std::string_view action, std::string_view expected = {}) {
  return Error(path.string(), fmt::format("{}: {}", action, std::strerror(errno)), expected);
}

// Closes on scope exit.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

void writeAll(int fd, std::span<const std::byte> bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw systemError(path, "cannot write", "free space on the disk");
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void flushToDisk(const fs::path& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0 || ::fsync(file.fd) != 0) throw systemError(path, "cannot write");
}

// Path of the temporary file being written, for the signal handler. The latest writer is registered.
char gUnfinished[4096];
std::atomic<bool> gHasUnfinished{false};

}  // namespace

void removeUnfinished() noexcept {
  if (gHasUnfinished.load()) ::unlink(gUnfinished);
}

std::vector<std::byte> readFile(const fs::path& path, std::size_t maxBytes) {
  // O_NONBLOCK: opening a pipe without a writer would block for ever.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.fd < 0) throw systemError(path, "cannot open", "a readable file");
  struct stat info {};
  if (::fstat(file.fd, &info) != 0) throw systemError(path, "cannot read");
  if (!S_ISREG(info.st_mode))
    throw Error(path.string(), "is not a regular file", "the path of a file, not of a folder, device or pipe");
  const auto size = static_cast<std::size_t>(info.st_size);
  if (size > maxBytes)
    throw Error(path.string(), "file is too large", fmt::format("at most {} bytes", maxBytes),
                fmt::format("{} bytes", size));
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::read(file.fd, bytes.data() + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw systemError(path, "cannot read");
    if (n == 0) break;  // the file shrank while it was read
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

std::string readTextFile(const fs::path& path, std::size_t maxBytes) {
  const std::vector<std::byte> bytes = readFile(path, maxBytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void writeBeside(const fs::path& asked, const std::function<void(const fs::path&)>& write) {
  const fs::path path = resolveLinks(asked);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(path.string(), "cannot write: the folder does not exist", "an existing folder", folder.string());
  if (fs::is_directory(path, ignored)) throw Error(path.string(), "cannot write: is a folder", "the name of a file");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))  // renaming would replace the node
    throw Error(path.string(), "cannot write: is a device, a pipe or a socket", "the name of a file");
  removeAbandoned(path);
  const UnfinishedFile unfinished(path);
  const fs::path& temporary = unfinished.path();
  const bool registered = temporary.native().size() < sizeof gUnfinished;
  if (registered) {
    std::memcpy(gUnfinished, temporary.c_str(), temporary.native().size() + 1);
    gHasUnfinished = true;
  }
  struct Unregister {
    ~Unregister() { gHasUnfinished = false; }
  } unregister;
  write(temporary);
  flushToDisk(temporary);
  std::error_code failed;
  fs::rename(temporary, path, failed);
  if (failed) throw Error(path.string(), fmt::format("cannot write: {}", failed.message()), "a writable folder");
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
  writeBeside(path, [&](const fs::path& temporary) {
    const Descriptor file{::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)};
    if (file.fd < 0) throw systemError(path, "cannot write", "a writable folder");
    writeAll(file.fd, bytes, path);
  });
}

void writeFile(const fs::path& path, std::string_view text) { writeFile(path, std::as_bytes(std::span(text))); }

}  // namespace malus

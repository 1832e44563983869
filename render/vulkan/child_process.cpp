#include "render/vulkan/child_process.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::vulkan {

namespace {

constexpr const char* kRetry = "free memory and process slots; try again";

// A file in memory, closed at the end of its life.
class MemoryFile {
 public:
  MemoryFile(const std::string& option, const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(option, "cannot create a file in memory", kRetry, std::strerror(errno));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const {
    std::string all;
    std::array<char, 65536> part;
    for (ssize_t n; (n = ::pread(descriptor_, part.data(), part.size(), static_cast<off_t>(all.size()))) > 0;)
      all.append(part.data(), static_cast<std::size_t>(n));
    return all;
  }

 private:
  int descriptor_;
};

class FileActions {
 public:
  FileActions(const MemoryFile& output, const MemoryFile& errors) {
    posix_spawn_file_actions_init(&list_);
    posix_spawn_file_actions_adddup2(&list_, output.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&list_, errors.descriptor(), STDERR_FILENO);
    posix_spawn_file_actions_addopen(&list_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&list_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &list_; }

 private:
  posix_spawn_file_actions_t list_{};
};

// The null-terminated array that posix_spawn takes.
std::vector<char*> makePointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

ChildResult runThisProgram(const std::string& option, std::vector<std::string> arguments,
                           std::vector<std::string> environment) {
  const MemoryFile output(option, "output"), errors(option, "errors");
  const FileActions actions(output, errors);
  const std::vector<char*> argv = makePointers(arguments), envp = makePointers(environment);
  pid_t child = -1;
  if (const int failed = ::posix_spawn(&child, "/proc/self/exe", actions.get(), nullptr, argv.data(), envp.data()))
    throw Error(option, "cannot start a child process", kRetry, std::strerror(failed));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw Error(option, "cannot wait for the child process", kRetry, std::strerror(errno));
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0,
          WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                              : fmt::format("exit code {}", WEXITSTATUS(status)),
          output.text(), errors.text()};
}

}  // namespace malus::vulkan

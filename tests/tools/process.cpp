#include "tests/tools/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX: declared by the program

namespace malus::test {

namespace {

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  }
  ~Pipe() { closeEnd(0), closeEnd(1); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void closeEnd(std::size_t which) {
    if (ends[which] >= 0) ::close(ends[which]);
    ends[which] = -1;
  }
};

std::vector<std::string> makeEnvironment(const Start& start) {
  std::vector<std::string> list;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    bool replaced = false;
    for (const auto& [name, value] : start.environment) replaced = replaced || text.starts_with(name + "=");
    if (!replaced) list.emplace_back(text);
  }
  for (const auto& [name, value] : start.environment) list.push_back(name + "=" + value);
  return list;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

Finished run(const std::vector<std::string>& command, const Start& start) {
  using Clock = std::chrono::steady_clock;
  Finished finished;
  Pipe out, err;

  // Start the program with its streams and working folder.
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  if (start.standardOutput.empty())
    posix_spawn_file_actions_adddup2(&actions, out.ends[1], 1);
  else
    posix_spawn_file_actions_addopen(&actions, 1, start.standardOutput.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_adddup2(&actions, err.ends[1], 2);
  if (!start.workingFolder.empty()) posix_spawn_file_actions_addchdir_np(&actions, start.workingFolder.c_str());
  std::vector<std::string> arguments = command, environment = makeEnvironment(start);
  const auto begin = Clock::now();
  pid_t child = -1;
  const int failed = ::posix_spawnp(&child, arguments[0].c_str(), &actions, nullptr, pointers(arguments).data(),
                                    pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + command[0] + ": " + std::strerror(failed));
  out.closeEnd(1), err.closeEnd(1);

  // Read both streams until both end.
  std::array<pollfd, 2> streams{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
  bool signalled = false, killed = false;
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (!killed && std::chrono::duration<double>(Clock::now() - begin).count() > start.timeoutSeconds) {
      ::kill(child, SIGKILL);
      killed = true;
    }
    if (::poll(streams.data(), streams.size(), 100) < 0 && errno != EINTR) break;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t n = ::read(streams[i].fd, buffer.data(), buffer.size());
      if (n > 0)
        (i == 0 ? finished.out : finished.err).append(buffer.data(), static_cast<std::size_t>(n));
      else if (n == 0 || errno != EINTR)
        streams[i].fd = -1;
    }
    if (!signalled && start.sendSignalWhen && start.sendSignalWhen(finished.err)) {
      ::kill(child, start.sendSignal);
      signalled = true;
    }
  }

  // Wait for the exit status.
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  finished.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (WIFEXITED(status)) finished.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) finished.signal = WTERMSIG(status);
  return finished;
}

}  // namespace malus::test

#include "render/report_script.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

#include "meshprep/base/error.h"
#include "meshprep/base/program_folder.h"

extern char** environ;

namespace malus::render {
namespace fs = std::filesystem;

namespace {

constexpr const char* kPython = "/usr/bin/python3";

}  // namespace

void runReportScript(const std::string& script, const std::vector<std::string>& arguments, const std::string& input,
                     const std::string& failure) {
  std::error_code failed;
  const fs::path path = (programFolder() / MALUS_DATA_PATH / "report" / script).lexically_normal();
  if (!fs::exists(path, failed))
    throw Error(path.string(), "the script of the report is missing", "the file that malus installs");
  const std::string text = path.string();
  std::vector<char*> command = {const_cast<char*>(kPython), const_cast<char*>(text.c_str())};
  for (const std::string& argument : arguments) command.push_back(const_cast<char*>(argument.c_str()));
  command.push_back(nullptr);

  // Connect its standard input to a pipe.
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw Error(kPython, "cannot start the script", "a pipe");
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  ::posix_spawn_file_actions_addclose(&actions, ends[0]);
  ::posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const bool started = ::posix_spawn(&child, kPython, &actions, nullptr, command.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  if (started) {
    auto* const before = std::signal(SIGPIPE, SIG_IGN);  // a script that ends early prints the reason
    for (std::size_t at = 0; at < input.size();) {
      const ssize_t wrote = ::write(ends[1], input.data() + at, input.size() - at);
      if (wrote <= 0) break;
      at += static_cast<std::size_t>(wrote);
    }
    std::signal(SIGPIPE, before);
  }
  ::close(ends[1]);
  int status = 0;
  if (!started || ::waitpid(child, &status, 0) < 0)
    throw Error(kPython, "cannot start the script",
                "packages python3, python3-matplotlib, python3-jinja2, python3-openimageio");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(script, failure, "a script without errors; it printed the reason above");
}

}  // namespace malus::render

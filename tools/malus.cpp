// The `malus` command: subcommands of the modules, exit codes.
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "bake/cli.h"
#include "meshprep/base/console.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/base/usage_error.h"
#include "render/compare_images_cli.h"
#include "render/vulkan/gpu_model.h"
#include "tools/command_line.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kDiffer = 3, kInterrupted = 130 };

int fail(const char* message, ExitCode code = kFailed) {
  malus::console::error(message);
  return code;
}

// Reports a failed write to standard output, for example to a full disk. CLI11 flushes its own output.
int finish() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return fail("cannot write to standard output; expected an open file on a disk with free space");
  return kDone;
}

// Opens standard streams that the caller closed, so that no file of the program takes their numbers and receives the
// messages. Writing to them fails and is reported.
void occupyStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) ::_exit(kFailed);
}

// Keeps freed memory for the next step: a mesh is prepared in many steps, each with lists of all of its faces, and the
// kernel would clear the pages of each list again.
void keepFreedMemory() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, 1 << 30);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

int run(int argc, char** argv) {
  malus::CommandLine line;
  try {
    if (!line.run({argv + 1, argv + std::max(argc, 1)})) {
      std::fputs(line.app().help().c_str(), stderr);
      return kUsage;
    }
  } catch (const CLI::Success& asked) {  // --help, --version
    line.app().exit(asked);
  } catch (const CLI::ParseError& error) {
    return fail(line.describe(error).c_str(), kUsage);
  }
  return finish();
}

}  // namespace

int main(int argc, char** argv) {
  occupyStandardStreams();
  keepFreedMemory();
  malus::handleInterrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // makes a write beyond the limit of file sizes fail, as on a full disk
  try {
    if (malus::vulkan::gpuModelMain(argc, argv)) return kDone;  // the child of `compare --gpu-model`
    return run(argc, argv);
  } catch (const malus::bake::PacksDiffer&) {
    return finish() == kDone ? kDiffer : kFailed;
  } catch (const malus::render::ImagesDiffer&) {
    return finish() == kDone ? kDiffer : kFailed;
  } catch (const malus::Interrupted&) {
    malus::console::progressDone();
    return kInterrupted;
  } catch (const malus::UsageError& error) {
    return fail(error.what(), kUsage);
  } catch (const malus::Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail(
        "out of memory; expected a smaller image (--width, --region), fewer threads, or a machine with more memory");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

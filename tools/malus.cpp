// The `malus` command: subcommands of the modules, exit codes.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bake/cli.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"
#include "meshprep/cli.h"
#include "render/cli.h"
#include "render/compare/cli.h"
#include "render/compare_images_cli.h"
#include "render/devices_cli.h"
#include "render/material_cli.h"
#include "render/sweep_cli.h"
#include "render/vulkan/gpu_model.h"
#include "tools/completion.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kDiffer = 3, kInterrupted = 130 };

int fail(const char* message) {
  malus::console::progressDone();
  fmt::print(stderr, "malus: {}\n", message);
  return kFailed;
}

// Reports a failed write to standard output, for example to a full disk. CLI11 flushes its own output.
int finish() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return fail("cannot write to standard output");
  return kDone;
}

int run(int argc, char** argv) {
  CLI::App app{"malus: polarized mirror and glass reflections, with their cost", "malus"};
  app.set_version_flag("--version", "malus " MALUS_VERSION);
  app.require_subcommand(0, 1);
  app.fallthrough();
  app.failure_message(CLI::FailureMessage::simple);
  bool listMethods = false, listEffects = false, listMaterials = false, listDevices = false;
  app.add_flag_callback(
         "-q,--quiet", [] { malus::console::setVerbosity(malus::console::Verbosity::quiet); },
         "Print no progress and no warnings")
      ->trigger_on_parse();
  app.add_flag_callback(
         "-v,--verbose", [] { malus::console::setVerbosity(malus::console::Verbosity::verbose); }, "Print details")
      ->trigger_on_parse();
  app.add_flag("--list-methods", listMethods, "List the rendering methods");
  app.add_flag("--list-effects", listEffects, "List the effects that a scene can need");
  app.add_flag("--list-materials", listMaterials, "List the materials with published n and k");
  app.add_flag("--list-devices", listDevices, "List the Vulkan devices");
  malus::prep::addPrepCommand(app);
  malus::bake::addBakeCommand(app);
  malus::bake::addInfoCommand(app);
  malus::bake::addUnpackCommand(app);
  malus::render::addRenderCommand(app);
  malus::render::addCompareCommand(app);
  malus::render::addCompareImagesCommand(app);
  malus::render::addSweepCommand(app);
  malus::render::addMaterialCommand(app);
  malus::render::addDevicesCommand(app);
  malus::addCompletionCommand(app);
  try {
    app.parse(argc, argv);  // runs the subcommand
    if (listMethods) malus::render::listMethods();
    if (listEffects) malus::bake::listEffects();
    if (listMaterials) malus::bake::listMaterials();
    if (listDevices) malus::render::listDevices();
    if (app.get_subcommands().empty() && !listMethods && !listEffects && !listMaterials && !listDevices) {
      std::fputs(app.help().c_str(), stderr);
      return kUsage;
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? finish() : kUsage;  // 0: --help, --version
  }
  return finish();
}

}  // namespace

int main(int argc, char** argv) {
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
  } catch (const malus::Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

#include "tools/command_line.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bake/cli.h"
#include "bake/scene_file/strict_object.h"
#include "meshprep/base/console.h"
#include "meshprep/base/nearest_name.h"
#include "meshprep/base/text.h"
#include "meshprep/cli.h"
#include "render/batch/cli.h"
#include "render/batch/merge_cli.h"
#include "render/bench/cli.h"
#include "render/cli.h"
#include "render/compare/cli.h"
#include "render/compare_images_cli.h"
#include "render/devices_cli.h"
#include "render/make_renderer.h"
#include "render/material_cli.h"
#include "render/polarization_probe.h"
#include "render/sweep_cli.h"
#include "render/viewer/cli.h"
#include "tools/completion.h"

namespace malus {

namespace {

// Removes a `--` in front of the command: `malus -- info PACK`. CLI11 would take the command for a positional argument.
void removeLeadingMark(std::vector<std::string>& arguments) {
  const auto word = std::find_if(arguments.begin(), arguments.end(),
                                 [](const std::string& a) { return a == "--" || !a.starts_with('-'); });
  if (word != arguments.end() && *word == "--") arguments.erase(word);
}

constexpr std::string_view kProtected = "./-";

// Writes names behind `--` that begin with '-' as "./-name", because CLI11 takes a `--` behind an option with a list of
// values for the end of that list only. Every argument of a command is the name of a file, or of a material.
void protectNamesBehindMark(std::vector<std::string>& arguments) {
  auto argument = std::find(arguments.begin(), arguments.end(), "--");
  if (argument == arguments.end()) return;
  for (++argument; argument != arguments.end(); ++argument)
    if (argument->starts_with('-')) argument->replace(0, 1, kProtected);
}

// In the order that CLI11 takes.
std::vector<std::string> prepared(std::vector<std::string> arguments) {
  removeLeadingMark(arguments);
  protectNamesBehindMark(arguments);
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

bool isVisible(const CLI::Option* option) { return !option->get_group().empty() && !option->get_positional(); }

// Every name that an option can be given by: "--output", "-o".
void appendNames(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options(isVisible)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
}

// The commands that were given, outer ones first: bench, rays.
std::vector<const CLI::App*> givenCommands(const CLI::App& app) {
  std::vector<const CLI::App*> given;
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) given.push_back(at = at->get_subcommands().front());
  return given;
}

// "bench rays"
std::string joinedName(const std::vector<const CLI::App*>& commands) {
  std::string name;
  for (const CLI::App* command : commands) name += (name.empty() ? "" : " ") + command->get_name();
  return name;
}

std::vector<std::string> visibleCommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); }))
    names.push_back(command->get_name());
  return names;
}

// The nearest of the values that a message of CLI11 lists ("--option: value not in {a,b}"), as a clause; else empty.
std::string nearestValueClause(const std::string& message) {
  constexpr std::string_view kNotIn = " not in {", kBefore = ": ";
  const std::size_t end = message.find(kNotIn), last = message.find('}', end);
  const std::size_t begin = message.find(kBefore);
  if (last == std::string::npos || begin >= end) return {};
  std::vector<std::string> values =
      CLI::detail::split(message.substr(end + kNotIn.size(), last - end - kNotIn.size()), ',');
  return nearestClause(message.substr(begin + kBefore.size(), end - begin - kBefore.size()), values);
}

// Text of CLI11, of one line.
std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return printable(text);
}

}  // namespace

CommandLine::CommandLine() : app_("malus: polarized mirror and glass reflections, with their cost", "malus") {
  app_.set_version_flag("--version", "malus " MALUS_VERSION);
  app_.require_subcommand(0, 1);
  app_.fallthrough();
  app_.add_flag_callback(
          "-q,--quiet", [] { console::setVerbosity(console::Verbosity::quiet); },
          "Print no progress and no warnings; packs keep the warnings for 'malus info'")
      ->trigger_on_parse();
  app_.add_flag_callback(
          "-v,--verbose", [] { console::setVerbosity(console::Verbosity::verbose); }, "Print details")
      ->trigger_on_parse();
  app_.add_flag("--list-methods", listsMethods_, "List the rendering methods");
  app_.add_flag("--list-effects", listsEffects_, "List the effects that a scene can need");
  app_.add_flag("--list-materials", listsMaterials_, "List the materials with published n and k");
  app_.add_flag("--list-devices", listsDevices_, "List the Vulkan devices");
  prep::addPrepCommand(app_);
  bake::addBakeCommand(app_, render::probeDepth);
  bake::addInfoCommand(app_, render::probePolarization);
  bake::addUnpackCommand(app_);
  render::addRenderCommand(app_);
  render::addViewCommand(app_);
  render::addCompareCommand(app_);
  render::addBenchCommand(app_);
  render::addCompareImagesCommand(app_);
  render::addSweepCommand(app_);
  render::addBatchCommand(app_);
  render::addMergeCommand(app_);
  render::addMaterialCommand(app_);
  render::addDevicesCommand(app_);
  addCompletionCommand(app_);
}

bool CommandLine::run(std::vector<std::string> arguments) {
  app_.parse(prepared(std::move(arguments)));
  if (listsMethods_) render::listMethods();
  if (listsEffects_) bake::listEffects();
  if (listsMaterials_) bake::listMaterials();
  if (listsDevices_) render::listDevices();
  return !app_.get_subcommands().empty() || listsMethods_ || listsEffects_ || listsMaterials_ || listsDevices_;
}

void CommandLine::parse(std::vector<std::string> arguments) {
  struct Parsed {};
  // Called when everything is parsed, before the command.
  app_.parse_complete_callback([] { throw Parsed{}; });
  try {
    app_.parse(prepared(std::move(arguments)));
  } catch (const Parsed&) {
  }
  app_.parse_complete_callback({});
}

std::string CommandLine::describeUnknown() const {
  const std::vector<const CLI::App*> given = givenCommands(app_);
  const std::vector<std::string> extras = app_.remaining(true);
  if (extras.empty()) return {};
  const std::string prefix = given.empty() ? std::string() : joinedName(given) + ": ";
  const std::vector<std::string> commands = visibleCommands(given.empty() ? app_ : *given.back());
  if (!commands.empty()) {
    // The command is the first word; options in front of it may be unknown too.
    const auto word =
        std::find_if(extras.begin(), extras.end(), [](const std::string& e) { return !e.starts_with('-'); });
    if (word != extras.end())
      return fmt::format("{}unknown command '{}'{}", prefix, *word, nearestClause(*word, commands));
  }
  const auto option = std::find_if(extras.begin(), extras.end(),
                                   [](const std::string& e) { return e.size() > 1 && e[0] == '-' && e != "--"; });
  if (option == extras.end()) {
    const auto behindMark =
        std::find_if(extras.begin(), extras.end(), [](const std::string& e) { return e.starts_with(kProtected); });
    if (behindMark == extras.end()) return fmt::format("{}unexpected argument '{}'", prefix, extras.front());
    return fmt::format("{}unexpected argument '{}' after '--'", prefix, behindMark->substr(kProtected.size() - 1));
  }
  std::vector<std::string> names;
  for (const CLI::App* command : given) appendNames(*command, names);
  appendNames(app_, names);
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("{}unknown option '{}'{}", prefix, name, nearestClause(name, names));
}

std::string CommandLine::describe(const CLI::ParseError& error) const {
  std::string text = describeUnknown();
  const std::string command = joinedName(givenCommands(app_));
  if (text.empty()) text = command.empty() ? error.what() : command + ": " + error.what();
  text += nearestValueClause(error.what());
  return fmt::format("{}; see 'malus{} --help'", oneLine(text), command.empty() ? "" : " " + command);
}

}  // namespace malus

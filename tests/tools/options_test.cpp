// An option that several commands have means the same in each: the same kind of value, the same range, the same help.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

// Names of the commands, from the help of `malus`.
std::set<std::string> commands() {
  const std::string help = malus({"--help"}).out;
  std::set<std::string> names;
  const std::size_t start = help.find("\nSubcommands:");
  if (start == std::string::npos) return names;
  const std::regex line("\n  ([a-z][a-z-]*)");
  for (std::sregex_iterator match(help.begin() + static_cast<std::ptrdiff_t>(start), help.end(), line), end;
       match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

// Each option of a command with its type, range and description, without its default, repetition and exclusions.
std::map<std::string, std::string> options(const std::string& command) {
  constexpr std::size_t kColumn = 30;  // of descriptions; they are on the next line if the option is longer
  std::istringstream help(malus({command, "--help"}).out);
  std::vector<std::string> lines;
  for (std::string line; std::getline(help, line);) lines.push_back(line);
  lines.emplace_back();
  std::map<std::string, std::string> found;
  const std::regex start("  (?:-[A-Za-z],)?(--[a-z0-9-]+)(.*)");
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_match(lines[i], match, start)) continue;
    const bool isLong = lines[i + 1].starts_with(std::string(kColumn, ' '));
    std::string head = match[2], description = isLong ? lines[i + 1].substr(kColumn) : "";
    if (!isLong && lines[i].size() > kColumn) {
      description = lines[i].substr(kColumn);
      head = lines[i]
                 .substr(0, kColumn)
                 .substr(std::min<std::size_t>(kColumn, static_cast<std::size_t>(match.position(2))));
    }
    // Some versions of CLI11 print the default, which may differ, beside the values.
    head = std::regex_replace(
        head, std::regex(" \\[[^\\]]*\\]|,\\.\\.\\.| (\\.\\.\\.|REQUIRED)|=\\S+| (Needs|Excludes):.*| +$"), "");
    found[match[1]] = head + " | " + description;
  }
  return found;
}

TEST(Options, MeanTheSameInEveryCommand) {
  // The kind of output differs; `render` chooses effects, `compare` measures each.
  const std::set<std::string> kOutputs = {"--output", "--json", "--effects"};
  std::map<std::string, std::pair<std::string, std::string>> known;  // option to command and text
  std::size_t shared = 0;
  const std::set<std::string> names = commands();
  EXPECT_TRUE(names.contains("prep") && names.contains("compare-images")) << names.size();
  for (const std::string& command : names)
    for (const auto& [name, text] : options(command)) {
      const auto [first, isNew] = known.emplace(name, std::pair(command, text));
      if (isNew || kOutputs.contains(name)) continue;
      ++shared;
      EXPECT_EQ(text, first->second.second) << command << " and " << first->second.first << ": " << name;
    }
  EXPECT_GE(shared, 20u);
}

// Former names that are options of another command, or were.
TEST(Options, OfTwoMeaningsAreRefused) {
  const struct {
    const char *command, *former, *name;
  } kCases[] = {{"prep", "--max-error", "--position-error"},
                {"bake", "--max-error", "--position-error"},
                {"prep", "--keep-map", "--source-map"},
                {"info", "--tolerance", "--bounce-tolerance"}};
  for (const auto& c : kCases) {
    const Finished finished = malus({c.command, "nothing", c.former, "1"});
    EXPECT_EQ(finished.exitCode, 2) << c.command << " " << c.former;
    EXPECT_NE(finished.err.find(c.name), std::string::npos) << finished.err;
    EXPECT_FALSE(options(c.command).contains(c.former)) << c.command;
    EXPECT_TRUE(options(c.command).contains(c.name)) << c.command;
  }
}

// A wrong value of an option with a fixed set is a usage error that names the nearest value.
TEST(Options, UnknownValuesSuggestTheNearest) {
  const struct {
    std::vector<std::string> arguments;
    const char* nearest;
  } kCases[] = {{{"render", "a.pack", "--method", "stoke"}, "'stokes'"},
                {{"render", "a.pack", "--backend", "embre"}, "'embree'"},
                {{"render", "a.pack", "--embree-path", "scalr"}, "'scalar'"},
                {{"compare", "a.pack", "--backends", "vulcan"}, "'vulkan'"},
                {{"prep", "a.obj", "-o", "a.drc", "--normals", "creese"}, "'crease'"},
                {{"prep", "a.obj", "-o", "a.drc", "--skip", "weld,orientt"}, "'orient'"},
                {{"prep", "a.obj", "-o", "a.drc", "--certify", "glas"}, "'glass'"}};
  for (const auto& c : kCases) {
    const Finished finished = malus(c.arguments);
    EXPECT_EQ(finished.exitCode, 2) << c.arguments[0] << " " << c.arguments.back();
    EXPECT_NE(finished.err.find(std::string("nearest is ") + c.nearest), std::string::npos) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
  const Finished far = malus({"render", "a.pack", "--method", "completely-else"});
  EXPECT_EQ(far.exitCode, 2);
  EXPECT_EQ(far.err.find("nearest"), std::string::npos) << far.err;
}

}  // namespace
}  // namespace malus::test

// Completion for bash: it offers the commands, every option that --help lists, and fixed values.
#include <regex>
#include <set>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

class Completion : public testing::Test {
 protected:
  void SetUp() override {
    const Finished script = malus({"completion", "bash"});
    ASSERT_EQ(script.exitCode, 0) << script.err;
    writeText(folder_ / "malus", script.out);
  }

  // Returns the completions of the last word of a command line.
  std::set<std::string> complete(const std::string& words) const {
    const std::string command = "source \"$1\"; COMP_WORDS=(malus " + words +
                                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _malus; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const Finished finished = run({"bash", "-euc", command, "bash", folder_ / "malus"});
    EXPECT_EQ(finished.exitCode, 0) << finished.err;
    std::istringstream lines(finished.out);
    std::set<std::string> found;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) found.insert(line);
    return found;
  }

  Folder folder_;
};

TEST_F(Completion, OffersEveryOptionOfEveryCommand) {
  const std::set<std::string> commands = complete("''");
  EXPECT_GE(commands.size(), 9u);
  EXPECT_FALSE(commands.contains("completion")) << "hidden";
  for (const std::string& command : commands) {
    const Finished help = malus({command, "--help"});
    ASSERT_EQ(help.exitCode, 0) << command;
    const std::set<std::string> offered = complete(command + " --");
    std::size_t options = 0;
    // Help has one line per option that begins with its names: "  -o,--output TEXT ...".
    const std::regex line("\n  (?:-[A-Za-z],)?(--[a-z0-9-]+)");
    for (std::sregex_iterator match(help.out.begin(), help.out.end(), line), end; match != end; ++match, ++options)
      EXPECT_TRUE(offered.contains((*match)[1])) << command << " " << (*match)[1];
    EXPECT_GE(options, 1u) << help.out;
    EXPECT_TRUE(offered.contains("--verbose")) << command;
  }
}

TEST_F(Completion, OffersMatchingWordsOnly) {
  EXPECT_EQ(complete("rend"), std::set<std::string>{"render"});
  EXPECT_EQ(complete("render --back"), std::set<std::string>{"--backend"});
  EXPECT_EQ(complete("--vers"), std::set<std::string>{"--version"});
}

TEST_F(Completion, OffersNestedCommands) {
  EXPECT_EQ(complete("bench ''"), std::set<std::string>{"rays"});
  EXPECT_EQ(complete("bench rays --rou"), std::set<std::string>{"--rounds"});
}

TEST_F(Completion, OffersFixedValues) {
  EXPECT_EQ(complete("render --backend ''"), (std::set<std::string>{"embree", "reference", "vulkan"}));
  EXPECT_TRUE(complete("render scene.pack --method ''").contains("stokes"));
  EXPECT_EQ(complete("prep --normals ''"), (std::set<std::string>{"authored", "crease", "smoothing"}));
}

TEST_F(Completion, LeavesFileNamesToBash) {
  EXPECT_EQ(complete("render ''"), std::set<std::string>{});
  EXPECT_EQ(complete("render --output ''"), std::set<std::string>{});
}

TEST(CompletionCommand, WrongShells) {
  EXPECT_EQ(malus({"completion"}).exitCode, 2);
  EXPECT_EQ(malus({"completion", "fish"}).exitCode, 2);
}

}  // namespace
}  // namespace malus::test

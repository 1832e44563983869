// The command line of `malus`: exit codes, messages, and the files that remain.
#include <csignal>

#include <nlohmann/json.hpp>

#include "shaders/effects.h"
#include "tests/tools/command.h"

namespace malus::test {
namespace {

using nlohmann::json;

// Returns the commands that `malus --help` lists.
std::vector<std::string> listedCommands(const std::string& help) {
  std::vector<std::string> commands;
  std::istringstream lines(help);
  bool listing = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Subcommands") || line.starts_with("SUBCOMMANDS")) listing = true;
    if (listing && line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
      commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

TEST(Usage, HelpOfEveryCommand) {
  const Finished all = malus({"--help"});
  EXPECT_EQ(all.exitCode, 0);
  EXPECT_EQ(all.err, "");
  const std::vector<std::string> commands = listedCommands(all.out);
  for (const char* command :
       {"prep", "bake", "info", "unpack", "render", "compare", "compare-images", "sweep", "material"})
    EXPECT_NE(std::find(commands.begin(), commands.end(), command), commands.end()) << command << "\n" << all.out;
  for (const std::string& command : commands) {
    const Finished help = malus({command, "--help"});
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    EXPECT_TRUE(contains(help.out, "-h,")) << help.out;
    EXPECT_TRUE(contains(help.out, command)) << help.out;
  }
  const Finished render = malus({"render", "--help"});
  for (const char* option :
       {"--width", "--height", "--depth", "--region", "--threads", "--method", "--backend", "--polarizer", "--device",
        "--samples", "--exposure", "--check-numerics", "--max-error", "--json"})
    EXPECT_TRUE(contains(render.out, option)) << option;
}

TEST(Usage, Version) {
  const Finished version = malus({"--version"});
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_EQ(version.out, "malus " MALUS_VERSION "\n");
}

TEST(Usage, Lists) {
  const Finished methods = malus({"--list-methods"});
  EXPECT_EQ(methods.exitCode, 0);
  for (const char* name : {"schlick", "fresnel", "sp", "stokes"}) EXPECT_TRUE(contains(methods.out, name)) << name;
  const Finished effects = malus({"--list-effects"});
  EXPECT_EQ(effects.exitCode, 0);
  for (const shaders::EffectInfo& e : shaders::kEffects) {
    if (e.name.empty()) continue;
    EXPECT_TRUE(contains(effects.out, e.name, e.description)) << e.name;
  }
  const Finished materials = malus({"--list-materials"});
  EXPECT_EQ(materials.exitCode, 0);
  for (const char* name : {"bk7", "water", "gold", "titanium", "Johnson"})
    EXPECT_TRUE(contains(materials.out, name)) << name;
}

TEST(Usage, WrongArgumentsExitWithTwo) {
  const std::vector<std::vector<std::string>> kWrong = {
      {},
      {"--no-such-option"},
      {"no-such-command"},
      {"bake"},
      {"bake", "scene.json"},
      {"bake", "scene.json", "-o"},
      {"bake", "scene.json", "-o", "a.pack", "--position-bits", "40"},
      {"bake", "scene.json", "-o", "a.pack", "--no-such-option"},
      {"prep", "a.obj"},
      {"prep", "a.obj", "-o", "a.drc", "--crease", "200"},
      {"info"},
      {"render", "a.pack"},
      {"render", "a.pack", "-o", "a.exr", "--method", "magic"},
      {"render", "a.pack", "-o", "a.exr", "--backend", "magic"},
      {"render", "a.pack", "-o", "a.exr", "--width", "0"},
      {"render", "a.pack", "-o", "a.exr", "--width", "wide"},
      {"render", "a.pack", "-o", "a.exr", "--depth", "256"},
      {"render", "a.pack", "-o", "a.exr", "--region", "1", "2", "3"},
      {"render", "a.pack", "-o", "a.exr", "--polarizer", "nan"},
      {"render", "a.pack", "-o", "a.exr", "--polarizer", "inf"},
      {"render", "a.pack", "-o", "a.exr", "--exposure", "nan"},
      {"compare-images", "a.exr"},
      {"compare-images", "a.exr", "b.exr", "--threshold", "nan"},
      {"compare-images", "a.exr", "b.exr", "--fail-over", "-1"},
  };
  for (const std::vector<std::string>& arguments : kWrong) {
    const Finished finished = malus(arguments);
    std::string text;
    for (const std::string& argument : arguments) text += argument + " ";
    EXPECT_EQ(finished.exitCode, 2) << text << finished.err;
    EXPECT_EQ(finished.out, "") << text;
    EXPECT_NE(finished.err, "") << text;
  }
}

TEST(Usage, HelpDoesNotLoadOpenImageIO) {
  // The dynamic loader prints the libraries that it loads.
  const Finished finished = malus({"--help"}, {.environment = {{"LD_TRACE_LOADED_OBJECTS", "1"}}});
  EXPECT_TRUE(contains(finished.out, "libc.so")) << finished.out;
  EXPECT_FALSE(contains(finished.out, "OpenImageIO")) << finished.out;
  EXPECT_FALSE(contains(finished.out, "libIlm")) << finished.out;
}

TEST(Usage, FullStandardOutputIsAnError) {
  for (const char* option : {"--list-materials", "--help", "--version"}) {
    const Finished finished = malus({option}, {.standardOutput = "/dev/full"});
    expectRefusal(finished, "standard output");
  }
}

// A tiny scene, baked once for all tests.
class Command : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    input_ = new Folder;
    writeTinyScene(input_->path());
    const Finished baked = malus({"bake", *input_ / "scene.json", "-o", pack()});
    ASSERT_EQ(baked.exitCode, 0) << baked.err;
  }
  static void TearDownTestSuite() {
    delete input_;
    input_ = nullptr;
  }
  static std::string pack() { return *input_ / "tiny.pack"; }
  static const Folder& input() { return *input_; }

  Folder output_;

 private:
  static Folder* input_;
};
Folder* Command::input_ = nullptr;

TEST_F(Command, BakeReportsCounts) {
  const Finished text = malus({"bake", input() / "scene.json", "-o", output_ / "a.pack"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  EXPECT_EQ(text.err, "");  // silent in a pipe
  for (const char* count : {"tiny", "2 meshes", "28 vertices", "14 triangles"})
    EXPECT_TRUE(contains(text.out, count)) << text.out;
  const Finished result = malus({"bake", input() / "scene.json", "-o", output_ / "b.pack", "--json"});
  const json j = json::parse(result.out);
  EXPECT_EQ(j.at("vertices"), 28);
  EXPECT_EQ(j.at("triangles"), 14);
  EXPECT_EQ(j.at("preparation").size(), 2u);
  EXPECT_EQ(readText(output_ / "a.pack"), readText(output_ / "b.pack"));
  EXPECT_EQ(output_.names(), (std::vector<std::string>{"a.pack", "b.pack"}));
}

TEST_F(Command, VerboseAndQuiet) {
  const Finished verbose = malus({"-v", "bake", input() / "scene.json", "-o", output_ / "a.pack"});
  EXPECT_TRUE(contains(verbose.err, "cube")) << verbose.err;
  const Finished after = malus({"bake", "-v", input() / "scene.json", "-o", output_ / "b.pack"});
  EXPECT_TRUE(contains(after.err, "cube")) << after.err;
  const Finished quiet = malus({"-q", "bake", input() / "scene.json", "-o", output_ / "c.pack"});
  EXPECT_EQ(quiet.err, "");
}

TEST_F(Command, InfoReportsAndVerifies) {
  const Finished text = malus({"info", pack(), "--verify"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  const json j = json::parse(malus({"info", pack(), "--json"}).out);
  const std::string sections = std::to_string(j.at("sections").size()) + " sections";
  EXPECT_GE(j.at("sections").size(), 10u);
  for (const std::string& part :
       {std::string("28 vertices"), std::string("14 triangles"), std::string("verified"), sections})
    EXPECT_TRUE(contains(text.out, part)) << text.out;
  for (const char* key :
       {"formatVersion", "name", "vertices", "triangles", "meshes", "materials", "effects", "sections", "provenance"})
    EXPECT_TRUE(j.contains(key)) << key;
}

TEST_F(Command, PrepWritesAMeshAndAReport) {
  const Finished finished =
      malus({"prep", input() / "cube.obj", "-o", output_ / "cube.mesh.drc", "--report", output_ / "report.json"});
  EXPECT_EQ(finished.exitCode, 0) << finished.err;
  EXPECT_EQ(output_.names(), (std::vector<std::string>{"cube.mesh.drc", "report.json"}));
  const json report = json::parse(readText(output_ / "report.json"));
  EXPECT_EQ(report.at("input").at("vertices"), 8);
  EXPECT_EQ(report.at("output").at("triangles"), 12);
}

TEST_F(Command, RenderWritesTheSameFileTwice) {
  for (const char* name : {"a", "b"}) {
    const Finished finished = malus({"render", pack(), "-o", output_ / (std::string(name) + ".exr"), "-o",
                                     output_ / (std::string(name) + ".png"), "--method", "stokes"});
    ASSERT_EQ(finished.exitCode, 0) << finished.err;
    EXPECT_EQ(finished.err, "");
    for (const char* part : {"tiny", "embree", "stokes", "64 x 48", "depth 4"})
      EXPECT_TRUE(contains(finished.out, part)) << finished.out;
  }
  EXPECT_EQ(readText(output_ / "a.exr"), readText(output_ / "b.exr"));
  EXPECT_EQ(readText(output_ / "a.png"), readText(output_ / "b.png"));
  EXPECT_TRUE(readText(output_ / "a.exr").starts_with("v/1\x01"));
  EXPECT_TRUE(readText(output_ / "a.png").starts_with("\x89PNG"));
  EXPECT_EQ(output_.names(), (std::vector<std::string>{"a.exr", "a.png", "b.exr", "b.png"}));
}

TEST_F(Command, RenderReportsJson) {
  const Finished finished = malus(
      {"render", pack(), "-o", output_ / "a.exr", "--json", "--backend", "reference", "--width", "32", "--depth", "2"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const json j = json::parse(finished.out);
  EXPECT_EQ(j.at("renderer"), "reference");
  EXPECT_EQ(j.at("width"), 32);
  EXPECT_EQ(j.at("height"), 24);
  EXPECT_EQ(j.at("depth"), 2);
  EXPECT_GT(j.at("wallMs").get<double>(), 0);
}

TEST_F(Command, CompareImages) {
  const auto render = [&](const char* name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", pack(), "-o", output_ / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(malus(arguments).exitCode, 0);
  };
  render("fresnel.exr", {"--method", "fresnel"});
  render("schlick.exr", {"--method", "schlick"});
  render("small.exr", {"--width", "32"});
  const std::string a = output_ / "fresnel.exr", b = output_ / "schlick.exr";

  const Finished same = malus({"compare-images", a, a, "--fail-over", "0", "--json"});
  EXPECT_EQ(same.exitCode, 0) << same.err;
  const json zero = json::parse(same.out);
  for (const char* key : {"mean", "rms", "max", "p999", "outliers"}) EXPECT_EQ(zero.at(key), 0) << key;
  EXPECT_EQ(zero.at("pixels"), 64 * 48);

  const Finished text = malus({"compare-images", a, b});
  EXPECT_EQ(text.exitCode, 0);  // without --fail-over a difference is a result
  EXPECT_TRUE(contains(text.out, "3072")) << text.out;
  const Finished differ =
      malus({"compare-images", a, b, "--fail-over", "1e-6", "--json", "--difference", output_ / "difference.png"});
  EXPECT_EQ(differ.exitCode, 3);
  EXPECT_EQ(differ.err, "");
  EXPECT_GT(json::parse(differ.out).at("max").get<double>(), 1e-6);
  EXPECT_TRUE(std::filesystem::exists(output_ / "difference.png"));
  EXPECT_EQ(malus({"compare-images", a, b, "--fail-over", "1e6"}).exitCode, 0);

  expectRefusal(malus({"compare-images", a, output_ / "small.exr"}), "size");
  expectRefusal(malus({"compare-images", a, b, "--channels", "S1.R"}), "S1.R");
  expectRefusal(malus({"compare-images", a, b, "--channels", "R,S1.R"}), "channel S1.R");
  EXPECT_EQ(malus({"compare-images", a, b, "--channels", "G,R"}).exitCode, 0);
  expectRefusal(malus({"compare-images", a, output_ / "missing.exr"}), "missing.exr");
  expectRefusal(malus({"compare-images", a, pack()}), "tiny.pack");
  writeText(output_ / "cut.exr", readText(a).substr(0, readText(a).size() / 2));
  expectRefusal(malus({"compare-images", a, output_ / "cut.exr"}), "cut.exr");
}

// Wrong inputs and outputs: exit code 1, one line, no file left behind.
class BadInput : public Command {
 protected:
  // Writes the tiny scene with one text replaced, beside its meshes. Returns the path of scene.json.
  std::string sceneWith(std::string_view from, std::string_view to) {
    writeTinyScene(changed_.path());
    std::string text = readText(changed_ / "scene.json");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    writeText(changed_ / "scene.json", text.replace(at, from.size(), to));
    return changed_ / "scene.json";
  }
  void expectNothingLeft() { EXPECT_EQ(output_.names(), std::vector<std::string>{}); }
  template <class... Keyword>
  void refuseBake(const std::string& scene, const Keyword&... keywords) {
    expectRefusal(malus({"bake", scene, "-o", output_ / "a.pack"}), keywords...);
    expectNothingLeft();
  }
  template <class... Keyword>
  void refusePack(const std::string& file, const Keyword&... keywords) {
    expectRefusal(malus({"info", file}), keywords...);
    expectRefusal(malus({"render", file, "-o", output_ / "a.exr"}), keywords...);
    expectNothingLeft();
  }
  Folder changed_;
};

TEST_F(BadInput, MissingFiles) {
  refuseBake("/nowhere/scene.json", "/nowhere/scene.json", "open");
  refusePack("/nowhere/a.pack", "/nowhere/a.pack", "open");
  expectRefusal(malus({"prep", "/nowhere/a.obj", "-o", output_ / "a.drc"}), "/nowhere/a.obj");
  refuseBake(sceneWith("cube.obj", "none.obj"), "none.obj");
  expectNothingLeft();
}

TEST_F(BadInput, FoldersInsteadOfFiles) {
  const std::string folder = changed_.path();
  refuseBake(folder, folder, "file");
  refusePack(folder, folder, "file");
}

TEST_F(BadInput, WrongFormats) {
  ASSERT_EQ(malus({"render", pack(), "-o", changed_ / "image.png"}).exitCode, 0);
  refusePack(changed_ / "image.png", "image.png", "MALUSPAK");
  refuseBake(changed_ / "image.png", "image.png:1:", "JSON");
  refuseBake(pack(), "tiny.pack:1:", "JSON");
  std::filesystem::copy_file(changed_ / "image.png", changed_ / "image.obj");
  expectRefusal(malus({"prep", changed_ / "image.obj", "-o", output_ / "a.drc"}), "image.obj");
  expectRefusal(malus({"prep", changed_ / "image.png", "-o", output_ / "a.drc"}), "image.png");
  writeText(changed_ / "empty.pack", "");
  refusePack(changed_ / "empty.pack", "empty.pack", "pack");
}

TEST_F(BadInput, DamagedPacks) {
  const std::string good = readText(pack());
  for (const std::size_t size : {std::size_t{20}, std::size_t{100}, good.size() / 2, good.size() - 1}) {
    writeText(changed_ / "cut.pack", good.substr(0, size));
    refusePack(changed_ / "cut.pack", "cut.pack");
  }
  for (const std::size_t at : {std::size_t{9}, std::size_t{50}, good.size() / 2, good.size() - 1}) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    writeText(changed_ / "flipped.pack", flipped);
    refusePack(changed_ / "flipped.pack", "flipped.pack");
  }
}

TEST_F(BadInput, BadMeshes) {
  const auto refuse = [&](const char* name, std::string_view text) {
    const std::string scene = sceneWith("cube.obj", name);
    writeText(changed_ / name, text);
    refuseBake(scene, name);
    expectRefusal(malus({"prep", changed_ / name, "-o", output_ / "a.drc", "--report", output_ / "a.json"}), name);
    expectNothingLeft();
  };
  refuse("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  refuse("faceless.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  refuse("outside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  refuse("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  refuse("empty.obj", "");
  refuse("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");
  refuse("huge.off", "OFF\n4000000000 1 0\n0 0 0\n");
  refuse("cut.stl", "solid but not really");
}

TEST_F(BadInput, BadScenes) {
  refuseBake(sceneWith("\"preset\": \"gold\"", "\"preset\": \"golt\""), "scene.json", "materials.gold.preset", "'golt'",
             "'gold'");
  refuseBake(sceneWith("\"material\": \"gold\"", "\"material\": \"gild\""), "meshes[0].material", "'gild'");
  refuseBake(sceneWith("\"depth\"", "\"dept\""), "scene.json", "depth", "missing");
  refuseBake(sceneWith("\"metal\"", "\"glas\""), "materials.gold.type");
  refuseBake(sceneWith("[64, 48]", "[64, 0]"), "resolution");
  refuseBake(sceneWith("\"radiance\": [0.4, 0.5, 0.6]", "\"image\": \"none.hdr\""), "none.hdr");
}

TEST_F(BadInput, UnwritableOutputs) {
  expectRefusal(malus({"bake", input() / "scene.json", "-o", output_ / "no/such/a.pack"}), "a.pack", "write");
  expectRefusal(malus({"render", pack(), "-o", output_ / "no/such/a.exr"}), "a.exr", "write");
  expectRefusal(malus({"render", pack(), "-o", output_ / "no/such/a.png"}), "a.png", "write");
  expectRefusal(malus({"prep", input() / "cube.obj", "-o", output_ / "no/such/a.drc"}), "a.drc", "write");
  const std::string under = pack() + "/a.pack";  // a file in place of a folder
  expectRefusal(malus({"bake", input() / "scene.json", "-o", under}), "a.pack", "write");
  expectRefusal(malus({"render", pack(), "-o", pack() + "/a.exr"}), "a.exr", "write");
  expectRefusal(malus({"bake", input() / "scene.json", "-o", output_.path()}), "write");
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.jpeg"}), "a.jpeg");
  expectRefusal(malus({"render", pack(), "-o", output_ / "image"}), output_ / "image");
  expectNothingLeft();
}

TEST_F(BadInput, RegionsAndSizesOutOfBounds) {
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.exr", "--region", "60", "0", "5", "1"}), "--region");
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.exr", "--region", "0", "0", "0", "1"}), "--region");
  const std::string scene = sceneWith("[64, 48]", "[1, 16384]");
  ASSERT_EQ(malus({"bake", scene, "-o", changed_ / "tall.pack"}).exitCode, 0);
  expectRefusal(malus({"render", changed_ / "tall.pack", "-o", output_ / "a.exr", "--width", "64"}), "--width",
                "too large");
  expectNothingLeft();
}

TEST_F(BadInput, FullDisk) {
  writeText(changed_ / "old.exr", "what was there");
  expectRefusal(malusWithFileLimit(1, {"bake", input() / "scene.json", "-o", output_ / "a.pack"}), "a.pack", "write");
  expectRefusal(malusWithFileLimit(4, {"render", pack(), "-o", output_ / "a.exr"}), "a.exr", "write");
  expectRefusal(malusWithFileLimit(4, {"render", pack(), "-o", changed_ / "old.exr"}), "old.exr", "write");
  EXPECT_EQ(readText(changed_ / "old.exr"), "what was there");
  expectRefusal(malusWithFileLimit(4, {"render", pack(), "-o", output_ / "a.png", "--width", "256"}), "a.png", "write");
  std::string mesh;
  for (int i = 0; i < 3000; ++i) {
    const std::string x = std::to_string(i % 50), y = std::to_string(i * i % 97), z = std::to_string(i * i * 7 % 1009);
    mesh += "v " + x + ".1 " + y + ".7 " + z + ".3\n";
    if (i >= 2) mesh += "f " + std::to_string(i - 1) + " " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  }
  writeText(changed_ / "large.obj", mesh);
  expectRefusal(malusWithFileLimit(4, {"prep", changed_ / "large.obj", "-o", output_ / "a.drc"}), "a.drc", "write");
  expectNothingLeft();
}

TEST_F(BadInput, NoVulkanDriver) {
  // Both names: the first is the loader's old one.
  const Start start{
      .environment = {{"VK_ICD_FILENAMES", "/nowhere/icd.json"}, {"VK_DRIVER_FILES", "/nowhere/icd.json"}}};
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.exr", "--backend", "vulkan"}, start), "Vulkan");
  expectRefusal(malus({"--list-devices"}, start), "Vulkan");
  expectRefusal(malus({"devices"}, start), "driver");
  expectNothingLeft();
}

TEST_F(BadInput, UnknownVulkanDevice) {
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.exr", "--backend", "vulkan"},
                      {.environment = {{"MALUS_DEVICE", "no-such-device"}}}),
                "no-such-device");
  expectRefusal(malus({"render", pack(), "-o", output_ / "a.exr", "--backend", "vulkan", "--device", "no-such-device"}),
                "no-such-device");
  expectNothingLeft();
}

TEST_F(Command, InterruptedRendersLeaveNoFile) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Start start;
    start.sendSignal = signal;
    start.sendSignalWhen = [](std::string_view err) { return err.find("rendering") != std::string_view::npos; };
    const Finished finished = malus({"-v", "render", pack(), "-o", output_ / "a.exr", "--backend", "reference",
                                     "--width", "1024", "--samples", "64", "--threads", "1"},
                                    start);
    EXPECT_EQ(finished.exitCode, 130) << finished.err << "signal " << finished.signal;
    EXPECT_LT(finished.seconds, 10);
    EXPECT_EQ(output_.names(), std::vector<std::string>{});
  }
}

TEST_F(Command, WorksFromAnyFolder) {
  // Relative paths in a scene in the working folder.
  const Start start{.workingFolder = input().path()};
  const Finished finished = malus({"bake", "scene.json", "-o", output_ / "relative.pack"}, start);
  EXPECT_EQ(finished.exitCode, 0) << finished.err;
  EXPECT_EQ(readText(output_ / "relative.pack"), readText(pack()));
}

}  // namespace
}  // namespace malus::test

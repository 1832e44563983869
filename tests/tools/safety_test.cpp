// Command lines that would overwrite an input, lose an output, misread a number, control the terminal or lose a
// warning.
#include <map>

#include <nlohmann/json.hpp>

#include "tests/tools/command.h"

namespace malus::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A tiny scene and its pack, anew for each test.
class Safety : public testing::Test {
 protected:
  void SetUp() override {
    writeTinyScene(folder_.path());
    ASSERT_EQ(malus({"bake", scene(), "-o", pack()}).exitCode, 0);
    before_ = contents();
  }
  std::string scene() const { return folder_ / "scene.json"; }
  std::string pack() const { return folder_ / "tiny.pack"; }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const std::string& name : folder_.names())
      if (fs::is_regular_file(folder_ / name)) files[name] = readText(folder_ / name);
    return files;
  }
  // Expects exit code 2, one line that names the option, and no change of any file.
  void refuse(const std::vector<std::string>& arguments, std::string_view option) {
    const Finished finished = malus(arguments, {.workingFolder = folder_.path()});
    std::string text;
    for (const std::string& argument : arguments) text += argument + " ";
    EXPECT_EQ(finished.exitCode, 2) << text << finished.err;
    EXPECT_EQ(finished.out, "") << text;
    EXPECT_TRUE(contains(finished.err, option)) << text << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(contents(), before_) << text;
  }
  Folder folder_;
  std::map<std::string, std::string> before_;
};

TEST_F(Safety, OutputsAreNotInputs) {
  fs::create_symlink("scene.json", folder_ / "link");
  fs::create_hard_link(folder_ / "cube.obj", folder_ / "hard");
  before_ = contents();
  for (const char* output : {"./scene.json", "floor.obj", "link", "hard"})
    refuse({"bake", "scene.json", "-o", output}, "--output");
  refuse({"bake", "scene.json", "-o", "cube.obj", "--force"}, "--output");
  refuse({"prep", "cube.obj", "-o", "./cube.obj"}, "--output");
  refuse({"prep", "cube.obj", "-o", "x.drc", "--report", "hard"}, "--report");
  for (const char* option : {"--sensor-raw", "--sensor-mask", "--sensor-stokes"})
    refuse({"render", "tiny.pack", "--method", "stokes", "--sensor", "imx250mzr", option, "tiny.pack"}, option);
  for (const char* option : {"--output-dolp", "--output-aolp", "--mosaic", "-o"})
    refuse({"render", "tiny.pack", "--method", "stokes", option, "tiny.pack"}, option[1] == '-' ? option : "--output");
  fs::create_directories(folder_ / "out/images");
  fs::copy_file(pack(), folder_ / "out/sweep.json");
  fs::create_hard_link(folder_ / "out/sweep.json", folder_ / "out/frame-001.png");
  refuse({"sweep", "out/sweep.json", "-o", "out", "--width", "8"}, "--output");
  fs::remove(folder_ / "out/sweep.json");
  refuse({"sweep", "out/frame-001.png", "-o", "out", "--width", "8"}, "--output");
  fs::copy_file(pack(), folder_ / "out/results.json");
  refuse({"compare", "out/results.json", "-o", "out", "--rounds", "1"}, "--output");
  fs::copy_file(pack(), folder_ / "out/images/a.exr");
  refuse({"compare", "out/images/a.exr", "-o", "out", "--rounds", "1"}, "--output");
  fs::copy_file(pack(), folder_ / "out/scene.json");
  refuse({"unpack", "out/scene.json", "-o", "out"}, "--output");
  EXPECT_EQ(readText(folder_ / "out/scene.json"), readText(pack()));
}

TEST_F(Safety, OutputsAreNotFilesOfTheScene) {
  json document = json::parse(readText(scene()));
  document["materials"]["floor"]["albedoMap"] = {{"image", "wood.exr"}};
  document["materials"]["floor"]["projection"] = {{"u", {1, 0, 0}}, {"v", {0, 0, 1}}};
  document["environment"] = {{"image", "sky.exr"}};
  for (const char* name : {"wood.exr", "sky.exr"})
    ASSERT_EQ(malus({"render", pack(), "-o", folder_ / name, "--width", "8"}).exitCode, 0);
  writeText(folder_ / "parts.obj", "mtllib parts.mtl\nusemtl gold\nv 0 2 0\nv 1 2 0\nv 0 3 0\nf 1 2 3\n");
  writeText(folder_ / "parts.mtl", "newmtl gold\nKd 1 1 1\n");
  document["imports"] = json::array({{{"file", "parts.obj"}}});
  writeText(folder_ / "scene.json", document.dump());
  writeText(folder_ / "floor.obj", "mtllib floor.mtl\n" + readText(folder_ / "floor.obj"));
  writeText(folder_ / "floor.mtl", "newmtl a\n");
  before_ = contents();
  for (const char* output : {"wood.exr", "sky.exr", "parts.obj", "parts.mtl", "floor.mtl"})
    refuse({"bake", "scene.json", "-o", output}, "--output");
}

TEST_F(Safety, OutputsAreDifferentFiles) {
  fs::create_symlink("new.exr", folder_ / "link.exr");
  refuse({"render", "tiny.pack", "-o", "o.exr", "-o", "o.exr"}, "--output");
  refuse({"render", "tiny.pack", "-o", "new.exr", "-o", "link.exr"}, "--output");
  refuse({"prep", "cube.obj", "-o", "x.drc", "--report", folder_ / "x.drc"}, "--report");
}

TEST_F(Safety, OutputsAreNotDevices) {
  for (const char* device : {"/dev/full", "/dev/null", "/dev/stdout", "/dev/sdzz9"}) {
    refuse({"bake", "scene.json", "-o", device}, "--output");
    refuse({"prep", "cube.obj", "-o", device}, "--output");
    refuse({"prep", "cube.obj", "-o", "x.drc", "--report", device}, "--report");
    refuse({"render", "tiny.pack", "-o", device}, "--output");
    refuse({"material", "gold", "--plot", device}, "--plot");
    refuse({"compare-images", "a.png", "a.png", "--difference", device}, "--difference");
  }
  for (const char* command : {"sweep", "unpack", "compare"})
    refuse({command, "tiny.pack", "-o", "/dev/null"}, "--output");
}

TEST_F(Safety, OutputsHaveNames) {
  refuse({"bake", "scene.json", "-o", ""}, "--output");
  refuse({"prep", "cube.obj", "-o", "x.drc", "--report", ""}, "--report");
  refuse({"prep", "cube.obj", "-o", "x.drc", "--source-map", ""}, "--source-map");
  for (const char* option :
       {"--output", "--output-dolp", "--output-aolp", "--mosaic", "--sensor-raw", "--sensor-mask", "--sensor-stokes"})
    refuse({"render", "tiny.pack", option, ""}, option);
  for (const char* command : {"sweep", "unpack", "compare"}) refuse({command, "tiny.pack", "-o", ""}, "--output");
  refuse({"material", "gold", "--plot", ""}, "--plot");
  refuse({"compare-images", "a.png", "a.png", "--difference", ""}, "--difference");
}

TEST_F(Safety, UnpackKeepsFilesOfOthers) {
  fs::create_directories(folder_ / "out/meshes");
  writeText(folder_ / "out/meshes/000.ply", "mine");
  writeText(folder_ / "out/meshes/notes.txt", "mine");
  expectRefusal(malus({"unpack", pack(), "-o", folder_ / "out"}), "000.ply", "unpack");
  fs::remove(folder_ / "out/meshes/000.ply");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(malus({"unpack", pack(), "-o", folder_ / "out"}).exitCode, 0);
  EXPECT_EQ(readText(folder_ / "out/meshes/notes.txt"), "mine");
}

TEST_F(Safety, NumbersAreDecimal) {
  const Finished ten = malus({"render", pack(), "-o", folder_ / "o.exr", "--width", "010", "--height", "+08", "--depth",
                              "002", "--samples", "01", "--exposure", "-.5", "--json"});
  ASSERT_EQ(ten.exitCode, 0) << ten.err;
  const json j = json::parse(ten.out);
  EXPECT_EQ(j.at("width"), 10);
  EXPECT_EQ(j.at("height"), 8);
  EXPECT_EQ(j.at("depth"), 2);
  EXPECT_EQ(json::parse(malus({"info", pack(), "--json", "--bounce-tolerance", "0.5"}).out)
                .at("deepestBounce")
                .at("tolerance"),
            0.5);
}

TEST_F(Safety, OtherNumbersAreRefused) {
  // Every option that takes a number, with a valid command around it.
  const std::vector<std::vector<std::string>> kWhole = {{"render", "tiny.pack", "-o", "o.exr", "--width"},
                                                        {"render", "tiny.pack", "-o", "o.exr", "--height"},
                                                        {"render", "tiny.pack", "-o", "o.exr", "--depth"},
                                                        {"render", "tiny.pack", "-o", "o.exr", "--samples"},
                                                        {"render", "tiny.pack", "-o", "o.exr", "--threads"},
                                                        {"render", "tiny.pack", "--mosaic", "o.png", "--mosaic-bits"},
                                                        {"sweep", "tiny.pack", "-o", "s", "--frames"},
                                                        {"compare", "tiny.pack", "-o", "r", "--rounds"},
                                                        {"compare", "tiny.pack", "-o", "r", "--width"},
                                                        {"compare", "tiny.pack", "-o", "r", "--depth"},
                                                        {"compare-images", "a.png", "a.png", "--max-outliers"},
                                                        {"prep", "cube.obj", "-o", "x.drc", "--position-bits"},
                                                        {"prep", "cube.obj", "-o", "x.drc", "--normal-bits"},
                                                        {"prep", "cube.obj", "-o", "x.drc", "--fill-holes"},
                                                        {"prep", "cube.obj", "-o", "x.drc", "--simplify-triangles"},
                                                        {"bake", "scene.json", "-o", "x.pack", "--position-bits"},
                                                        {"bake", "scene.json", "-o", "x.pack", "--normal-bits"}};
  const std::vector<std::vector<std::string>> kReal = {
      {"render", "tiny.pack", "-o", "o.exr", "--exposure"},
      {"render", "tiny.pack", "-o", "o.exr", "--polarizer"},
      {"render", "tiny.pack", "-o", "o.exr", "--wave-plate"},
      {"render", "tiny.pack", "-o", "o.exr", "--max-error"},
      {"render", "tiny.pack", "-o", "o.exr", "--method", "importance", "--tolerance"},
      {"sweep", "tiny.pack", "-o", "s", "--exposure"},
      {"compare", "tiny.pack", "-o", "r", "--scale"},
      {"compare", "tiny.pack", "-o", "r", "--polarizer"},
      {"compare", "tiny.pack", "-o", "r", "--minutes"},
      {"compare-images", "a.png", "a.png", "--threshold"},
      {"compare-images", "a.png", "a.png", "--fail-over"},
      {"compare-images", "a.png", "a.png", "--gain"},
      {"info", "tiny.pack", "--bounce-tolerance"},
      {"prep", "cube.obj", "-o", "x.drc", "--weld"},
      {"prep", "cube.obj", "-o", "x.drc", "--weld-relative"},
      {"prep", "cube.obj", "-o", "x.drc", "--crease"},
      {"prep", "cube.obj", "-o", "x.drc", "--position-error"},
      {"prep", "cube.obj", "-o", "x.drc", "--normal-error"},
      {"prep", "cube.obj", "-o", "x.drc", "--simplify-error"},
      {"prep", "cube.obj", "-o", "x.drc", "--simplify-normal"},
      {"bake", "scene.json", "-o", "x.pack", "--position-error"},
      {"bake", "scene.json", "-o", "x.pack", "--normal-error"},
      {"material", "--eta"},
      {"material", "--eta", "1.5", "--k"},
      {"material", "--eta", "1.5", "--outside"},
      {"material", "gold", "--wavelength"},
      {"material", "gold", "--angle"}};
  const auto refuseWith = [&](std::vector<std::string> arguments, const std::string& value) {
    const std::string option = arguments.back();
    arguments.push_back(value);
    refuse(arguments, option);
  };
  for (const std::vector<std::string>& arguments : kReal)
    for (const char* value : {"nan", "-nan", "inf", "0x10", "1e400", " 5", "1_000", ""}) refuseWith(arguments, value);
  for (const std::vector<std::string>& arguments : kWhole)
    for (const char* value : {"nan", "0x10", "1e3", "-1", "99999999999999999999"}) refuseWith(arguments, value);
  refuseWith({"render", "tiny.pack", "-o", "o.exr", "--width"}, "4294967297");
}

TEST_F(Safety, SuggestsTheNearest) {
  const auto expectSuggestion = [&](const std::vector<std::string>& arguments, const char* suggestion) {
    refuse(arguments, std::string("'") + suggestion + "'");
  };
  expectSuggestion({"rendr", "tiny.pack"}, "render");
  expectSuggestion({"bkae", "scene.json", "-o", "x.pack"}, "bake");
  expectSuggestion({"render", "tiny.pack", "-o", "o.exr", "--widht", "5"}, "--width");
  expectSuggestion({"bake", "scene.json", "--ouput", "x.pack"}, "--output");  // not "--output is required"
  expectSuggestion({"info", "tiny.pack", "--verfy=1"}, "--verify");
  expectSuggestion({"--list-method"}, "--list-methods");
  expectSuggestion({"info", "tiny.pack", "--quite"}, "--quiet");
  refuse({"info", "tiny.pack", "other.pack"}, "other.pack");
  refuse({"render", "--", "tiny.pack", "-o", "o.exr"}, "after '--'");
}

TEST_F(Safety, DoubleDashEndsTheOptions) {
  fs::rename(pack(), folder_ / "-dash.pack");
  const Start inFolder{.workingFolder = folder_.path()};
  EXPECT_EQ(malus({"info", "--", "-dash.pack"}, inFolder).exitCode, 0);
  EXPECT_EQ(malus({"--", "info", "--", "-dash.pack"}, inFolder).exitCode, 0);
  EXPECT_EQ(malus({"render", "-o", "-dash.exr", "--width", "8", "--", "-dash.pack"}, inFolder).exitCode, 0);
  // Behind an option with a list of values, CLI11 takes the mark for the end of the list.
  EXPECT_EQ(malus({"render", "--width", "8", "-o", "dash.exr", "--", "-dash.pack"}, inFolder).exitCode, 0);
  EXPECT_TRUE(fs::exists(folder_ / "-dash.exr"));
}

// Contains no control character but newline, no bidirectional control and only UTF-8.
bool isHarmless(const std::string& text) {
  for (const char c : text)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f || static_cast<unsigned char>(c) >= 0x80)
      return false;
  return true;
}

TEST_F(Safety, NamesDoNotControlTheTerminal) {
  json document = json::parse(readText(scene()));
  document["title"] = "red \x1b[31m bell \x07 c1 \xc2\x9b bidi \xe2\x80\xae";
  document["meshes"][0]["name"] = "m\x1b[31m\nmalus: warning: \xe2\x80\xae";
  document["materials"]["g\x1b[2J\x7f"] = document["materials"]["gold"];
  document["meshes"][0]["material"] = "g\x1b[2J\x7f";
  writeText(folder_ / "scene.json", document.dump());
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"-v", "bake", scene(), "-o", pack()},
                                             {"bake", scene(), "-o", pack(), "--force"},
                                             {"bake", scene(), "-o", pack()},
                                             {"bake", scene(), "-o", pack(), "--force", "--json"},
                                             {"info", pack()},
                                             {"info", pack(), "--json"},
                                             {"unpack", pack(), "-o", folder_ / "out", "--json"},
                                             {"render", pack(), "-o", folder_ / "a.exr", "--width", "8"}}) {
    const Finished finished = malus(arguments);
    EXPECT_EQ(finished.exitCode, 0) << finished.err;
    EXPECT_TRUE(isHarmless(finished.out)) << finished.out;
    EXPECT_TRUE(isHarmless(finished.err)) << finished.err;
  }
  const std::string info = malus({"info", pack()}).out;
  EXPECT_TRUE(contains(info, "\\x1b[31m", "\\x07", "\\x9b", "\\u{202e}", "m\\x1b[31m\\x0amalus")) << info;
  // Arguments, in every message about them.
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"\x1b[31m"},
                                             {"info", "\x1b[31m"},
                                             {"info", pack(), "--\x1b[31m"},
                                             {"info", "\xff\xe2\x80\xae"},
                                             {"render", pack(), "-o", "a.exr", "--width", "\x1b[31m\n"},
                                             {"render", pack(), "-o", "a.\x1b"},
                                             {"material", "\x1b[31m"}}) {
    const Finished finished = malus(arguments);
    EXPECT_NE(finished.exitCode, 0);
    EXPECT_TRUE(isHarmless(finished.err)) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

// A glTF file with content that is left out: the warning is printed by each bake and by info.
TEST_F(Safety, WarningsAreKeptInThePack) {
  fs::copy_file(fs::path(MALUS_SOURCE_DIR) / "tests/tools/instanced.gltf", folder_ / "instanced.gltf");
  json document = json::parse(readText(scene()));
  document["imports"] = json::array({{{"file", "instanced.gltf"}}});
  writeText(folder_ / "scene.json", document.dump());
  const char* kWarning = "texture coordinates";
  const Finished quiet = malus({"-q", "bake", scene(), "-o", pack()});
  EXPECT_EQ(quiet.exitCode, 0) << quiet.err;
  EXPECT_EQ(quiet.err, "");
  const Finished again = malus({"bake", scene(), "-o", pack()});
  EXPECT_TRUE(contains(again.out, "up to date")) << again.out;
  EXPECT_TRUE(contains(again.err, "warning", kWarning)) << again.err;
  const json upToDate = json::parse(malus({"bake", scene(), "-o", pack(), "--json"}).out);
  EXPECT_EQ(upToDate.at("upToDate"), true);
  EXPECT_GE(upToDate.at("warnings").size(), 1u);
  const Finished forced = malus({"bake", scene(), "-o", pack(), "--force"});
  EXPECT_TRUE(contains(forced.err, "warning", kWarning)) << forced.err;
  EXPECT_TRUE(contains(malus({"info", pack()}).out, "warnings", kWarning));
  EXPECT_EQ(json::parse(malus({"info", pack(), "--json"}).out).at("warnings"), upToDate.at("warnings"));
}

// Without a standard output, the file that is opened first must not receive the messages.
TEST_F(Safety, ClosedStreamsDoNotReachFiles) {
  for (const char* redirection : {">&-", "2>&-", "<&- >&- 2>&-"}) {
    const std::string out = folder_ / "closed.pack";
    std::error_code ignored;
    fs::remove(out, ignored);
    const Finished finished = run(
        {"/bin/sh", "-c", "exec \"$0\" bake \"$1\" -o \"$2\" " + std::string(redirection), MALUS_BINARY, scene(), out});
    EXPECT_EQ(readText(out), readText(pack())) << redirection;
    EXPECT_EQ(finished.exitCode, contains(redirection, " >&-") || redirection[0] == '>' ? 1 : 0) << redirection;
  }
}

// On a terminal of 40 columns a line of progress is shorter, so that it can be erased.
TEST_F(Safety, ProgressFitsTheTerminal) {
  const std::string command =
      "stty cols 40; exec " MALUS_BINARY " bake '" + scene() + "' -o '" + (folder_ / "t.pack") + "' --force";
  const Finished finished = run({"script", "-qec", command, "/dev/null"});
  ASSERT_EQ(finished.exitCode, 0) << finished.err << finished.out;
  // Each step is "\r", the sequence that erases the line, and the text up to the next "\r"; results end with "\r\n".
  std::size_t steps = 0;
  for (std::size_t at = finished.out.find("\r\x1b[K"); at != std::string::npos;) {
    const std::size_t start = at + 4, end = std::min(finished.out.find('\r', start), finished.out.size());
    at = finished.out.find("\r\x1b[K", start);
    if (finished.out[end] == '\0' || finished.out.compare(end, 2, "\r\n") == 0) continue;
    ++steps;
    EXPECT_LT(end - start, 40u) << finished.out.substr(start, end - start);
  }
  EXPECT_GT(steps, 0u) << finished.out;
}

}  // namespace
}  // namespace malus::test

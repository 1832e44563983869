// Scripts: what they change, and errors that name the line.
#include "render/viewer/script.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "render/viewer/orbit_camera.h"
#include "render/viewer/view_command.h"

namespace malus::viewer {
namespace {

const std::vector<pack::Effect> kEffects = {{"metal", true, ""}, {"shadows", true, ""}, {"glass", false, ""}};

ViewState apply(const std::string& text, ViewState state = {}) {
  for (const ScriptLine& line : parseScript(text, "path.txt")) applyLine(line, state, kEffects);
  return state;
}

void expectError(const std::string& text, const std::string& place, const std::string& word) {
  try {
    apply(text);
    ADD_FAILURE() << text;
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(place)) << error.what();
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(ViewScript, ReadsFramesCommandsAndComments) {
  const auto lines = parseScript("# a path\n\n0 method fresnel  # first\n10-29 orbit 1 0.5\n", "path.txt");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].where, "path.txt:3");
  EXPECT_EQ(lines[1].first, 10u);
  EXPECT_EQ(lines[1].last, 29u);
  EXPECT_EQ(lines[1].words, (std::vector<std::string>{"orbit", "1", "0.5"}));
}

TEST(ViewScript, ChangesTheView) {
  ViewState start;
  placeUpright(start.camera, {0, 0, 4}, {0, 0, -1});
  const ViewState state = apply(
      "0 method schlick\n0 method b importance\n0 split 0.25\n0 polarizer 20\n0 turn 5\n0 wave-plate 45 90\n0 show "
      "aolp\n"
      "0 exposure -1.5\n0 depth 3\n0 samples 2\n0 effects metal\n0 against other\n0 orbit 90 0\n0 backend vulkan\n",
      start);
  EXPECT_EQ(state.sides[0].method, "schlick");
  EXPECT_EQ(state.sides[0].backend, render::Backend::vulkan);
  EXPECT_EQ(state.sides[1].method, "importance");
  EXPECT_TRUE(state.isSplit);
  EXPECT_EQ(state.divider, 0.25);
  EXPECT_EQ(state.filter.analyser(), render::behindWavePlate(render::linearPolarizer(25), {45, 90}));
  EXPECT_EQ(state.shown, Quantity::aolp);
  EXPECT_EQ(state.exposureEv, -1.5);
  EXPECT_EQ(state.depth, 3u);
  EXPECT_EQ(state.samples, 2u);
  EXPECT_EQ(state.against, Against::otherSide);
  EXPECT_EQ(effectsOption(state.sides[0].effects, kEffects), "metal");
  EXPECT_NEAR(state.camera.position.x, 4, 1e-12);
  EXPECT_EQ(apply("0 polarizer off\n0 analyser left", state).filter.kind, FilterKind::left);
}

TEST(ViewScript, ErrorsNameTheLine) {
  expectError("x orbit 1 1", "path.txt:1: ", "frame");
  expectError("0\n", "path.txt:1: ", "command");
  expectError("0 wait\n5-2 wait", "path.txt:2: ", "frame");
  expectError("\n0 fly 1 2", "path.txt:2: ", "missing");
  expectError("0 orbit 1 2 3", "path.txt:1: ", "unexpected");
  expectError("0 orbit a 2", "path.txt:1: ", "number");
  expectError("0 dance", "path.txt:1: ", "orbit");  // lists the commands
  expectError("0 method wrong", "path.txt:1: ", "wrong");
  expectError("0 depth 2.5", "path.txt:1: ", "range");
  expectError("0 show heat", "path.txt:1: ", "dolp");
  expectError("0 zoom 0", "path.txt:1: ", "positive");
}

TEST(ViewScript, WrongLinesAreFoundBeforeTheFirstImage) {
  const auto check = [](const std::string& text) { checkScript(parseScript(text, "path.txt"), {}, kEffects); };
  EXPECT_NO_THROW(check("0 wait\n0 save a.png\n9 save ./a.exr\n3 command a.png\n"));
  for (const char* line :
       {"5 save", "5 command", "5 save a.jpg", "5 save a", "5 save no-such-folder/a.png", "5 turn x"})
    EXPECT_THROW(check(std::string("0 wait\n") + line), Error) << line;
}

TEST(ViewState, EffectSwitchesAreTheEffectsOption) {
  EXPECT_EQ(effectsOption({}, kEffects), "auto");
  EXPECT_EQ(effectsOption({{"metal", EffectSwitch::automatic}}, kEffects), "auto");
  EXPECT_EQ(effectsOption({{"metal", EffectSwitch::off}}, kEffects), "shadows");
  EXPECT_EQ(effectsOption({{"glass", EffectSwitch::on}}, kEffects), "metal,shadows,glass");
  for (const std::string option : {"auto", "all", "metal", "metal,shadows"})
    EXPECT_EQ(effectsOption(effectSwitches(option, kEffects), kEffects), option);
}

TEST(ViewCommand, HasEverySettingThatChangesTheImage) {
  ViewState state = apply("0 polarizer 30\n0 wave-plate 10 45\n0 exposure 1.5\n0 depth 3\n0 method importance\n");
  state.camera.position = {0.1, 1.0 / 3, 4};
  const std::string command = renderCommand(state, state.sides[0], {"a b.pack", {}, kEffects}, 640, 360, "o.png");
  for (const char* part :
       {"malus render 'a b.pack' -o 'o.png' ", "--width 640 --height 360", "--method importance --stokes", "--depth 3",
        "--exposure 1.5", "--polarizer 30", "--wave-plate 10,45", "--effects auto", "0.3333333333333333,"})
    EXPECT_NE(command.find(part), std::string::npos) << part << "\n" << command;
}

TEST(ViewCommand, CameraKeysAreInWorldSpace) {
  pack::Camera camera;
  camera.position = {1, 2, 3};
  camera.forward = {0, 0, -1};
  const nlohmann::json keys = cameraKeys(camera, {100, 0, 0});
  EXPECT_EQ(keys["position"], (nlohmann::json{101.0, 2.0, 3.0}));
  EXPECT_EQ(keys["target"], (nlohmann::json{101.0, 2.0, 2.0}));
  EXPECT_EQ(keys["verticalFovDegrees"], camera.verticalFovDegrees);
}

}  // namespace
}  // namespace malus::viewer

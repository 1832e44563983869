#include <fmt/format.h>
#include <imgui.h>

#include "meshprep/base/error.h"
#include "render/viewer/panel.h"
#include "render/viewer/view_command.h"

namespace malus::viewer {

namespace {

void startRecording(Session& session, UiState& ui, Recording what) {
  try {
    ui.recorder.start(what, ui.folder.data(), static_cast<std::uint32_t>(std::max(ui.recordedFrames, 1)),
                      session.state);
  } catch (const Error& error) {
    ui.message = error.what();
  }
}

}  // namespace

void drawFiles(Session& session, UiState& ui) {
  ImGui::InputText("##save", ui.saveFile.data(), ui.saveFile.size());
  ImGui::SameLine();
  if (ImGui::Button("save image")) ui.asksForSave = true;
  if (ImGui::Button("copy the malus render command")) ui.asksForCopy = true;
  ImGui::InputText("##scene", ui.sceneFile.data(), ui.sceneFile.size());
  ImGui::SameLine();
  if (ImGui::Button("save camera")) try {
      saveCamera(ui.sceneFile.data(), session.state.camera, session.pack().scene.origin);
      ui.message = fmt::format("saved the camera in {}", ui.sceneFile.data());
    } catch (const Error& error) {
      ui.message = error.what();
    }
  ImGui::InputText("folder", ui.folder.data(), ui.folder.size());
  ImGui::InputInt("frames", &ui.recordedFrames);
  if (ui.recorder.isRecording()) {
    ImGui::Text("frame %u of %u", ui.recorder.frame() + 1, ui.recorder.frames());
    ImGui::SameLine();
    if (ImGui::Button("stop")) ui.recorder.stop(session.state);
    return;
  }
  if (ImGui::Button("turntable")) startRecording(session, ui, Recording::turntable);
  ImGui::SameLine();
  if (ImGui::Button("polarizer sweep")) startRecording(session, ui, Recording::polarizer);
}

}  // namespace malus::viewer

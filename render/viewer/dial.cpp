#include <cmath>
#include <numbers>

#include <imgui.h>

#include "render/viewer/panel.h"

namespace malus::viewer {

bool drawDial(const char* name, double& degrees, double radius) {
  const auto r = static_cast<float>(radius);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), middle{corner.x + r, corner.y + r};
  ImGui::InvisibleButton(name, {2 * r, 2 * r});
  bool changed = false;
  if (ImGui::IsItemActive()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto x = static_cast<double>(mouse.x - middle.x), y = static_cast<double>(middle.y - mouse.y);
    if (std::hypot(x, y) > 2) {
      const double angle = std::atan2(y, x) * 180 / std::numbers::pi, turned = angle < 0 ? angle + 180 : angle;
      changed = turned != degrees;
      degrees = std::fmod(turned, 180);
    }
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("drag to turn; keys [ and ]; control and wheel");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 rim = ImGui::GetColorU32(ImGuiCol_Text), faint = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  draw.AddCircleFilled(middle, r, ImGui::GetColorU32(ImGuiCol_FrameBg), 48);
  draw.AddCircle(middle, r - 1, rim, 48, 1.5f);
  const double a = degrees * std::numbers::pi / 180;
  const auto dx = static_cast<float>(std::cos(a)), dy = static_cast<float>(-std::sin(a));
  // The lines of a polarizer, along its axis.
  for (const float offset : {-0.6f, -0.3f, 0.3f, 0.6f}) {
    const float half = r * std::sqrt(1 - offset * offset) * 0.9f;
    const ImVec2 at{middle.x - dy * offset * r, middle.y + dx * offset * r};
    draw.AddLine({at.x - dx * half, at.y - dy * half}, {at.x + dx * half, at.y + dy * half}, faint);
  }
  draw.AddLine({middle.x - dx * r, middle.y - dy * r}, {middle.x + dx * r, middle.y + dy * r}, rim, 2);
  return changed;
}

}  // namespace malus::viewer

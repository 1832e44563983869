#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "render/viewer/panel.h"

namespace malus::viewer {

namespace {

// Lines on a dark ground, their left or right end at x.
void drawLabel(const std::string& text, float x, float y, bool toTheLeft, float scale) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = 6 * scale, left = toTheLeft ? x - size.x - 2 * pad : x;
  draw.AddRectFilled({left, y}, {left + size.x + 2 * pad, y + size.y + 2 * pad}, IM_COL32(0, 0, 0, 170), 4 * scale);
  draw.AddText({left + pad, y + pad}, IM_COL32_WHITE, text.c_str());
}

std::string sideText(char name, const PublishedSide& side, const std::optional<SideError>& error) {
  if (side.method.empty()) return fmt::format("{}: waiting", name);
  std::string text = fmt::format("{}: {}\n{:.1f} ms", name, side.method, side.medianMs);
  if (error) text += fmt::format("\nerror {:.2g}, FLIP {:.2g}", error->relRms, error->flip);
  return text;
}

}  // namespace

void drawSides(const Session& session, const UiState& ui, const Published& published,
               const BackgroundState& background) {
  if (!session.state.isSplit) return;
  const auto scale = static_cast<float>(ui.scale);
  const auto width = static_cast<float>(session.width()), height = static_cast<float>(session.height());
  const auto x = static_cast<float>(std::round(session.state.divider * session.width()));
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddLine({x, 0}, {x, height}, IM_COL32(0, 0, 0, 255), 3 * scale);
  draw.AddLine({x, 0}, {x, height}, IM_COL32_WHITE, scale);
  const float grip = 7 * scale;
  draw.AddCircleFilled({x, height / 2}, grip, IM_COL32_WHITE, 24);
  draw.AddCircle({x, height / 2}, grip, IM_COL32(0, 0, 0, 255), 24, 1.5f * scale);
  const float margin = 8 * scale;
  drawLabel(sideText('A', published.sides[0], background.errors[0]), x - margin, margin, true, scale);
  if (x < width) drawLabel(sideText('B', published.sides[1], background.errors[1]), x + margin, margin, false, scale);
}

}  // namespace malus::viewer

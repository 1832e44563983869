#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "render/viewer/panel.h"

namespace malus::viewer {

namespace {

// Text on a dark ground.
struct Label {
  Label(std::string lines, float scale)
      : text(std::move(lines)), pad(6 * scale), size(ImGui::CalcTextSize(text.c_str())) {
    size.x += 2 * pad;
    size.y += 2 * pad;
  }
  void draw(float left, float top) const {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({left, top}, {left + size.x, top + size.y}, IM_COL32(0, 0, 0, 170), pad * 2 / 3);
    list.AddText({left + pad, top + pad}, IM_COL32_WHITE, text.c_str());
  }

  std::string text;
  float pad;
  ImVec2 size;
};

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
  const Label a(sideText('A', published.sides[0], background.errors[0]), scale);
  const Label b(sideText('B', published.sides[1], background.errors[1]), scale);
  // The label of A crosses the divider, above that of B, if the panel leaves no room beside it.
  const float panel = ui.showsPanel ? kPanelWidth * scale : 0;
  const float left = std::max(x - margin - a.size.x, panel + margin);
  a.draw(left, margin);
  if (x < width) b.draw(std::max(x, panel) + margin, left + a.size.x > x ? 2 * margin + a.size.y : margin);
}

}  // namespace malus::viewer

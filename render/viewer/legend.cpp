#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include <glm/vec3.hpp>

#include "render/image/polarization.h"
#include "render/viewer/panel.h"
#include "shaders/optics/language_begin.h"

namespace malus::viewer {

namespace {

namespace display {
using real = float;
using real3 = glm::vec3;
#include "shaders/display/signed_colour.h"
}  // namespace display

ImU32 colour(const std::array<std::uint8_t, 3>& c) { return IM_COL32(c[0], c[1], c[2], 255); }

// Colour of the legend at a share of its length.
ImU32 legendColour(Quantity shown, float share) {
  const auto x = static_cast<double>(share);
  if (shown == Quantity::aolp) return colour(render::aolpColour(std::fmod(x, 1.0) * std::numbers::pi, 1));
  if (shown == Quantity::s1 || shown == Quantity::s2 || shown == Quantity::s3) {
    const glm::vec3 c = display::signedColour(2 * share - 1) * 255.0f;
    return IM_COL32(std::lround(c.x), std::lround(c.y), std::lround(c.z), 255);
  }
  return colour(render::dolpColour(x));
}

struct LegendText {
  std::string title, low, middle, high;
};

// The image that a difference or FLIP is taken to, and the work that it waits for.
std::string comparedWith(const Session& session, const BackgroundState& background) {
  const ViewState& state = session.state;
  const bool isFlip = state.shown == Quantity::flip;
  if (state.comparesSides()) return isFlip && !background.flip ? "the other side: computing" : "the other side";
  if (!background.reference.isComplete())
    return fmt::format("the reference: {:.0f} % rendered",
                       100.0 * background.reference.rows / std::max(session.height(), 1u));
  return isFlip && !background.flip ? "the reference: computing" : "the reference";
}

LegendText legendText(const Session& session, const BackgroundState& background) {
  const ViewState& state = session.state;
  switch (state.shown) {
    case Quantity::dolp:
      return {"DoLP", "0", "0.5", "1"};
    case Quantity::aolp:
      return {"AoLP [degrees], dark: DoLP < 0.05", "0", "90", "180"};
    case Quantity::s1:
      return {"S1 / S0", "-1", "0", "1"};
    case Quantity::s2:
      return {"S2 / S0", "-1", "0", "1"};
    case Quantity::s3:
      return {"S3 / S0", "-1", "0", "1"};
    case Quantity::difference:
      return {fmt::format("difference to {}", comparedWith(session, background)), "0",
              fmt::format("{:.3g}", state.differenceScale / 2), fmt::format("{:.3g}", state.differenceScale)};
    case Quantity::flip:
      return {fmt::format("FLIP to {}", comparedWith(session, background)), "0", "0.5", "1"};
    case Quantity::colour:
      break;
  }
  return {};
}

}  // namespace

void drawLegend(const Session& session, const UiState& ui, const BackgroundState& background) {
  const Quantity shown = session.state.shown;
  if (shown == Quantity::colour) return;
  const LegendText text = legendText(session, background);
  const auto scale = static_cast<float>(ui.scale);
  const float w = std::max(260 * scale, ImGui::CalcTextSize(text.title.c_str()).x), h = 12 * scale,
              line = ImGui::GetFontSize(), margin = 10 * scale;
  const float x = static_cast<float>(session.width()) - w - 2 * margin;
  const float y = static_cast<float>(session.height()) - h - 2 * line - 3 * margin;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({x - margin, y - margin}, {x + w + margin, y + h + 2 * line + 2 * margin}, IM_COL32(0, 0, 0, 180),
                     4 * scale);
  const ImU32 white = IM_COL32_WHITE;
  draw.AddText({x, y}, white, text.title.c_str());
  const float top = y + line + 4 * scale;
  constexpr int kSteps = 90;
  for (int i = 0; i < kSteps; ++i) {
    const float from = x + w * static_cast<float>(i) / kSteps, to = x + w * static_cast<float>(i + 1) / kSteps;
    const ImU32 c = legendColour(shown, (static_cast<float>(i) + 0.5f) / kSteps);
    draw.AddRectFilled({from, top}, {to, top + h}, c);
  }
  const auto label = [&](const std::string& s, float share) {
    const float wide = ImGui::CalcTextSize(s.c_str()).x;
    draw.AddText({x + share * (w - wide), top + h + 2 * scale}, white, s.c_str());
  };
  label(text.low, 0);
  label(text.middle, 0.5f);
  label(text.high, 1);
}

}  // namespace malus::viewer

#include "shaders/optics/language_end.h"

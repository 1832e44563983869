#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <imgui.h>

#include "render/viewer/panel.h"
#include "render/viewer/probe.h"

namespace malus::viewer {

namespace {

// The path of the electric field, as a photographer sees it, in a circle for completely polarized light.
void drawEllipse(const std::array<double, 4>& stokes, float radius) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), middle{corner.x + radius, corner.y + radius};
  ImGui::Dummy({2 * radius, 2 * radius});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddCircle(middle, radius - 1, ImGui::GetColorU32(ImGuiCol_TextDisabled), 48);
  const Ellipse e = ellipse(stokes);
  if (e.degree == 0) return;
  const double a = std::cos(e.ellipticity), b = std::sin(e.ellipticity), size = std::sqrt(e.degree);
  constexpr int kPoints = 64;
  std::array<ImVec2, kPoints> points;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2 * std::numbers::pi * i / kPoints;
    const double u = a * std::cos(t), v = b * std::sin(t);
    const double x = u * std::cos(e.angle) - v * std::sin(e.angle), y = u * std::sin(e.angle) + v * std::cos(e.angle);
    points[static_cast<std::size_t>(i)] = {middle.x + radius * static_cast<float>(size * x),
                                           middle.y - radius * static_cast<float>(size * y)};
  }
  const ImU32 colour = b >= 0 ? IM_COL32(255, 180, 80, 255) : IM_COL32(90, 180, 255, 255);
  draw.AddPolyline(points.data(), kPoints, colour, ImDrawFlags_Closed, 2);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("field of the luminance; orange: right circular, blue: left");
}

void drawLight(const ProbedLight& light) {
  if (!ImGui::BeginTable("light", 4, ImGuiTableFlags_SizingStretchSame)) return;
  const auto row = [](const char* name, const auto& value, const char* format) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    for (std::size_t c = 0; c < 3; ++c) {
      ImGui::TableNextColumn();
      ImGui::Text(format, value(c));
    }
  };
  ImGui::TableNextRow();
  for (const char* name : {"", "R", "G", "B"}) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
  }
  const char* const names[] = {"S0", "S1", "S2", "S3"};
  for (std::size_t s = 0; s < 4; ++s)
    row(
        names[s], [&](std::size_t c) { return light.stokes[c][s]; }, "%.4g");
  row(
      "DoLP", [&](std::size_t c) { return light.dolp[c]; }, "%.3f");
  row(
      "AoLP", [&](std::size_t c) { return light.aolpDegrees[c]; }, "%.1f");
  ImGui::EndTable();
  drawEllipse(light.luminance, 2.5f * ImGui::GetFontSize());
}

void drawSurface(const render::PixelTruth& truth, const pack::Scene& scene) {
  const std::optional<ProbedSurface> surface = probeSurface(truth, scene);
  if (!surface) {
    ImGui::TextUnformatted("environment");
    return;
  }
  ImGui::TextWrapped("%s (%s), %.3g m", surface->material.c_str(), surface->kind.c_str(), surface->distance);
  ImGui::Text("%u surface%s on the path", surface->interactions, surface->interactions == 1 ? "" : "s");
  ImGui::Text("angle of incidence %.1f deg", surface->incidenceDegrees);
  if (surface->diattenuation) {
    const auto& d = *surface->diattenuation;
    ImGui::Text("D %.3f %.3f %.3f", d[0], d[1], d[2]);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("diattenuation (Rs - Rp)/(Rs + Rp) of the bare interface at this angle");
  }
}

}  // namespace

void drawProbe(const Session& session, const UiState& ui, const Published& published,
               const BackgroundState& background) {
  const bool isSecond = session.state.isSplit && ui.mouseX >= session.state.divider * session.width();
  ImGui::Text("pixel %u, %u of %s", ui.mouseX, ui.mouseY, isSecond ? "B" : "A");
  const std::optional<ProbedLight> light =
      probeLight(published.sides[isSecond ? 1 : 0], ui.mouseX, ui.mouseY, session.width(), session.height());
  if (light)
    drawLight(*light);
  else
    ImGui::TextWrapped("no Stokes vectors: choose a method that stores them");
  if (background.truth) drawSurface(*background.truth, session.pack().scene);
}

}  // namespace malus::viewer

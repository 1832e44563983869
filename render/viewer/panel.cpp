#include "render/viewer/panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "render/scene/methods.h"

namespace malus::viewer {

namespace {

// A list of names to choose from. Returns whether the choice has changed.
template <class Names>
bool drawCombo(const char* label, std::string& chosen, const Names& names) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.c_str())) return false;
  for (const std::string& name : names)
    if (ImGui::Selectable(name.c_str(), name == chosen)) {
      changed = name != chosen;
      chosen = name;
    }
  ImGui::EndCombo();
  return changed;
}

void drawCount(const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most) {
  int v = static_cast<int>(value);
  if (ImGui::SliderInt(label, &v, static_cast<int>(least), static_cast<int>(most), "%d", ImGuiSliderFlags_Logarithmic))
    value = std::clamp(static_cast<std::uint32_t>(std::max(v, 0)), least, most);
}

void drawSide(SideSettings& side, const PublishedSide& published) {
  std::string backend = render::backendInfo(side.backend).name;
  if (drawCombo("renderer", backend, render::backendNames())) side.backend = render::backendNamed(backend);
  if (render::backendInfo(side.backend).hasMethods) {
    drawCombo("method", side.method, render::methodNames());
    const render::MethodInfo& method = render::methodNamed(side.method);
    if (method.isIterative && method.hasStokes)
      ImGui::Checkbox("Stokes vectors (four times the rays)", &side.iterativeStokes);
  }
  if (!published.substitutedFor.empty())
    ImGui::TextWrapped("renders as %s: %s", published.method.c_str(), published.substitutedFor.c_str());
  for (const std::string& warning : published.warnings) ImGui::TextWrapped("%s", warning.c_str());
  if (!published.problem.empty()) ImGui::TextColored({1, 0.4f, 0.3f, 1}, "%s", published.problem.c_str());
}

const char* switchName(EffectSwitch value) {
  return value == EffectSwitch::on ? "on" : value == EffectSwitch::off ? "off" : "auto";
}

}  // namespace

void drawMethods(Session& session, UiState& ui, const Published& published) {
  ViewState& state = session.state;
  bool split = state.isSplit;
  if (ImGui::Checkbox("split A|B", &split)) {
    state.isSplit = split;
    if (!split) ui.editedSide = 0;
  }
  if (state.isSplit)
    for (std::size_t i = 0; i < 2; ++i) {
      ImGui::SameLine();
      if (ImGui::RadioButton(i == 0 ? "edit A" : "edit B", ui.editedSide == i)) ui.editedSide = i;
    }
  drawSide(state.sides[ui.editedSide], published.sides[ui.editedSide]);
  drawCount("depth", state.depth, 0, pack::kMaxDepth);
  drawCount("samples", state.samples, 1, 64);  // as --samples
  auto ev = static_cast<float>(state.exposureEv);
  if (ImGui::SliderFloat("exposure", &ev, -8, 8, "%.1f stops")) state.exposureEv = static_cast<double>(ev);
  ImGui::Checkbox("render again and again (for times)", &state.isContinuous);
}

void drawEffects(Session& session, UiState& ui) {
  EffectSwitches& switches = session.state.sides[ui.editedSide].effects;
  if (!switches.empty() && ImGui::Button("all automatic")) switches.clear();
  if (!ImGui::BeginTable("effects", 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (const pack::Effect& effect : session.effects()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const auto found = switches.find(effect.name);
    const EffectSwitch value = found == switches.end() ? EffectSwitch::automatic : found->second;
    const std::string label = fmt::format("{}##{}", switchName(value), effect.name);
    if (ImGui::Button(label.c_str(), {3.2f * ImGui::GetFontSize(), 0})) {
      const auto next = static_cast<EffectSwitch>((static_cast<int>(value) + 1) % 3);
      if (next == EffectSwitch::automatic)
        switches.erase(effect.name);
      else
        switches[effect.name] = next;
    }
    ImGui::TableNextColumn();
    if (effect.on)
      ImGui::TextUnformatted(effect.name.c_str());
    else
      ImGui::TextDisabled("%s", effect.name.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s: %s", effect.on ? "needed" : "not needed", effect.reason.c_str());
  }
  ImGui::EndTable();
}

void drawFilter(ViewState& state, UiState& ui) {
  FilterState& filter = state.filter;
  const char* const names[] = {"none", "polarizer", "right circular", "left circular"};
  int kind = static_cast<int>(filter.kind);
  if (ImGui::Combo("filter", &kind, names, 4)) filter.kind = static_cast<FilterKind>(kind);
  if (filter.kind == FilterKind::linear) {
    drawDial("polarizer", filter.polarizerDegrees, 3.2 * static_cast<double>(ImGui::GetFontSize()));
    ImGui::SameLine();
    ImGui::BeginGroup();
    auto degrees = static_cast<float>(filter.polarizerDegrees);
    ImGui::SetNextItemWidth(5 * ImGui::GetFontSize());
    if (ImGui::DragFloat("##degrees", &degrees, 0.5f, -360, 360, "%.1f deg"))
      filter.polarizerDegrees = static_cast<double>(degrees);
    ImGui::Checkbox("turn", &ui.turnsPolarizer);
    ImGui::EndGroup();
  }
  ImGui::Checkbox("wave plate", &filter.hasPlate);
  if (!filter.hasPlate) return;
  auto axis = static_cast<float>(filter.plate.axisDegrees),
       retardance = static_cast<float>(filter.plate.retardanceDegrees);
  if (ImGui::SliderFloat("axis", &axis, 0, 180, "%.0f deg")) filter.plate.axisDegrees = static_cast<double>(axis);
  if (ImGui::SliderFloat("retardance", &retardance, 0, 360, "%.0f deg"))
    filter.plate.retardanceDegrees = static_cast<double>(retardance);
}

void drawShown(Session& session, UiState& ui) {
  ViewState& state = session.state;
  int shown = static_cast<int>(state.shown);
  const char* const names[] = {"colour", "DoLP", "AoLP", "S1 / S0", "S2 / S0", "S3 / S0", "difference", "FLIP"};
  if (ImGui::Combo("show", &shown, names, 8)) state.shown = static_cast<Quantity>(shown);
  if (state.shown == Quantity::difference || state.shown == Quantity::flip) {
    const char* const against[] = {"the reference", "the other side"};
    int index = static_cast<int>(state.against);
    if (ImGui::Combo("to", &index, against, 2)) {
      state.against = static_cast<Against>(index);
      if (state.against == Against::otherSide) state.isSplit = true;
    }
    if (state.against == Against::reference) state.usesReference = true;
  }
  if (state.shown == Quantity::difference) {
    auto scale = static_cast<float>(state.differenceScale);
    if (ImGui::SliderFloat("scale", &scale, 0.001f, 1, "%.3f", ImGuiSliderFlags_Logarithmic))
      state.differenceScale = static_cast<double>(scale);
  }
  ImGui::Checkbox("probe", &ui.showsProbe);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("values of the pixel under the cursor");
  ImGui::SameLine();
  ImGui::Checkbox("reference", &state.usesReference);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("rendered in the background, for errors and differences");
  const BackgroundState background = session.background();
  if (!state.usesReference || session.height() == 0) return;
  const float done = static_cast<float>(background.reference.rows) / static_cast<float>(session.height());
  const std::string text = fmt::format("{:.0f} %, {:.1f} s", 100 * done, background.referenceMs / 1000);
  ImGui::ProgressBar(done, {-1, 0}, text.c_str());
  if (!background.problem.empty()) ImGui::TextColored({1, 0.4f, 0.3f, 1}, "%s", background.problem.c_str());
}

namespace {

void drawSideTimes(char name, const PublishedSide& side) {
  ImGui::Text("%c: %.1f ms, median %.1f, %s", name, side.traceMs, side.medianMs, side.isShared ? "shared" : "copied");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("rays and shading of an image at full resolution; %s%s%s\nthe image %s", side.device.c_str(),
                      side.path.empty() ? "" : ", ", side.path.c_str(),
                      side.isShared ? "stays on the device" : "is copied to the display by the host");
  if (side.path.empty()) return;  // the reference has no methods
  std::string rays;
  if (side.rays > 0 && side.traceMs > 0)
    rays = fmt::format("{:.2f} M rays, {:.1f} M/s, ", static_cast<double>(side.rays) / 1e6,
                       static_cast<double>(side.rays) / side.traceMs / 1e3);
  ImGui::Text("   %s%zu B per ray", rays.c_str(), render::methodNamed(side.method).payloadBytes);
}

}  // namespace

void drawTimes(const UiState& ui, const Published& published) {
  for (std::size_t i = 0; i < 2; ++i)
    if (!published.sides[i].method.empty()) drawSideTimes(i == 0 ? 'A' : 'B', published.sides[i]);
  ImGui::Text("moving at %.0f %% of the resolution", 100 * published.fraction);
  // Drivers add versions in parentheses.
  ImGui::TextDisabled("display: %s", ui.device.substr(0, ui.device.find(" (")).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", ui.device.c_str());
  if (ui.displayPass.count() > 0)
    ImGui::Text("   image %.1f ms, panel %.1f ms", ui.displayPass.median(), ui.overlay.median());
  if (const auto& latency = ui.latency.rendered(); !latency.empty())
    ImGui::Text("input to image: %.0f ms, %u frame%s", latency.back().ms, latency.back().frames,
                latency.back().frames == 1 ? "" : "s");
  const std::vector<float> frames = ui.frames.values();
  const std::string label = fmt::format("window: median {:.1f} ms", ui.frames.median());
  ImGui::PlotLines("##frames", frames.data(), static_cast<int>(frames.size()), 0, label.c_str(), 0, 100,
                   {0.95f * ImGui::GetContentRegionAvail().x, 2.2f * ImGui::GetFontSize()});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("times of the last 200 frames of the window, 0 to 100 ms");
}

namespace {

// At the right, so that it is beside the groups of the panel.
void drawProbeWindow(const Session& session, UiState& ui, const Published& published,
                     const BackgroundState& background) {
  if (!ui.showsProbe) return;
  ImGui::SetNextWindowPos({static_cast<float>(session.width()), 0}, ImGuiCond_Always, {1, 0});
  const float width = 22 * ImGui::GetFontSize();
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, static_cast<float>(session.height())});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar;
  if (ImGui::Begin("probe", nullptr, kFlags)) drawProbe(session, ui, published, background);
  ImGui::End();
}

}  // namespace

void drawPanel(Session& session, UiState& ui, const Published& published, const BackgroundState& background) {
  drawSides(session, ui, published, background);
  drawLegend(session, ui, background);
  if (!ui.showsPanel) return;
  drawProbeWindow(session, ui, published, background);
  const auto scale = static_cast<float>(ui.scale);
  const float width = std::min(kPanelWidth * scale, static_cast<float>(session.width()));
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, static_cast<float>(session.height())});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar;
  if (ImGui::Begin("malus", nullptr, kFlags)) {
    ImGui::PushItemWidth(0.58f * width);
    ImGui::TextUnformatted(session.pack().scene.name.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("F1: keys, H: hide");
    // In a low window the times are closed at first, so that the settings need no scrolling.
    const bool isHigh = static_cast<float>(session.height()) >= 680 * scale;
    if (ImGui::CollapsingHeader("Method", ImGuiTreeNodeFlags_DefaultOpen)) drawMethods(session, ui, published);
    if (ImGui::CollapsingHeader("Filter", ImGuiTreeNodeFlags_DefaultOpen)) drawFilter(session.state, ui);
    if (ImGui::CollapsingHeader("Shown", ImGuiTreeNodeFlags_DefaultOpen)) drawShown(session, ui);
    if (ImGui::CollapsingHeader("Times", isHigh ? ImGuiTreeNodeFlags_DefaultOpen : 0)) drawTimes(ui, published);
    if (ImGui::CollapsingHeader("Effects")) drawEffects(session, ui);
    if (ImGui::CollapsingHeader("Save and record")) drawFiles(session, ui);
    ImGui::PopItemWidth();
    if (!ui.message.empty()) ImGui::TextWrapped("%s", ui.message.c_str());
  }
  ImGui::End();
}

}  // namespace malus::viewer

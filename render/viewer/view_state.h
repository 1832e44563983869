// Everything that the user of `malus view` chose. Plain data: the window, the panel and the script change it, the
// render thread and the display pass read it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "bake/pack/scene.h"
#include "render/backend.h"
#include "render/job.h"
#include "render/scene/render_parameters.h"

namespace malus::viewer {

// Quantities of the display pass, in the order of shaders/display/present.comp. s1 to s3 are divided by S0.
enum class Quantity : std::uint8_t { colour, dolp, aolp, s1, s2, s3, difference, flip };
inline constexpr std::array<const char*, 8> kQuantityNames = {"colour", "dolp", "aolp",       "s1",
                                                              "s2",     "s3",   "difference", "flip"};
constexpr const char* quantityName(Quantity quantity) { return kQuantityNames[static_cast<std::size_t>(quantity)]; }
// Nothing: no such name.
std::optional<Quantity> quantityNamed(std::string_view name);

// The image that `difference` and `flip` compare with.
enum class Against : std::uint8_t { reference, otherSide };

enum class FilterKind : std::uint8_t { none, linear, right, left };

struct FilterState {
  FilterKind kind = FilterKind::none;
  double polarizerDegrees = 0;
  bool hasPlate = false;
  render::WavePlate plate;

  render::Analyser analyser() const;
  friend bool operator==(const FilterState& a, const FilterState& b) {
    return a.analyser() == b.analyser() && a.kind == b.kind;
  }
};

// Switch of an effect; an effect without an entry is `automatic`: on if the scene needs it.
enum class EffectSwitch : std::uint8_t { automatic, on, off };
using EffectSwitches = std::map<std::string, EffectSwitch>;

// One of the two images of the split.
struct SideSettings {
  render::Backend backend = render::Backend::embree;
  std::string method = "stokes";
  EffectSwitches effects;
  bool iterativeStokes = true;  // Stokes channels of iterative methods, by four times the rays

  friend bool operator==(const SideSettings&, const SideSettings&) = default;
};

struct ViewState {
  pack::Camera camera;
  glm::dvec3 pivot{0.0};  // of orbits, relative to the origin of the scene
  std::array<SideSettings, 2> sides;
  bool isSplit = false;
  double divider = 0.5;  // share of the width that shows side 0
  std::uint32_t depth = 6;
  std::uint32_t samples = 1;
  std::uint32_t lightSamples = render::RenderParameters{}.lightSamples;
  double exposureEv = 0;
  FilterState filter;
  Quantity shown = Quantity::colour;
  Against against = Against::reference;
  double differenceScale = 0.1;  // difference of the brightest colour of the legend, in display units
  bool usesReference = false;    // render the reference in the background
  bool isContinuous = false;     // render again and again while still, to measure times

  // Whether differences and FLIP are taken to the other side, which only a split window has.
  bool comparesSides() const { return against == Against::otherSide && isSplit; }
};

// The settings of one image of a side, for the functions of render/job.h. needed: the effects of the scene.
render::JobSettings jobSettings(const ViewState& state, const SideSettings& side, std::uint32_t width,
                                std::uint32_t height, const std::vector<pack::Effect>& needed);

// --effects of the switches: "auto", "all" or the names to keep.
std::string effectsOption(const EffectSwitches& switches, const std::vector<pack::Effect>& needed);
// The switches of --effects, the inverse.
EffectSwitches effectSwitches(const std::string& option, const std::vector<pack::Effect>& needed);

}  // namespace malus::viewer

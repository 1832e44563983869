#include "render/filter_options.h"

#include <fmt/format.h>

#include "meshprep/base/console.h"
#include "render/options.h"
#include "render/scene/methods.h"

namespace malus::render {

namespace {

CLI::Validator wavePlate() {
  return {[](std::string& text) {
            return parseWavePlate(text) ? "" : "expected AXIS[,RETARDANCE] in degrees, found " + text;
          },
          "AXIS[,RETARDANCE]"};
}

}  // namespace

std::optional<WavePlate> parseWavePlate(std::string_view text) {
  const std::size_t comma = text.find(',');
  const std::optional<double> axis = parseNumber(text.substr(0, comma));
  const std::optional<double> retardance =
      comma == std::string_view::npos ? WavePlate{}.retardanceDegrees : parseNumber(text.substr(comma + 1));
  if (!axis || !retardance) return std::nullopt;
  return WavePlate{*axis, *retardance};
}

void addFilterOptions(CLI::App& command, FilterOptions& options) {
  command
      .add_option("--polarizer", options.polarizer,
                  "Linear polarizer in front of the camera, from the image's x axis, counter-clockwise [degrees]")
      ->transform(anyNumber());
  command.add_option("--analyser", options.analyser, "Circular analyser in front of the camera: the light that passes")
      ->transform(CLI::IsMember({"right", "left"}, CLI::ignore_case));
  command
      .add_option("--wave-plate", options.wavePlate,
                  "Retarder in front of the polarizer: its fast axis, and its retardance if not 90 [degrees]")
      ->check(wavePlate());
}

Analyser makeAnalyser(const FilterOptions& options) {
  if (options.polarizer && !options.analyser.empty())
    throw CLI::ValidationError("--analyser", "excludes --polarizer: the filter is linear or circular");
  Analyser analyser = kNoFilter;
  if (options.polarizer) analyser = linearPolarizer(*options.polarizer);
  if (!options.analyser.empty())
    analyser = circularAnalyser(options.analyser == "right" ? Handedness::right : Handedness::left);
  if (const auto plate = parseWavePlate(options.wavePlate)) analyser = behindWavePlate(analyser, *plate);
  return analyser;
}

void warnOfFilter(const FilterOptions& options, const Analyser& analyser, const std::string& method) {
  if (!options.wavePlate.empty() && !options.polarizer && options.analyser.empty())
    console::warn("--wave-plate changes no intensity without --polarizer or --analyser");
  if (method.empty()) return;
  const MethodInfo& info = methodNamed(method);
  const bool linear = (analyser[1] != 0 || analyser[2] != 0) && !info.carriesLinear(),
             circular = analyser[3] != 0 && !info.carriesCircular();
  if (!linear && !circular) return;
  console::warn(
      fmt::format("--method {} carries no {} polarization ({}): half of that light passes the filter, "
                  "whatever its polarization",
                  method,
                  linear && circular ? "linear or circular"
                  : linear           ? "linear"
                                     : "circular",
                  linear && circular ? "S1, S2, S3"
                  : linear           ? "S1, S2"
                                     : "S3"));
}

}  // namespace malus::render

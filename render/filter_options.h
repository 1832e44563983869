// The filter in front of the camera, from the command line: --polarizer, --analyser, --wave-plate.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "render/scene/render_parameters.h"

namespace malus::render {

struct FilterOptions {
  std::optional<double> polarizer;  // degrees from the x axis of the image, counter-clockwise
  std::string analyser;             // right, left or empty
  std::string wavePlate;            // AXIS or AXIS,RETARDANCE in degrees, or empty

  bool any() const { return polarizer || !analyser.empty() || !wavePlate.empty(); }
};

void addFilterOptions(CLI::App& command, FilterOptions& options);

// "AXIS" or "AXIS,RETARDANCE" in degrees; nothing: other text.
std::optional<WavePlate> parseWavePlate(std::string_view text);

// The filter as one analyser. Throws CLI::ValidationError for a linear and a circular one together.
Analyser makeAnalyser(const FilterOptions& options);

// Prints warnings: a wave plate without an analyser behind it; a method that does not carry the light that the filter
// analyses. method: empty if the renderer carries all of it.
void warnOfFilter(const FilterOptions& options, const Analyser& analyser, const std::string& method);

}  // namespace malus::render

#include "meshprep/base/radiance_header.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace malus::image {

namespace {

// The axes of the resolution line "-Y rows +X columns": the first one is that of the scanlines. +Y is up.
int orientationFromAxes(const std::string& axes) {
  constexpr const char* kAxes[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
  for (int i = 0; i < 8; ++i)
    if (axes == kAxes[i]) return i + 1;
  return 0;
}

bool readResolution(const std::string& line, RadianceHeader& header) {
  char axis[2], sign[2];
  if (std::sscanf(line.c_str(), "%c%c %d %c%c %d", &sign[0], &axis[0], &header.rows, &sign[1], &axis[1],
                  &header.columns) != 6)
    return false;
  header.orientation = orientationFromAxes({sign[0], axis[0], sign[1], axis[1]});
  return header.orientation != 0;
}

bool isFactor(double value) { return std::isfinite(value) && value > 0; }

// False: a variable has too few numbers, or a factor is not positive and finite.
bool readVariable(const std::string& line, RadianceHeader& header) {
  double v[8];
  if (line.starts_with("EXPOSURE=")) {
    if (std::sscanf(line.c_str(), "EXPOSURE=%lf", v) != 1) return false;
    header.exposure *= v[0];
  } else if (line.starts_with("COLORCORR=")) {
    if (std::sscanf(line.c_str(), "COLORCORR=%lf %lf %lf", v, v + 1, v + 2) != 3) return false;
    for (std::size_t c = 0; c < 3; ++c) header.colourCorrection[c] *= v[c];
  } else if (line.starts_with("PRIMARIES=")) {
    if (std::sscanf(line.c_str(), "PRIMARIES=%lf %lf %lf %lf %lf %lf %lf %lf", v, v + 1, v + 2, v + 3, v + 4, v + 5,
                    v + 6, v + 7) != 8)
      return false;
    header.primaries = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
  } else if (line.starts_with("FORMAT=")) {
    char format[32] = "";
    (void)std::sscanf(line.c_str(), "FORMAT=%31s", format);
    header.format = format;
  } else if (line.starts_with("GAMMA=")) {
    header.gamma = line.substr(std::string_view("GAMMA=").size());
  }
  return isFactor(header.exposure) && isFactor(header.colourCorrection[0]) && isFactor(header.colourCorrection[1]) &&
         isFactor(header.colourCorrection[2]);
}

}  // namespace

std::optional<RadianceHeader> readRadianceHeader(std::string_view text) {
  RadianceHeader header;
  bool isAfterBlank = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    std::string line(text.substr(0, end));
    text.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (isAfterBlank) return readResolution(line, header) ? std::optional(header) : std::nullopt;
    if (line.empty())
      isAfterBlank = true;
    else if (!readVariable(line, header))
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace malus::image

#include "render/sensor/demosaic.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace malus::render {

namespace {

// The pixels of one angle as an image of half the width and height with all channels of the sensor, in radiance.
class AnglePlane {
 public:
  AnglePlane(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(channels),
        values_(static_cast<std::size_t>(width * height * channels)) {}
  int width() const { return width_; }
  int height() const { return height_; }
  float& at(int x, int y, int channel) { return values_[index(x, y, channel)]; }

  // Pixels beyond the border are those of the border.
  double clamped(int x, int y, int channel) const {
    return static_cast<double>(values_[index(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1), channel)]);
  }

 private:
  std::size_t index(int x, int y, int channel) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels_) +
           static_cast<std::size_t>(channel);
  }
  int width_, height_, channels_;
  std::vector<float> values_;
};

// Light behind the polarizer of a pixel, relative to the light of radiance 1 without a polarizer.
double measuredLight(const RawImage& raw, const Sensor& sensor, double electrons, int x, int y) {
  const double number =
      raw.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(raw.width) + static_cast<std::size_t>(x)];
  const double charge = (number - sensor.blackLevel) * electronsPerNumber(sensor) - sensor.darkSignal;
  // The weights of a monochrome sensor are part of the light that it measures.
  const double response =
      sensor.pattern == MosaicPattern::mono ? 1 : sensor.response[mosaicChannel(sensor.pattern, x, y)];
  return charge / (electrons * response);
}

// Mean of the pixels of one colour at these offsets; those outside of the image are left out.
float averageColour(const AnglePlane& plane, int x, int y, int colour,
                    const std::vector<std::pair<int, int>>& offsets) {
  double sum = 0;
  int count = 0;
  for (const auto& [dx, dy] : offsets) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= plane.width() || y + dy >= plane.height()) continue;
    sum += plane.clamped(x + dx, y + dy, colour);
    ++count;
  }
  return static_cast<float>(sum / count);
}

// Fills in the colours that a pixel does not measure, bilinearly: from the 4 neighbours (green), or from the 2 or 4
// nearest pixels of the colour.
void interpolateColours(AnglePlane& plane) {
  const std::vector<std::pair<int, int>> kRow = {{-1, 0}, {1, 0}}, kColumn = {{0, -1}, {0, 1}},
                                         kCross = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}},
                                         kDiagonal = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  const auto measured = [](int x, int y) { return kBayerColours[static_cast<std::size_t>(polarizerIndex(x, y))]; };
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x)
      for (int colour = 0; colour < 3; ++colour) {
        if (measured(x, y) == colour) continue;
        const bool inRow = measured(x + 1, y) == colour, inColumn = measured(x, y + 1) == colour;
        plane.at(x, y, colour) = averageColour(plane, x, y, colour,
                                               inRow && inColumn ? kCross
                                               : inRow           ? kRow
                                               : inColumn        ? kColumn
                                                                 : kDiagonal);
      }
}

AnglePlane anglePlane(const RawImage& raw, const Sensor& sensor, double electrons, int angle) {
  const int offsetX = angle & 1, offsetY = angle >> 1;
  AnglePlane plane(raw.width / 2, raw.height / 2, channelCount(sensor.pattern));
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x) {
      const int px = 2 * x + offsetX, py = 2 * y + offsetY;
      plane.at(x, y, mosaicChannel(sensor.pattern, px, py)) =
          static_cast<float>(measuredLight(raw, sensor, electrons, px, py));
    }
  if (sensor.pattern != MosaicPattern::mono) interpolateColours(plane);
  return plane;
}

// Bilinear value of a plane at a pixel of the whole image.
double interpolated(const AnglePlane& plane, int angle, int channel, int x, int y) {
  const int u = x - (angle & 1), v = y - (angle >> 1);         // twice the coordinates in the plane
  const int left = u >> 1, top = v >> 1;                       // rounded down
  const double right = (u & 1) * 0.5, bottom = (v & 1) * 0.5;  // weights
  const auto row = [&](int r) {
    return (1 - right) * plane.clamped(left, r, channel) + right * plane.clamped(left + 1, r, channel);
  };
  return (1 - bottom) * row(top) + bottom * row(top + 1);
}

// Names of the channels of the result: for each sensor channel its S0, and S0, S1, S2 as layers.
std::vector<std::string> channelNames(const Sensor& sensor) {
  const std::vector<std::string> colours =
      sensor.pattern == MosaicPattern::mono ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  std::vector<std::string> names = colours;
  for (int s = 0; s < 3; ++s)
    for (const std::string& colour : colours) names.push_back(fmt::format("S{}.{}", s, colour));
  return names;
}

}  // namespace

DataReduction dataReduction(const Sensor& sensor, int channel) {
  glm::dmat3 normal(0);  // A^T A
  std::array<glm::dvec3, kPolarizerAngles> rows;
  for (std::size_t a = 0; a < rows.size(); ++a) {
    const Analyser row = polarizerRow(sensor, channel, kPolarizerDegrees[a]);
    rows[a] = {row[0], row[1], row[2]};
    normal += glm::outerProduct(rows[a], rows[a]);
  }
  const glm::dmat3 inverse = glm::inverse(normal);
  DataReduction reduction{};
  for (std::size_t a = 0; a < rows.size(); ++a) {
    const glm::dvec3 column = inverse * rows[a];
    for (int s = 0; s < 3; ++s) reduction[static_cast<std::size_t>(s)][a] = column[s];
  }
  return reduction;
}

image::Image demosaic(const RawImage& raw, const Sensor& sensor, double exposureEv) {
  const int channels = channelCount(sensor.pattern);
  const double electrons = electronsPerRadiance(sensor, exposureEv);
  std::vector<AnglePlane> planes;
  for (int angle = 0; angle < kPolarizerAngles; ++angle) planes.push_back(anglePlane(raw, sensor, electrons, angle));
  std::vector<DataReduction> reductions;
  for (int c = 0; c < channels; ++c) reductions.push_back(dataReduction(sensor, c));

  image::Image image;
  image.width = raw.width;
  image.height = raw.height;
  image.channels = channelNames(sensor);
  image.pixels.resize(raw.values.size() * image.channels.size());
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, raw.height), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y)
      for (int x = 0; x < raw.width; ++x)
        for (int c = 0; c < channels; ++c) {
          std::array<double, kPolarizerAngles> light{};
          for (int a = 0; a < kPolarizerAngles; ++a)
            light[static_cast<std::size_t>(a)] = interpolated(planes[static_cast<std::size_t>(a)], a, c, x, y);
          float* const pixel =
              image.pixels.data() +
              (static_cast<std::size_t>(y) * static_cast<std::size_t>(raw.width) + static_cast<std::size_t>(x)) *
                  image.channels.size();
          for (int s = 0; s < 3; ++s) {
            const auto& row = reductions[static_cast<std::size_t>(c)][static_cast<std::size_t>(s)];
            double value = 0;
            for (std::size_t a = 0; a < light.size(); ++a) value += row[a] * light[a];
            pixel[channels * (s + 1) + c] = static_cast<float>(value);
            if (s == 0) pixel[c] = static_cast<float>(value);
          }
        }
  });
  return image;
}

}  // namespace malus::render

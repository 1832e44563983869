#include "render/image/mosaic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/image/polarization.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

namespace {
constexpr double kDegrees[2][2] = {{90, 45}, {135, 0}};  // [row][column]
}

double mosaicDegrees(int x, int y) { return kDegrees[y & 1][x & 1]; }

Mosaic mosaic(const image::Image& image, const MosaicSettings& settings) {
  if (settings.bits != 8 && settings.bits != 12 && settings.bits != 16)
    throw Error("mosaic", "unknown number of bits", "8, 12 or 16", fmt::format("{}", settings.bits));
  if (image.width % 2 != 0 || image.height % 2 != 0)
    throw Error("mosaic", "squares of 2 x 2 pixels do not fill the image", "an even width and height",
                fmt::format("{} x {}", image.width, image.height));
  const std::vector<std::array<double, 3>> stokes =
      settings.channel == MosaicChannel::luminance
          ? luminanceStokes(image)
          : colourStokes(image, static_cast<int>(settings.channel) - static_cast<int>(MosaicChannel::red));
  Mosaic result{image.width, image.height, settings.bits, {}};
  result.values.reserve(stokes.size());
  const double fullScale = std::exp2(settings.bits) - 1, gain = std::exp2(settings.exposureEv) * fullScale;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto& s = stokes[result.values.size()];
      const Analyser a = linearPolarizer(mosaicDegrees(x, y));
      const double value = gain * (a[0] * s[0] + a[1] * s[1] + a[2] * s[2]);
      result.values.push_back(
          static_cast<std::uint16_t>(std::isnan(value) ? 0 : std::lround(std::clamp(value, 0.0, fullScale))));
    }
  return result;
}

void writeMosaic(const std::filesystem::path& path, const Mosaic& mosaic) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".tif" && extension != ".tiff")
    throw Error(path.string(), "unknown format of a mosaic", ".png or .tif",
                extension.empty() ? "no extension" : extension);
  image::writeGrey(
      path, mosaic.width, mosaic.height, mosaic.bits == 8 ? image::GreyDepth::bits8 : image::GreyDepth::bits16,
      mosaic.values,
      fmt::format("polarization mosaic, polarizers in degrees by row: 90 45 / 135 0, {} bits, linear", mosaic.bits));
}

}  // namespace malus::render

#include "render/image/output.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "meshprep/base/error.h"
#include "render/ground_truth/camera_matrices.h"
#include "shaders/optics/language_begin.h"

namespace malus::render {

namespace {

namespace display {
using real = double;
using std::exp;
using std::pow;
#include "shaders/display/tone_curve.h"
}  // namespace display

// Everything but the pixels.
image::Image describeImage(const RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                           const std::string& renderer, const std::string& method) {
  image::Image image;
  image.width = static_cast<int>(result.width);
  image.height = static_cast<int>(result.height);
  image.channels = {"R", "G", "B"};
  if (result.channels == kStokesChannels)
    for (const char* s : {"S0", "S1", "S2", "S3"})
      for (const char* c : {"R", "G", "B"}) image.channels.push_back(fmt::format("{}.{}", s, c));

  const pack::Camera& camera = pack.scene.camera;
  image.attributes = {
      {"worldToCamera", exrWorldToCamera(pack.scene)},
      {"malus:scene", pack.scene.name},
      {"malus:pack", fmt::format("{:016x}", pack.hash)},
      {"malus:renderer", renderer},
      {"malus:method", method},
      {"malus:device", result.device},
      {"malus:depth", static_cast<double>(parameters.depth)},
      {"malus:samples", static_cast<double>(parameters.samples)},
      {camera.isOrthographic() ? "malus:orthographicHeight" : "malus:verticalFovDegrees",
       camera.isOrthographic() ? camera.orthographicHeight : camera.verticalFovDegrees},
      {"malus:analyser", fmt::format("{:g} {:g} {:g} {:g}", parameters.analyser[0], parameters.analyser[1],
                                     parameters.analyser[2], parameters.analyser[3])},
      {"malus:region", regionText(parameters)},
  };
  return image;
}

std::uint8_t displayByte(float radiance, double gain) {
  const double x = std::isnan(radiance) ? 0 : std::clamp(static_cast<double>(radiance) * gain, 0.0, 1e6);
  return static_cast<std::uint8_t>(std::lround(display::srgbCurve(display::toneCurve(x)) * 255));
}

// displayByte of one gain by table, which is monotonic: the least radiance of each byte, and the byte of the least
// radiance of each sign, exponent and upper 7 bits of the mantissa.
class DisplayBytes {
 public:
  explicit DisplayBytes(double gain) {
    for (unsigned byte = 0; byte < 256; ++byte) least_[byte] = leastBits(static_cast<std::uint8_t>(byte), gain);
    std::size_t byte = 0;
    for (std::uint32_t upper = 0; upper < first_.size(); ++upper) {
      while (byte < 255 && least_[byte + 1] <= upper << 16u) ++byte;
      first_[upper] = static_cast<std::uint8_t>(byte);
    }
  }
  std::uint8_t operator()(float radiance) const {
    const auto bits = std::bit_cast<std::uint32_t>(radiance);
    if (bits > kInfinity) return 0;  // negative, -0 or NaN
    std::uint8_t byte = first_[bits >> 16u];
    while (byte < 255 && least_[byte + 1u] <= bits) ++byte;
    return byte;
  }

 private:
  static constexpr std::uint32_t kInfinity = 0x7f800000u;

  // The least bits of a radiance with at least this byte; above those of infinity if there is none.
  static std::uint32_t leastBits(std::uint8_t byte, double gain) {
    std::uint32_t low = 0, high = kInfinity + 1;
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (displayByte(std::bit_cast<float>(middle), gain) < byte)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

  std::array<std::uint32_t, 256> least_{};
  std::array<std::uint8_t, (kInfinity >> 16u) + 1> first_{};
};

}  // namespace

image::Image toImage(const RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                     const std::string& renderer, const std::string& method) {
  image::Image image = describeImage(result, pack, parameters, renderer, method);
  image.pixels = result.pixels;
  return image;
}

image::Image takeImage(RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                       const std::string& renderer, const std::string& method) {
  image::Image image = describeImage(result, pack, parameters, renderer, method);
  image.pixels = std::move(result.pixels);
  return image;
}

image::Image withAlpha(const image::Image& image, const std::vector<float>& coverage) {
  image::Image result;
  result.width = image.width;
  result.height = image.height;
  result.channels = image.channels;
  result.channels.insert(result.channels.begin() + kColourChannels, "A");
  result.attributes = image.attributes;
  result.pixels.resize(coverage.size() * result.channels.size());
  const std::size_t channels = image.channels.size();
  namespace tbb = oneapi::tbb;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, coverage.size()), [&](const auto& pixels) {
    for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
      const float* const from = image.pixels.data() + i * channels;
      float* const to = result.pixels.data() + i * (channels + 1);
      std::copy_n(from, kColourChannels, to);
      to[kColourChannels] = coverage[i];
      std::copy(from + kColourChannels, from + channels, to + kColourChannels + 1);
    }
  });
  return result;
}

std::vector<std::uint8_t> toneMapped(const image::Image& image, double exposureEv) {
  const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  if (r < 0 || g < 0 || b < 0) throw Error("", "a PNG needs channels R, G and B", "an output with the extension .exr");
  const DisplayBytes encode(std::exp2(exposureEv));
  const std::size_t channels = image.channels.size(), count = image.pixels.size() / channels;
  std::vector<std::uint8_t> bytes(count * 3);
  namespace tbb = oneapi::tbb;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const tbb::blocked_range<std::size_t>& pixels) {
    for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
      const float* p = image.pixels.data() + i * channels;
      bytes[3 * i] = encode(p[r]), bytes[3 * i + 1] = encode(p[g]), bytes[3 * i + 2] = encode(p[b]);
    }
  });
  return bytes;
}

void writeImage(const std::filesystem::path& path, const image::Image& image, double exposureEv,
                image::ExrCompression compression) {
  const std::string extension = path.extension().string();
  if (extension == ".exr")
    image::writeExr(path, image, compression);
  else if (extension == ".png")
    image::writePng(path, image.width, image.height, 3, toneMapped(image, exposureEv));
  else
    throw Error(path.string(), "unknown image format", ".exr or .png", extension.empty() ? "no extension" : extension);
}

}  // namespace malus::render

#include "shaders/optics/language_end.h"

#include "render/image/output.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

image::Image toImage(const RenderResult& result, const pack::Pack& pack, const RenderParameters& parameters,
                     const std::string& renderer, const std::string& method) {
  image::Image image;
  image.width = static_cast<int>(result.width);
  image.height = static_cast<int>(result.height);
  image.channels = {"R", "G", "B"};
  if (result.channels == kStokesChannels)
    for (const char* s : {"S0", "S1", "S2", "S3"})
      for (const char* c : {"R", "G", "B"}) image.channels.push_back(fmt::format("{}.{}", s, c));
  image.pixels = result.pixels;

  const pack::Camera& camera = pack.scene.camera;
  const glm::dvec3 position = camera.position + pack.scene.origin;
  const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  // OpenEXR multiplies row vectors by this matrix; the camera looks along -z.
  std::vector<float> worldToCamera;
  for (int row = 0; row < 4; ++row) {
    const auto entry = [&](const glm::dvec3& axis) {
      return static_cast<float>(row < 3 ? axis[row] : -dot(position, axis));
    };
    worldToCamera.insert(worldToCamera.end(),
                         {entry(camera.right), entry(camera.up), entry(-camera.forward), row < 3 ? 0.0f : 1.0f});
  }
  image.attributes = {
      {"worldToCamera", worldToCamera},
      {"malus:scene", pack.scene.name},
      {"malus:pack", fmt::format("{:016x}", pack.hash)},
      {"malus:renderer", renderer},
      {"malus:method", method},
      {"malus:device", result.device},
      {"malus:depth", static_cast<double>(parameters.depth)},
      {"malus:samples", static_cast<double>(parameters.samples)},
      {"malus:verticalFovDegrees", camera.verticalFovDegrees},
      {"malus:analyser", fmt::format("{:g} {:g} {:g} {:g}", parameters.analyser[0], parameters.analyser[1],
                                     parameters.analyser[2], parameters.analyser[3])},
      {"malus:region",
       fmt::format("{} {} {} {} of {} {}", parameters.region.x, parameters.region.y, parameters.region.width,
                   parameters.region.height, parameters.width, parameters.height)},
  };
  return image;
}

std::vector<std::uint8_t> toneMapped(const image::Image& image, double exposureEv) {
  const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  if (r < 0 || g < 0 || b < 0) throw Error("", "a PNG needs channels R, G and B", "an output with the extension .exr");
  const double gain = std::exp2(exposureEv);
  const auto encode = [&](float radiance) {
    constexpr double kLinear = 0.7;
    double x = std::isnan(radiance) ? 0 : std::clamp(static_cast<double>(radiance) * gain, 0.0, 1e6);
    if (x > kLinear) x = kLinear + (1 - kLinear) * (1 - std::exp(-(x - kLinear) / (1 - kLinear)));
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(s * 255));
  };
  const std::size_t channels = image.channels.size(), count = image.pixels.size() / channels;
  std::vector<std::uint8_t> bytes(count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    const float* p = image.pixels.data() + i * channels;
    bytes[3 * i] = encode(p[r]), bytes[3 * i + 1] = encode(p[g]), bytes[3 * i + 2] = encode(p[b]);
  }
  return bytes;
}

void writeImage(const std::filesystem::path& path, const image::Image& image, double exposureEv) {
  const std::string extension = path.extension().string();
  if (extension == ".exr")
    image::writeExr(path, image);
  else if (extension == ".png")
    image::writePng(path, image.width, image.height, 3, toneMapped(image, exposureEv));
  else
    throw Error(path.string(), "unknown image format", ".exr or .png", extension.empty() ? "no extension" : extension);
}

}  // namespace malus::render

#include "bake/textures/texture.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/error.h"

namespace malus::bake {

namespace {

// Whether the values are sRGB: OpenImageIO sets the attribute for integers of 8 or 16 bits unless the file states
// otherwise.
bool isSrgb(const image::Image& image) {
  for (const auto& [name, value] : image.attributes)
    if (name == "oiio:ColorSpace")
      if (const auto* text = std::get_if<std::string>(&value)) return *text == "sRGB";
  return false;
}

double linearFromSrgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace

pack::Texture bakeTexture(const image::Image& image, const TextureDescription& d, const std::string& name) {
  const auto side = static_cast<int>(pack::kMaxTextureSide);
  if (image.width > side || image.height > side)
    throw Error(d.file.string(), "is too large for a texture", fmt::format("at most {0} x {0} texels", side),
                fmt::format("{} x {}", image.width, image.height));
  const std::size_t channels = image.channels.size();
  const bool grey = channels < 3, decode = isSrgb(image) && d.high <= 1;
  pack::Texture texture;
  texture.name = name;
  texture.width = static_cast<std::uint32_t>(image.width);
  texture.height = static_cast<std::uint32_t>(image.height);
  texture.texels.resize(std::size_t{texture.width} * texture.height);
  for (std::size_t i = 0; i < texture.texels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t channel = grey ? 0 : d.grey ? 1 : c;
      double value = image.pixels[i * channels + channel];
      if (decode) value = linearFromSrgb(value);
      value = value * d.scale + d.offset;
      if (!(value >= d.low && value <= d.high))
        throw Error(d.file.string(), "contains a value out of the range of the material",
                    fmt::format("{:g} to {:g} after 'scale' and 'offset' of the map", d.low, d.high),
                    fmt::format("{} at ({}, {})", value, i % texture.width, i / texture.width));
      texture.texels[i][static_cast<int>(c)] = static_cast<float>(value);
    }
  return texture;
}

}  // namespace malus::bake

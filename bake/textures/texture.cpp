#include "bake/textures/texture.h"

#include <array>

#include <fmt/format.h>

#include "bake/pack/format.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image_colour.h"

namespace malus::bake {

pack::Texture bakeTexture(const image::Image& image, const TextureDescription& d, const std::string& name,
                          std::vector<std::string>& notes) {
  const auto side = static_cast<int>(pack::kMaxTextureSide);
  if (image.width > side || image.height > side)
    throw Error(d.file.string(), "is too large for a texture", fmt::format("at most {0} x {0} texels", side),
                fmt::format("{} x {}", image.width, image.height));
  const image::LinearColours colours(image, d.file.string());
  notes.insert(notes.end(), colours.notes().begin(), colours.notes().end());
  pack::Texture texture;
  texture.name = name;
  texture.width = static_cast<std::uint32_t>(image.width);
  texture.height = static_cast<std::uint32_t>(image.height);
  texture.texels.resize(std::size_t{texture.width} * texture.height);
  for (std::size_t i = 0; i < texture.texels.size(); ++i) {
    const std::array<double, 3> values = d.isColour() ? colours.at(i) : colours.stored(i);
    for (std::size_t c = 0; c < 3; ++c) {
      double value = values[d.grey ? 1 : c];
      value = value * d.scale + d.offset;
      if (!(value >= d.low && value <= d.high))
        throw Error(d.file.string(), "contains a value out of the range of the material",
                    fmt::format("{:g} to {:g} after 'scale' and 'offset' of the map", d.low, d.high),
                    fmt::format("{} at ({}, {})", value, i % texture.width, i / texture.width));
      texture.texels[i][static_cast<int>(c)] = static_cast<float>(value);
    }
  }
  return texture;
}

}  // namespace malus::bake

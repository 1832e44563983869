#include "bake/materials/texture_means.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "meshprep/base/image_colour.h"

namespace malus::bake {

namespace {

// Colours are encoded by sRGB, numbers are linear, and alpha always is. Blended colours are weighted by alpha.
enum class Role { colour, blendedColour, numbers };

using Mean = std::array<double, 4>;  // red, green, blue, alpha

Mean computeMean(const image::Image& image, Role role, const std::string& name) {
  const image::LinearColours colours(image, name, true);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const int alpha = image.channel("A");
  Mean sum{};
  double weights = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::array<double, 3> stored = colours.stored(i);
    const double a =
        alpha < 0 ? 1 : static_cast<double>(image.pixels[i * image.channels.size() + static_cast<std::size_t>(alpha)]);
    const double weight = role == Role::blendedColour ? std::clamp(a, 0.0, 1.0) : 1;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += weight * (role == Role::numbers ? stored[c] : image::decodeSrgb(stored[c]));
    sum[3] += a;
    weights += weight;
  }
  for (std::size_t c = 0; c < 3; ++c) sum[c] = weights > 0 ? sum[c] / weights : 0;
  sum[3] /= static_cast<double>(pixels);
  return sum;
}

// Means of the images of a file, each read once.
class TextureMeans {
 public:
  TextureMeans(prep::SourceScene& scene, bool strict) : scene_(scene), strict_(strict) {}

  // Returns nothing if the image cannot be read.
  std::optional<Mean> operator()(std::size_t image, Role role) {
    const auto [found, isNew] = means_.try_emplace({image, role});
    if (isNew) found->second = read(scene_.images[image], role);
    return found->second;
  }

 private:
  std::optional<Mean> read(const prep::SourceImage& source, Role role) {
    try {
      if (source.file.empty() && !source.bytes) return {};  // noted by the reader of the file
      const std::string name = source.bytes ? source.name : source.file.string();
      return computeMean(source.bytes ? image::readBytes(*source.bytes, name) : image::read(source.file), role, name);
    } catch (const Error& error) {
      if (strict_) throw;
      prep::addNote(scene_.notes, error.what());
      return {};
    }
  }

  prep::SourceScene& scene_;
  bool strict_;
  std::map<std::pair<std::size_t, Role>, std::optional<Mean>> means_;
};

glm::dvec3 toColour(const Mean& mean) { return {mean[0], mean[1], mean[2]}; }

}  // namespace

void applyTextureMeans(prep::SourceScene& scene, bool strict) {
  TextureMeans means(scene, strict);
  const auto take = [&](std::optional<std::size_t>& image, Role role) -> std::optional<Mean> {
    const std::optional<Mean> mean = image ? means(*image, role) : std::nullopt;
    if (!mean) image.reset();
    return mean;
  };
  for (prep::SourceMaterial& m : scene.materials) {
    const bool hasEmissiveImage = m.emissiveImage.has_value() && m.emissive != glm::dvec3(0.0);
    const bool blends = m.alphaMode == prep::AlphaMode::blend;
    if (const auto mean = take(m.baseColourImage, blends ? Role::blendedColour : Role::colour)) {
      m.baseColour *= toColour(*mean);
      if (blends) m.alpha *= std::clamp((*mean)[3], 0.0, 1.0);
    }
    if (const auto mean = take(m.metallicRoughnessImage, Role::numbers)) {
      m.roughness *= std::clamp((*mean)[1], 0.0, 1.0);
      m.metallic *= std::clamp((*mean)[2], 0.0, 1.0);
    }
    if (const auto mean = take(m.specularGlossinessImage, Role::colour)) {
      m.specularColour *= toColour(*mean);
      m.roughness = 1 - (1 - m.roughness) * std::clamp((*mean)[3], 0.0, 1.0);
    }
    if (const auto mean = take(m.transmissionImage, Role::numbers)) m.transmission *= std::clamp((*mean)[0], 0.0, 1.0);
    take(m.normalImage, Role::numbers);
    take(m.coverageImage, Role::numbers);
    const auto emission = take(m.emissiveImage, Role::colour);
    if (emission) {
      m.emissive *= toColour(*emission);
    } else if (hasEmissiveImage) {
      m.emissive = glm::dvec3(0.0);
      prep::addNote(scene.notes,
                    fmt::format("the emission of material '{}', whose emissive texture cannot be read", m.name));
    }
  }
}

}  // namespace malus::bake

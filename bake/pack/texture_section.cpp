#include "bake/pack/texture_section.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/format.h"
#include "bake/pack/mesh_maps.h"
#include "bake/pack/record_fields.h"
#include "bake/pack/texel_range.h"

namespace malus::pack {

namespace {

// Values of a list that texels name by one byte or two.
constexpr std::size_t kByteValues = 256, kMostValues = 65536;

// A channel in version 2: u32 number of values (0: too many), the values, and a number per texel; or the values alone.
void writeChannel(ByteWriter& w, const Texture& t, int channel) {
  std::map<float, std::uint32_t> numbers;
  for (const glm::vec3& texel : t.texels) {
    numbers.emplace(texel[channel], 0u);
    if (numbers.size() > kMostValues) break;
  }
  if (numbers.size() > kMostValues) {
    w.u32(0);
    for (const glm::vec3& texel : t.texels) w.f32(texel[channel]);
    return;
  }
  w.u32(static_cast<std::uint32_t>(numbers.size()));
  std::uint32_t next = 0;
  for (auto& [value, number] : numbers) number = next++, w.f32(value);
  for (const glm::vec3& texel : t.texels) {
    const std::uint32_t number = numbers.at(texel[channel]);
    const auto byte = static_cast<std::byte>(number & 0xffu);
    if (numbers.size() > kByteValues)
      w.u16(static_cast<std::uint16_t>(number));
    else
      w.raw({&byte, 1});
  }
}

bool isGrey(const Texture& t) {
  return std::ranges::all_of(t.texels, [](const glm::vec3& v) { return v.x == v.y && v.y == v.z; });
}

[[noreturn]] void failTexels(const ByteReader& r, const Texture& t, std::uint64_t bytes) {
  r.fail(fmt::format("texels of texture '{}'", t.name), fmt::format("{} bytes", bytes),
         fmt::format("{} left", r.left()));
}

float readValue(ByteReader& r, const Texture& t, double most) {
  const float value = r.f32();
  if (!(value >= 0 && value <= static_cast<float>(most)))
    r.fail(fmt::format("texel of texture '{}' is out of range", t.name), fmt::format("0 to {:g}", most),
           fmt::format("{}", value));
  return value;
}

void readFloats(ByteReader& r, std::uint64_t count, Texture& t) {
  if (count * 12 > r.left()) failTexels(r, t, count * 12);
  t.texels.resize(static_cast<std::size_t>(count));
  for (glm::vec3& texel : t.texels)
    for (int c = 0; c < 3; ++c) texel[c] = readValue(r, t, kMaxEta);
}

void readChannel(ByteReader& r, int channel, Texture& t) {
  const std::uint32_t size = r.u32AtMost(kMostValues, "number of values of a texture");
  const std::uint64_t texelBytes = size == 0            ? 4
                                   : size > kByteValues ? 2
                                                        : 1,
                      bytes = std::uint64_t{size} * 4 + texelBytes * t.texels.size();
  if (bytes > r.left()) failTexels(r, t, bytes);
  std::vector<float> values;
  for (std::uint32_t i = 0; i < size; ++i) values.push_back(readValue(r, t, kMaxLight));
  for (glm::vec3& texel : t.texels) {
    if (size == 0) {
      texel[channel] = readValue(r, t, kMaxLight);
      continue;
    }
    const std::uint32_t number = texelBytes == 2 ? r.u16() : std::to_integer<std::uint32_t>(r.raw(1)[0]);
    if (number >= size)
      r.fail(fmt::format("number of a texel of texture '{}'", t.name), fmt::format("less than {}", size),
             fmt::format("{}", number));
    texel[channel] = values[number];
  }
}

void readChannels(ByteReader& r, std::uint64_t count, Texture& t) {
  const std::uint32_t channels = r.u32();
  if (channels != 1 && channels != 3)
    r.fail(fmt::format("channels of texture '{}'", t.name), "1 or 3", fmt::format("{}", channels));
  if (count > r.left()) failTexels(r, t, count);
  t.texels.resize(static_cast<std::size_t>(count));
  for (std::uint32_t c = 0; c < channels; ++c) readChannel(r, static_cast<int>(c), t);
  if (channels == 1)
    for (glm::vec3& texel : t.texels) texel = glm::vec3(texel.x);
}

}  // namespace

std::vector<TexelRange> findTexelRanges(const std::vector<Texture>& textures) {
  std::vector<TexelRange> ranges;
  for (const Texture& texture : textures) {
    TexelRange range{texture.texels[0].x, texture.texels[0].x};
    for (const glm::vec3& t : texture.texels) {
      range.low = std::min({range.low, t.x, t.y, t.z});
      range.high = std::max({range.high, t.x, t.y, t.z});
    }
    ranges.push_back(range);
  }
  return ranges;
}

std::uint32_t texturesVersion(const std::vector<Material>& materials) { return hasMeshMaps(materials) ? 2 : 1; }

void writeTextures(ByteWriter& w, std::uint32_t version, const std::vector<Texture>& textures) {
  w.u32(static_cast<std::uint32_t>(textures.size()));
  for (const Texture& t : textures) {
    visitTexture(FieldWriter(w), t);
    if (version == 1) {
      for (const glm::vec3& texel : t.texels) w.f32(texel.x), w.f32(texel.y), w.f32(texel.z);
      continue;
    }
    const int channels = isGrey(t) ? 1 : 3;
    w.u32(static_cast<std::uint32_t>(channels));
    for (int c = 0; c < channels; ++c) writeChannel(w, t, c);
  }
}

void readTextures(ByteReader r, std::uint32_t version, std::vector<Texture>& textures) {
  FieldSizes sizes;
  const Texture any{};
  visitTexture(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes() + 9, kMaxTextures, "number of textures");
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Texture& texture = textures.emplace_back();
    visitTexture(FieldReader(r), texture);
    const std::uint64_t texels = std::uint64_t{texture.width} * texture.height;
    total += texels;
    if (total > kMaxTexels)
      r.fail("number of texels", fmt::format("at most {} in all textures", kMaxTexels), fmt::format("{}", total));
    if (version == 1)
      readFloats(r, texels, texture);
    else
      readChannels(r, texels, texture);
  }
  r.end();
}

}  // namespace malus::pack

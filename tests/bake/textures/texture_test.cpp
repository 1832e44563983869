// Textures of material parameters.
#include "bake/textures/texture.h"

#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using Transfer = image::Encoding::Transfer;

pack::Texture baked(const image::Image& image, const TextureDescription& description) {
  std::vector<std::string> notes;
  return bakeTexture(image, description, "a", notes);
}

image::Image makeImage(std::vector<std::string> channels, std::vector<float> pixels, Transfer transfer) {
  image::Image image;
  image.height = 1;
  image.width = static_cast<int>(pixels.size() / channels.size());
  image.channels = std::move(channels);
  image.pixels = std::move(pixels);
  image.encoding.transfer = transfer;
  return image;
}

TEST(Texture, AlbedoIsDecodedFromSrgb) {
  const TextureDescription albedo{"a.png", 1, 0, 0, 1, false};
  const pack::Texture t = baked(makeImage({"R", "G", "B", "A"}, {0.5f, 0.04f, 1, 0.3f}, Transfer::sRgb), albedo);
  ASSERT_EQ(t.texels.size(), 1u);
  EXPECT_NEAR(t.texels[0].x, 0.214041, 1e-6);  // IEC 61966-2-1
  EXPECT_NEAR(t.texels[0].y, 0.04 / 12.92, 1e-7);
  EXPECT_EQ(t.texels[0].z, 1);
  EXPECT_EQ(baked(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 1}, Transfer::linear), albedo).texels[0],
            glm::vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(baked(makeImage({"Y"}, {0.5f, 0.25f}, Transfer::linear), albedo).texels[1], glm::vec3(0.25f));
}

TEST(Texture, IndicesAreLinear) {
  // A dielectric uses the green channel, without decoding sRGB.
  const TextureDescription eta{"b.png", 2, 1, pack::kMinEta, pack::kMaxEta, true};
  EXPECT_EQ(baked(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 1}, Transfer::sRgb), eta).texels[0], glm::vec3(1.5f));
  const TextureDescription metal{"c.exr", 1, 0, 0, pack::kMaxEta, false};
  EXPECT_EQ(baked(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 3}, Transfer::linear), metal).texels[0],
            glm::vec3(0.5f, 0.25f, 3));
}

TEST(Texture, AlphaIsLeftOutWithANote) {
  const TextureDescription albedo{"a.png", 1, 0, 0, 1, false};
  std::vector<std::string> notes;
  for (const float alpha : {0.0f, 0.5f, 1.0f}) {
    notes.clear();
    const image::Image image = makeImage({"R", "G", "B", "A"}, {1, 1, 1, alpha}, Transfer::sRgb);
    EXPECT_EQ(bakeTexture(image, albedo, "a", notes).texels[0], glm::vec3(1));
    EXPECT_EQ(notes.size(), alpha < 1 ? 1u : 0u);
  }
  bakeTexture(makeImage({"Y", "A"}, {1, 0}, Transfer::sRgb), albedo, "a", notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_CONTAINS(notes[0], "alpha");
}

TEST(Texture, InvalidNumbersAreErrors) {
  const TextureDescription albedo{"a.exr", 1, 0, 0, 1, false};
  for (const float bad :
       {1.5f, -0.5f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const std::string error = test::errorMessage([&] {
      baked(makeImage({"R", "G", "B"}, {0, 0, 0, 0, bad, 0}, Transfer::linear), albedo);
    });
    EXPECT_CONTAINS(error, "a.exr");
    EXPECT_CONTAINS(error, "at (1, 0)");
  }
}

}  // namespace
}  // namespace malus::bake

// Textures of material parameters.
#include "bake/textures/texture.h"

#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

image::Image makeImage(std::vector<std::string> channels, std::vector<float> pixels, const char* space) {
  image::Image image;
  image.height = 1;
  image.width = static_cast<int>(pixels.size() / channels.size());
  image.channels = std::move(channels);
  image.pixels = std::move(pixels);
  if (space) image.attributes.emplace_back("oiio:ColorSpace", std::string(space));
  return image;
}

TEST(Texture, AlbedoIsDecodedFromSrgb) {
  const TextureDescription albedo{"a.png", 1, 0, 0, 1, false};
  const pack::Texture t = bakeTexture(makeImage({"R", "G", "B", "A"}, {0.5f, 0.04f, 1, 0.3f}, "sRGB"), albedo, "a");
  ASSERT_EQ(t.texels.size(), 1u);
  EXPECT_NEAR(t.texels[0].x, 0.214041, 1e-6);  // IEC 61966-2-1
  EXPECT_NEAR(t.texels[0].y, 0.04 / 12.92, 1e-7);
  EXPECT_EQ(t.texels[0].z, 1);
  EXPECT_EQ(bakeTexture(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 1}, "Linear"), albedo, "a").texels[0],
            glm::vec3(0.5f, 0.25f, 1));
  EXPECT_EQ(bakeTexture(makeImage({"Y"}, {0.5f, 0.25f}, nullptr), albedo, "a").texels[1], glm::vec3(0.25f));
}

TEST(Texture, IndicesAreLinear) {
  // A dielectric uses the green channel, without decoding sRGB.
  const TextureDescription eta{"b.png", 2, 1, pack::kMinEta, pack::kMaxEta, true};
  EXPECT_EQ(bakeTexture(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 1}, "sRGB"), eta, "b").texels[0], glm::vec3(1.5f));
  const TextureDescription metal{"c.exr", 1, 0, 0, pack::kMaxEta, false};
  EXPECT_EQ(bakeTexture(makeImage({"R", "G", "B"}, {0.5f, 0.25f, 3}, nullptr), metal, "c").texels[0],
            glm::vec3(0.5f, 0.25f, 3));
}

TEST(Texture, InvalidNumbersAreErrors) {
  const TextureDescription albedo{"a.exr", 1, 0, 0, 1, false};
  for (const float bad :
       {1.5f, -0.5f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const std::string error = test::errorMessage([&] {
      bakeTexture(makeImage({"R", "G", "B"}, {0, 0, 0, 0, bad, 0}, nullptr), albedo, "a");
    });
    EXPECT_CONTAINS(error, "a.exr");
    EXPECT_CONTAINS(error, "at (1, 0)");
  }
}

}  // namespace
}  // namespace malus::bake

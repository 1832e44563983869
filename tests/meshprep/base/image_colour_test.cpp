// Linear colours of images against published values.
#include "meshprep/base/image_colour.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/messages.h"

namespace malus::image {
namespace {

using Transfer = Encoding::Transfer;

Image pixel(std::vector<std::string> channels, std::vector<float> values, Transfer transfer = Transfer::linear) {
  Image image;
  image.width = image.height = 1;
  image.channels = std::move(channels);
  image.pixels = std::move(values);
  image.encoding.transfer = transfer;
  return image;
}

TEST(ImageColour, TransferFunctions) {
  Image image = pixel({"R", "G", "B"}, {0.5f, 0.04f, 1}, Transfer::sRgb);
  EXPECT_NEAR(LinearColours(image, "").at(0)[0], 0.214041, 1e-6);  // IEC 61966-2-1
  EXPECT_NEAR(LinearColours(image, "").at(0)[1], 0.04 / 12.92, 1e-7);
  EXPECT_EQ(LinearColours(image, "").at(0)[2], 1);
  EXPECT_EQ(LinearColours(image, "").stored(0)[0], 0.5);
  image.encoding.transfer = Transfer::power;
  image.encoding.exponent = 2.2;
  EXPECT_NEAR(LinearColours(image, "").at(0)[0], std::pow(0.5, 2.2), 1e-7);
  image.encoding.transfer = Transfer::linear;
  EXPECT_EQ(LinearColours(image, "").at(0)[0], 0.5);
}

TEST(ImageColour, ChannelsByName) {
  using Triple = std::array<double, 3>;
  EXPECT_EQ(LinearColours(pixel({"A", "b", "G", "r", "Z"}, {1, 2, 3, 4, 5}), "").at(0), (Triple{4, 3, 2}));
  for (const auto& grey :
       {pixel({"Y"}, {2}), pixel({"Y", "A"}, {2, 1}), pixel({"mask"}, {2}), pixel({"X", "Y", "Z"}, {1, 2, 3})}) {
    const LinearColours colours(grey, "");
    EXPECT_TRUE(colours.isGrey());
    EXPECT_EQ(colours.at(0), (Triple{2, 2, 2}));
  }
  EXPECT_EQ(LinearColours(pixel({"Y"}, {2}), "").notes().size(), 0u);
  EXPECT_EQ(LinearColours(pixel({"Z"}, {2}), "").notes().size(), 1u);  // perhaps no colour
  for (const auto& other : {pixel({"U", "V", "W"}, {1, 2, 3}), pixel({"R", "G"}, {1, 2}),
                            pixel({"R", "B", "A"}, {1, 2, 1}), pixel({"BY", "RY", "Y"}, {0.1f, 0.2f, 1})})
    EXPECT_CONTAINS(test::errorMessage([&] { LinearColours(other, "a.exr"); }), "a.exr");
}

// ACES2065-1 to linear Rec. 709 with Bradford's adaptation from D60 to D65 (ACES, TB-2014-004 and CTL of its output
// transforms): the matrix that colour-science and OpenColorIO's ACES configuration publish.
TEST(ImageColour, ChromaticitiesAreConverted) {
  constexpr double kExpected[3][3] = {
      {2.52169, -1.13413, -0.38756}, {-0.27648, 1.37272, -0.09624}, {-0.01538, -0.15298, 1.16835}};
  for (std::size_t j = 0; j < 3; ++j) {
    Image image = pixel({"R", "G", "B"}, {4, 4, 4});  // over an amount that keeps every value positive
    image.pixels[j] += 1;
    image.encoding.chromaticities = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};
    const LinearColours colours(image, "a.exr");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(colours.at(0)[i] - 4, kExpected[i][j], 2e-3) << i << j;
    EXPECT_EQ(colours.notes().size(), 1u);
  }
}

TEST(ImageColour, ColoursOutOfGamutAreClippedWithANote) {
  Image image = pixel({"R", "G", "B"}, {1, 0, 0});
  image.encoding.chromaticities = {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};  // Rec. 2020
  const LinearColours colours(image, "a.exr");
  EXPECT_NEAR(colours.at(0)[0], 1.6605, 1e-3);  // ITU-R BT.2087-0
  EXPECT_EQ(colours.at(0)[1], 0);
  ASSERT_EQ(colours.notes().size(), 1u);
  EXPECT_CONTAINS(colours.notes()[0], "1 of 1");
  image.encoding.chromaticities = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};  // Rec. 709
  EXPECT_EQ(LinearColours(image, "").at(0)[0], 1);
  EXPECT_TRUE(LinearColours(image, "").notes().empty());
  image.encoding.chromaticities = {0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3};
  EXPECT_CONTAINS(test::errorMessage([&] { LinearColours(image, "a.exr"); }), "plane");
}

TEST(ImageColour, MakeLinear) {
  Image image = pixel({"R", "G", "B", "A"}, {0.5f, 0.5f, 0.5f, 0.5f}, Transfer::sRgb);
  image.encoding.notes = {"has a property"};
  EXPECT_EQ(makeLinear(image, "a.png").size(), 2u);
  EXPECT_NEAR(image.pixels[1], 0.214041f, 1e-6f);
  EXPECT_EQ(image.pixels[3], 0.5f);
  EXPECT_TRUE(makeLinear(image, "a.png", true).empty());  // linear now, and alpha is read
  EXPECT_NEAR(image.pixels[1], 0.214041f, 1e-6f);
  Image depth = pixel({"U", "V", "W"}, {5, 6, 7}, Transfer::sRgb);
  EXPECT_TRUE(makeLinear(depth, "a.exr").empty());
  EXPECT_EQ(depth.pixels[0], 5);
}

}  // namespace
}  // namespace malus::image

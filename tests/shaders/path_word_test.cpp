// Path words: hashes of pixels and paths.
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include <gtest/gtest.h>

#include "shaders/optics/optics.h"

namespace malus {
namespace {

TEST(PathWordTest, DiffersBetweenNeighboursPathsAndFacets) {
  // 14 bits: two words are equal by chance once in 16384.
  const std::uint32_t start = f32::pathStart(10, 20);
  std::set<std::uint32_t> words = {start, f32::reflectedPath(start), f32::transmittedPath(start)};
  for (std::uint32_t i = 0; i < 16; ++i) words.insert(f32::facetPath(start, i));
  for (std::uint32_t i = 0; i < 8; ++i) words.insert(f32::pathStart(100 + i, 20)), words.insert(f32::pathStart(10, i));
  EXPECT_GE(words.size(), 33u);
  EXPECT_NE(f32::reflectedPath(f32::transmittedPath(start)), f32::transmittedPath(f32::reflectedPath(start)));
}

TEST(PathWordTest, IsANormalFloatAndPassesTheLowerHalfOn) {
  for (std::uint32_t x = 0; x < 200; ++x)
    for (std::uint32_t y = 0; y < 200; ++y) {
      const std::uint32_t path = f32::pathStart(x, y);
      ASSERT_TRUE(std::isnormal(f32::floatValue(path))) << x << ' ' << y;
      ASSERT_EQ(f32::lowHalf(path), 0u);
      const std::uint32_t marked = f32::joinWord(x * 256 + y, f32::highHalf(path));
      ASSERT_EQ(f32::lowHalf(f32::reflectedPath(marked)), x * 256 + y);
      ASSERT_EQ(f32::highHalf(f32::reflectedPath(marked)), f32::highHalf(f32::reflectedPath(path)));
    }
}

// The rotations of the pixels of an image and of the paths from one pixel fill the unit square evenly: counts in 8 x 8
// cells within 8
// standard deviations; 14 bits of hash repeat, which adds to them.
TEST(PathWordTest, RotationsAreUniform) {
  constexpr double kCount = 65536;
  std::array<std::array<int, 64>, 2> counts{};
  const auto add = [](std::array<int, 64>& cells, std::uint32_t path) {
    float u, v;
    f32::pathRotation(path, 1, u, v);
    ASSERT_TRUE(u >= 0 && u < 1 && v >= 0 && v < 1);
    ++cells[static_cast<std::size_t>(u * 8) * 8 + static_cast<std::size_t>(v * 8)];
  };
  for (std::uint32_t i = 0; i < 65536; ++i) {
    add(counts[0], f32::pathStart(i % 256, i / 256));
    add(counts[1], f32::facetPath(f32::pathStart(i / 16, 7), i % 16));
  }
  const double mean = kCount / 64;
  for (const auto& cells : counts)
    for (const int n : cells) EXPECT_NEAR(n, mean, 8 * std::sqrt(mean));
}

}  // namespace
}  // namespace malus

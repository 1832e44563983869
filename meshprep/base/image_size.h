// Limits of the size of an image, which image.h documents. A header of a few bytes can declare any size, so it is
// checked before memory is allocated.
#pragma once

#include <cstdint>
#include <string>

namespace malus::image {

inline constexpr int kMaxSide = 65536;
inline constexpr int kMaxChannels = 64;
inline constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 30;  // 4 GiB
// No codec stores more values per byte of a file: Zstandard stores 131072 equal bytes in 4, deflate 1032 in 1, each
// with up to 8 pixels of 1 bit.
inline constexpr std::uint64_t kMaxValuesPerByte = 32768;

struct ImageSize {
  std::int64_t width = 0, height = 0;
  std::int64_t channels = 1;
};

// Returns an empty string if a file of this many bytes may have an image, or a tile, of the size; otherwise the reason.
std::string checkSize(const ImageSize& size, std::uint64_t fileBytes);

}  // namespace malus::image

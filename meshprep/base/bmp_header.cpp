#include "meshprep/base/bmp_header.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "meshprep/base/image_module.h"

namespace malus::image {

namespace {

constexpr std::size_t kInfoHeader = 14;        // offset; begins with its size
constexpr std::size_t kShortHeaderBytes = 12;  // of OS/2, with 16-bit sizes
constexpr std::size_t kLeastBytes = 26;

std::uint32_t littleEndian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8u | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

}  // namespace

bool isSupportedBmp(std::string_view start, std::uint64_t fileBytes) {
  if (!start.starts_with("BM") || start.size() < kLeastBytes) return true;
  std::int64_t width = 0, height = 0;
  if (littleEndian(start, kInfoHeader, 4) == kShortHeaderBytes) {
    width = littleEndian(start, kInfoHeader + 4, 2);
    height = littleEndian(start, kInfoHeader + 6, 2);
  } else {
    // The height is negative if the first row is the top one.
    width = static_cast<std::int32_t>(littleEndian(start, kInfoHeader + 4, 4));
    height = std::abs(std::int64_t{static_cast<std::int32_t>(littleEndian(start, kInfoHeader + 8, 4))});
  }
  return width >= 0 && std::max(width, height) <= kMaxSide &&
         static_cast<std::uint64_t>(width * height) <= mostValues(fileBytes);
}

}  // namespace malus::image

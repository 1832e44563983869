#include "meshprep/base/image_size.h"

#include <algorithm>

#include <fmt/format.h>

namespace malus::image {

std::string checkSize(const ImageSize& size, std::uint64_t fileBytes) {
  const std::uint64_t most = fileBytes > kMaxValues / kMaxValuesPerByte ? kMaxValues : fileBytes * kMaxValuesPerByte;
  const auto isWithin = [](std::int64_t value, std::int64_t high) { return value >= 1 && value <= high; };
  if (isWithin(size.width, kMaxSide) && isWithin(size.height, kMaxSide) && isWithin(size.channels, kMaxChannels) &&
      static_cast<std::uint64_t>(size.width * size.height * size.channels) <= most)
    return {};
  return fmt::format(
      "unsupported size {} x {} with {} channels; expected 1 to {} pixels per side, 1 to {} channels, and at most {} "
      "values in a file of {} bytes",
      size.width, size.height, size.channels, kMaxSide, kMaxChannels, most, fileBytes);
}

}  // namespace malus::image

#include "meshprep/base/orientation.h"

#include <algorithm>
#include <utility>

namespace malus::image {

void applyOrientation(Image& image, int orientation) {
  if (orientation < 2 || orientation > 8) return;
  const bool isTransposed = orientation >= 5;
  const bool fromRight = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool fromBottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  const int rows = image.height, columns = image.width;
  if (isTransposed) std::swap(image.width, image.height);
  const std::size_t channels = image.channels.size();
  std::vector<float> turned(image.pixels.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      int x = isTransposed ? r : c, y = isTransposed ? c : r;
      if (fromRight) x = image.width - 1 - x;
      if (fromBottom) y = image.height - 1 - y;
      const std::size_t from = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                               static_cast<std::size_t>(c),
                        to = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x);
      std::copy_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(from * channels), channels,
                  turned.begin() + static_cast<std::ptrdiff_t>(to * channels));
    }
  image.pixels = std::move(turned);
}

}  // namespace malus::image

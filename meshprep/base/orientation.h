// Orientation of stored rows (Exif 2.3, tag 0x0112): where the first row and the first pixel of a row are in the image.
#pragma once

#include "meshprep/base/image.h"

namespace malus::image {

// Turns an image whose rows are stored by an orientation into rows from the top, pixels from the left: 1 is that order;
// the first row and column are 2 top right, 3 bottom right, 4 bottom left, 5 left top, 6 right top, 7 right bottom, 8
// left bottom. Other values do nothing.
void applyOrientation(Image& image, int orientation);

}  // namespace malus::image

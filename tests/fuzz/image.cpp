// Fuzzes the image reader of every format and the conversion to linear colours. An image that is read is complete.
#include <algorithm>
#include <cstdlib>

#include "meshprep/base/error.h"
#include "meshprep/base/image_colour.h"
#include "meshprep/base/image_module.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/temporary.h"

extern "C" const malus::image::Module* malusImageModule();
extern "C" const malus::image::FormatsModule* malusFormatsModule();

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  malus::image::Image image;
  // Formats are recognized by their contents, whatever the extension.
  const std::string file = writeTemporary(data, size, ".image");
  char start[8] = {};
  std::copy_n(data, std::min(size, sizeof start), start);
  const auto read =
      malus::image::startsAsExrOrPng({start, sizeof start}) ? malusImageModule()->read : malusFormatsModule()->read;
  if (!read(file, image).empty()) return 0;
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (width == 0 || height == 0 || image.pixels.size() != width * height * image.channels.size()) std::abort();
  try {
    malus::image::makeLinear(image, "image");
  } catch (const malus::Error&) {
  }
  return 0;
}

// The module of EXR and PNG files, by OpenEXR and libpng: without OpenImageIO, which takes 0.2 s to load.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

#include "meshprep/base/exr_file.h"
#include "meshprep/base/image_module.h"
#include "meshprep/base/png_file.h"

namespace malus::image {

namespace {

std::string readImage(const std::string& path, Image& image) {
  try {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return std::strerror(errno);
    std::vector<unsigned char> bytes(static_cast<std::size_t>(file.tellg()));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return isExr(bytes) ? decodeExr(bytes, image) : decodePng(bytes, image);
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string encodePngImage(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes) {
  return encodePng({width, height, channels, 8, PngTransfer::sRgb, "", pixels}, bytes);
}

std::string encodeGreyPngImage(const GreyPixels& grey, std::vector<unsigned char>& bytes) {
  try {
    PngPixels pixels{grey.width,
                     grey.height,
                     1,
                     16,
                     PngTransfer::linear,
                     grey.description,
                     reinterpret_cast<const std::uint8_t*>(grey.values)};
    std::vector<std::uint8_t> narrow;
    if (grey.depth == GreyDepth::bits8) {
      narrow.resize(static_cast<std::size_t>(grey.width) * static_cast<std::size_t>(grey.height));
      for (std::size_t i = 0; i < narrow.size(); ++i) narrow[i] = static_cast<std::uint8_t>(grey.values[i]);
      pixels.bits = 8;
      pixels.data = narrow.data();
    }
    return encodePng(pixels, bytes);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  }
}

}  // namespace
}  // namespace malus::image

extern "C" __attribute__((visibility("default"))) const malus::image::Module* malusImageModule() {
  static const malus::image::Module kModule = {malus::image::readImage, malus::image::writeExrFile,
                                               malus::image::encodePngImage, malus::image::encodeGreyPngImage};
  return &kModule;
}

// The image module of the bundle: EXR and PNG by OpenEXR and libpng, without OpenImageIO.
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <span>

#include <fmt/format.h>

#include "meshprep/base/exr_file.h"
#include "meshprep/base/image_module.h"
#include "meshprep/base/png_file.h"

namespace malus::image {

namespace {

std::string readImage(const std::string& path, Image& image) {
  try {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::strerror(errno);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    if (isExr(bytes)) return decodeExr(bytes, image);
    if (isPng(bytes)) return decodePng(bytes, image);
    return "unsupported format; this malus reads EXR and PNG, a malus with OpenImageIO reads others";
  } catch (const std::exception& error) {
    return error.what();
  }
}

// Into the existing file. Buffers are flushed, so that a full disk is reported.
std::string writeBytes(const std::string& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return file ? std::string() : std::string(std::strerror(errno));
}

std::string writeExrImage(const std::string& path, const Image& image) {
  std::string bytes;
  std::string problem = encodeExr(image, bytes);
  if (problem.empty()) problem = writeBytes(path, bytes);
  return problem;
}

std::string encodePngImage(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes) {
  return encodePng({width, height, channels, 8, PngTransfer::sRgb, "", pixels}, bytes);
}

std::string writeGreyImage(const std::string& path, int width, int height, GreyDepth depth, const std::uint16_t* values,
                           const std::string& description) {
  if (!path.ends_with(".png")) return "unsupported format; this malus writes PNG, a malus with OpenImageIO also TIFF";
  try {
    std::vector<std::uint8_t> narrow;
    PngPixels pixels{
        width, height, 1, 16, PngTransfer::linear, description, reinterpret_cast<const std::uint8_t*>(values)};
    if (depth == GreyDepth::bits8) {
      const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
      for (std::size_t i = 0; i < count; ++i) narrow.push_back(static_cast<std::uint8_t>(values[i]));
      pixels.bits = 8;
      pixels.data = narrow.data();
    }
    std::vector<unsigned char> bytes;
    std::string problem = encodePng(pixels, bytes);
    if (problem.empty()) problem = writeBytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return problem;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  }
}

}  // namespace
}  // namespace malus::image

extern "C" __attribute__((visibility("default"))) const malus::image::Module* malusImageModule() {
  static const malus::image::Module kModule = {malus::image::readImage, malus::image::writeExrImage,
                                               malus::image::encodePngImage, malus::image::writeGreyImage};
  return &kModule;
}

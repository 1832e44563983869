#include "meshprep/base/png_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <png.h>

#include "meshprep/base/icc_profile.h"
#include "meshprep/base/image_size.h"

namespace malus::image {

namespace {

static_assert(std::endian::native == std::endian::little, "samples of 16 bits are swapped from PNG's byte order");

struct Source {
  const std::vector<unsigned char>* bytes;
  std::size_t at = 0;
};

// libpng reports errors by a call that must not return: the message is kept and the caller continues at its setjmp.
// Functions that call setjmp have no local objects with destructors.
void keepError(png_structp png, png_const_charp message) {
  static_cast<std::string*>(png_get_error_ptr(png))->assign(message);
  png_longjmp(png, 1);
}
void ignoreWarning(png_structp, png_const_charp) {}

void readBytes(png_structp png, png_bytep out, std::size_t count) {
  Source& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.bytes->size() - source.at) png_error(png, "the file is truncated");
  std::memcpy(out, source.bytes->data() + source.at, count);
  source.at += count;
}
void appendBytes(png_structp png, png_bytep data, std::size_t count) {
  auto& bytes = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), data, data + count);
}
void flushNothing(png_structp) {}

// Pixels as in the file, after the expansion of palettes and small depths.
struct Decoded {
  int width = 0, height = 0, channels = 0, bits = 0;
  std::vector<unsigned char> samples;
  std::vector<png_bytep> rows;
};

// False: error has the reason.
bool readHeader(png_structp png, png_infop info, Decoded& out) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kMaxSide, kMaxSide);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  out.width = static_cast<int>(png_get_image_width(png, info));
  out.height = static_cast<int>(png_get_image_height(png, info));
  out.channels = png_get_channels(png, info);
  out.bits = png_get_bit_depth(png, info);
  return true;
}

bool readRows(png_structp png, Decoded& out) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, out.rows.data());
  png_read_end(png, nullptr);
  return true;
}

// libpng checks the chunks: values that are 0 or negative are not valid.
Encoding readEncoding(png_structp png, png_infop info) {
  Encoding encoding;
  encoding.transfer = Encoding::Transfer::sRgb;
  int intent = 0;
  if (png_get_sRGB(png, info, &intent) != 0) return encoding;
  png_charp name = nullptr;
  png_bytep profile = nullptr;
  png_uint_32 size = 0;
  int compression = 0;
  if (png_get_iCCP(png, info, &name, &compression, &profile, &size) != 0) {
    if (!isSrgbProfile({profile, size})) encoding.notes.emplace_back(kForeignProfile);
    return encoding;
  }
  double gamma = 0;
  if (png_get_gAMA(png, info, &gamma) != 0 && gamma > 0) {
    encoding.transfer = gamma == 1 ? Encoding::Transfer::linear : Encoding::Transfer::power;
    encoding.exponent = 1 / gamma;
  }
  std::array<double, 8> c{};
  if (png_get_cHRM(png, info, &c[6], &c[7], &c[0], &c[1], &c[2], &c[3], &c[4], &c[5]) != 0) encoding.chromaticities = c;
  return encoding;
}

// Coding-independent code points (ITU-T H.273) of the chunk cICP, which precedes all others (PNG, third edition, 4.3)
// and which libpng does not read.
void readCodePoints(const std::vector<unsigned char>& bytes, Encoding& encoding) {
  const auto text = [&](std::size_t at) { return std::string_view(reinterpret_cast<const char*>(&bytes[at]), 4); };
  std::size_t at = 8, length = 0;
  for (; at + 16 <= bytes.size(); at += 12 + length) {
    length = std::size_t{bytes[at]} << 24u | std::size_t{bytes[at + 1]} << 16u | std::size_t{bytes[at + 2]} << 8u |
             bytes[at + 3];
    if (text(at + 4) == "IDAT") return;
    if (text(at + 4) == "cICP" && length == 4) break;
  }
  if (at + 16 > bytes.size()) return;
  const unsigned primaries = bytes[at + 8], transfer = bytes[at + 9];
  constexpr unsigned kLinear = 8, kSrgb = 13, kRec709 = 1, kRec2020 = 9, kP3 = 12;
  encoding = {};
  encoding.transfer = transfer == kLinear ? Encoding::Transfer::linear : Encoding::Transfer::sRgb;
  if (primaries == kRec2020)
    encoding.chromaticities = {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};
  else if (primaries == kP3)
    encoding.chromaticities = {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
  if (transfer != kLinear && transfer != kSrgb)
    encoding.notes.push_back(fmt::format("has the transfer function {} (cICP), and is read as sRGB", transfer));
  if (primaries != kRec709 && primaries != kRec2020 && primaries != kP3)
    encoding.notes.push_back(fmt::format("has the primaries {} (cICP), and is read as Rec. 709", primaries));
}

// Uncompressed and compressed text under its keyword; "Description" is the ImageDescription of other formats.
void readText(png_structp png, png_infop info, Image& image) {
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) {
    const std::string key = texts[i].key;
    image.attributes.emplace_back(key == "Description" ? "ImageDescription" : key, std::string(texts[i].text));
  }
}

template <typename Sample>
void convert(Decoded& decoded, Image& image) {
  const auto* data = reinterpret_cast<const Sample*>(decoded.samples.data());
  const std::size_t pixels = static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height);
  constexpr float kScale = 1.0f / static_cast<float>(std::numeric_limits<Sample>::max());
  image.pixels.resize(pixels * static_cast<std::size_t>(decoded.channels));
  std::transform(data, data + image.pixels.size(), image.pixels.begin(),
                 [](Sample s) { return static_cast<float>(s) * kScale; });
}

std::string decode(png_structp png, png_infop info, std::size_t fileBytes, const std::string& error, Image& image) {
  Decoded decoded;
  if (!readHeader(png, info, decoded)) return error;
  if (std::string problem = checkSize({decoded.width, decoded.height, decoded.channels}, fileBytes); !problem.empty())
    return problem;
  const std::size_t rowBytes = png_get_rowbytes(png, info), height = static_cast<std::size_t>(decoded.height);
  decoded.samples.resize(rowBytes * height);
  for (std::size_t y = 0; y < height; ++y) decoded.rows.push_back(decoded.samples.data() + y * rowBytes);
  if (!readRows(png, decoded)) return error;
  constexpr const char* kNames[] = {"Y", "A", "R", "G", "B"};
  image.encoding = readEncoding(png, info);
  readText(png, info, image);
  image.width = decoded.width;
  image.height = decoded.height;
  if (decoded.channels < 3)
    image.channels.assign(kNames, kNames + decoded.channels);
  else
    image.channels.assign(kNames + 2, kNames + 5);
  if (decoded.channels == 4) image.channels.emplace_back("A");
  if (decoded.bits == 16)
    convert<std::uint16_t>(decoded, image);
  else
    convert<std::uint8_t>(decoded, image);
  return {};
}

bool writeRows(png_structp png, png_infop info, const PngPixels& p, std::vector<png_bytep>& rows, png_text& text) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(p.width), static_cast<png_uint_32>(p.height), p.bits,
               p.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (p.transfer == PngTransfer::sRgb)
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  else
    png_set_gAMA(png, info, 1.0);
  if (text.text_length > 0) png_set_text(png, info, &text, 1);
  // scenes/engine at 2048 x 2048: 46 ms and 1.44 MB; by the defaults of libpng 210 ms and 1.42 MB.
  constexpr int kLevel = 3;
  png_set_compression_level(png, kLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_write_info(png, info);
  png_set_swap(png);
  png_write_image(png, rows.data());
  png_write_end(png, info);
  return true;
}

}  // namespace

bool isPng(const std::vector<unsigned char>& bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

std::string decodePng(const std::vector<unsigned char>& bytes, Image& image) {
  std::string error = "damaged file";
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, keepError, ignoreWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return "out of memory";
  }
  Source source{&bytes};
  png_set_read_fn(png, &source, readBytes);
  std::string result;
  try {
    result = decode(png, info, bytes.size(), error, image);
    if (result.empty()) readCodePoints(bytes, image.encoding);
  } catch (const std::bad_alloc&) {
    result = "out of memory";
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return result;
}

std::string encodePng(const PngPixels& pixels, std::vector<unsigned char>& bytes) {
  std::string error = "cannot encode";
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, keepError, ignoreWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_write_struct(&png, nullptr);
    return "out of memory";
  }
  png_set_write_fn(png, &bytes, appendBytes, flushNothing);
  const std::size_t rowBytes = static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.channels) *
                               static_cast<std::size_t>(pixels.bits / 8);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < static_cast<std::size_t>(pixels.height); ++y)
    rows.push_back(const_cast<png_bytep>(pixels.data + y * rowBytes));
  std::string key = "Description", value = pixels.description;
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = key.data();
  text.text = value.data();
  text.text_length = value.size();
  const bool written = writeRows(png, info, pixels, rows, text);
  png_destroy_write_struct(&png, &info);
  return written ? std::string() : error;
}

}  // namespace malus::image

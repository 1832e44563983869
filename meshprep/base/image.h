// Images in memory and in files. EXR and PNG are read and written by OpenEXR and libpng, in a module that is loaded
// with the first image (image_module.h). Other formats are read by OpenImageIO, in a second module, because it depends
// on about 260 shared libraries; the bundle does not have it.
//
// All functions throw Error if a module or the file cannot be read or written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace malus::image {

// Encoding of the stored colours of an image, from the format and the metadata of its file. Floats are linear.
// Integers are sRGB (IEC 61966-2-1) unless the file states another transfer function. image_colour.h decodes them.
struct Encoding {
  enum class Transfer { linear, sRgb, power };
  Transfer transfer = Transfer::linear;
  double exponent = 1;  // of Transfer::power: linear = stored ^ exponent
  // CIE x and y of red, green, blue and white; nothing: those of Rec. 709, which sRGB has.
  std::optional<std::array<double, 8>> chromaticities;
  // Metadata that is not applied, each as the predicate of a sentence: "has an ICC profile other than sRGB, ...".
  std::vector<std::string> notes;
};

// Image of 32-bit floats.
struct Image {
  int width = 0;
  int height = 0;
  // Names as in the file, for instance "R" or "S1.G".
  std::vector<std::string> channels;
  // width * height * channels.size() values: rows from the top, pixels from the left, channels interleaved.
  std::vector<float> pixels;
  // Metadata by name as in the file ("malus:method"): text, a number or a list of numbers. read() returns text and
  // single numbers only.
  using Value = std::variant<std::string, double, std::vector<float>>;
  std::vector<std::pair<std::string, Value>> attributes;
  Encoding encoding;

  // Returns the index of a channel, or -1.
  int channel(std::string_view name) const;
};

// Reads an image of the formats of bake/SCENE.md (Images); in the bundle EXR and PNG. Integers are
// scaled to [0, 1], and values stay encoded. The image is the display window of an EXR file: pixels that its data
// window does not store are 0, those outside the display window are left out. HDR values are divided by EXPOSURE and
// COLORCORR. The orientation that HDR, TIFF and JPEG files state is applied. Colours are not multiplied by alpha:
// integers that the file stores multiplied are divided by it; the floats of EXR stay as stored. Limits: 65536 pixels
// per side, 64 channels, 2^30 values, 32768 values per byte of the file (image_size.h), checked by the header before
// pixels are decoded. They apply to tiles too, and an attribute of EXR must be within the file.
Image read(const std::filesystem::path& path);

// The same for the bytes of a file. name: of the image, for errors.
Image readBytes(std::span<const std::byte> bytes, std::string_view name);

// Compression of an EXR file of 32-bit floats. zip and none are lossless. dwaa is lossy, at OpenEXR's level 45: it
// keeps what is visible of channels whose name or part behind the last dot is R, G, B or Y, and is lossless for others.
enum class ExrCompression { zip, dwaa, none };
inline constexpr std::array<const char*, 3> kExrCompressionNames = {"zip", "dwaa", "none"};

// Writes an EXR of 32-bit floats with all attributes, by all threads of the current TBB arena. Equal images give
// identical files, whatever the number of threads, on processors with the same vector instructions (exr_zip.h). The
// file is replaced atomically (atomic_file.h), as by the functions below.
void writeExr(const std::filesystem::path& path, const Image& image, ExrCompression compression = ExrCompression::zip);

// Writes an 8-bit PNG. pixels: width * height * channels sRGB-encoded bytes, channels 1 (grey) or 3 (RGB).
void writePng(const std::filesystem::path& path, int width, int height, int channels,
              const std::vector<std::uint8_t>& pixels);

// Writes a linear grey PNG or, not in the bundle, an uncompressed TIFF, by the extension of path. values: width *
// height samples, rows from the top, stored unscaled; with bits8 each must be at most 255. description: the file's
// ImageDescription.
enum class GreyDepth { bits8, bits16 };
void writeGrey(const std::filesystem::path& path, int width, int height, GreyDepth depth,
               const std::vector<std::uint16_t>& values, const std::string& description);

}  // namespace malus::image

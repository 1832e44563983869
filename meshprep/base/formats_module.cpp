// The module of the other formats, by OpenImageIO: the only file that includes it.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "meshprep/base/declared_size.h"
#include "meshprep/base/icc_profile.h"
#include "meshprep/base/image_module.h"
#include "meshprep/base/image_size.h"
#include "meshprep/base/orientation.h"
#include "meshprep/base/radiance_header.h"

namespace malus::image {

namespace {
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::string messageOr(const std::string& message, const char* otherwise) {
  return message.empty() ? otherwise : message;
}

// Encoding of integers by the attribute oiio:ColorSpace, whose names differ between versions, and oiio:Gamma.
Encoding integerEncoding(const ImageSpec& spec) {
  Encoding encoding;
  encoding.transfer = Encoding::Transfer::sRgb;
  if (const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile")) {
    const auto* bytes = static_cast<const unsigned char*>(profile->data());
    if (!isSrgbProfile({bytes, static_cast<std::size_t>(profile->datasize())}))
      encoding.notes.emplace_back(kForeignProfile);
    return encoding;
  }
  std::string space = spec.get_string_attribute("oiio:ColorSpace");
  std::transform(space.begin(), space.end(), space.begin(), [](unsigned char c) { return std::tolower(c); });
  double gamma = static_cast<double>(spec.get_float_attribute("oiio:Gamma", 0));
  for (const auto& [prefix, value] : {std::pair("g18_", 1.8), std::pair("g22_", 2.2), std::pair("g24_", 2.4)})
    if (space.starts_with(prefix)) gamma = value;
  if (gamma == 1 || space.starts_with("lin") || space == "scene_linear") {
    encoding.transfer = Encoding::Transfer::linear;
  } else if (gamma > 0) {
    encoding.transfer = Encoding::Transfer::power;
    encoding.exponent = gamma;
  } else if (!space.empty() && space.find("srgb") == std::string::npos && space.find("rec709") == std::string::npos) {
    encoding.notes.push_back(fmt::format("has the colour space '{}', which is not applied; it is read as sRGB", space));
  }
  return encoding;
}

// Divides colours that the file stores multiplied by alpha (TIFF and TGA can) by it.
void divideByAlpha(const ImageSpec& spec, std::string_view format, Image& image) {
  const bool isMultiplied = (format == "tiff" && spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0) ||
                            (format == "targa" && spec.get_int_attribute("targa:alpha_type", 0) == 4);
  if (!isMultiplied || spec.alpha_channel < 0) return;
  const auto channels = static_cast<std::size_t>(spec.nchannels), alpha = static_cast<std::size_t>(spec.alpha_channel);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels)
    for (std::size_t c = 0; c < channels; ++c)
      if (c != alpha && image.pixels[i + alpha] > 0)
        image.pixels[i + c] = std::min(image.pixels[i + c] / image.pixels[i + alpha], 1.0f);
}

// Applies what OpenImageIO leaves to the caller: EXPOSURE and COLORCORR.
void applyRadianceHeader(const RadianceHeader& header, Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(image.pixels[i] / (header.exposure * header.colourCorrection[i % 3]));
  image.encoding.chromaticities = header.primaries;
  double gamma = 1;
  if (!header.gamma.empty() && (std::sscanf(header.gamma.c_str(), "%lf", &gamma) != 1 || gamma != 1))
    image.encoding.notes.push_back(
        fmt::format("has GAMMA={}, which the Radiance format does not define and which is not applied; values are read "
                    "as linear",
                    header.gamma));
}

void readAttributes(const ImageSpec& spec, Image& image) {
  for (const auto& attribute : spec.extra_attribs) {
    const std::string name = attribute.name().string();
    if (attribute.type() == TypeDesc::STRING) {
      image.attributes.emplace_back(name, attribute.get_string());
    } else if (attribute.type().basetype == TypeDesc::FLOAT && attribute.type().numelements() == 1 &&
               attribute.type().aggregate == TypeDesc::SCALAR) {
      image.attributes.emplace_back(name, static_cast<double>(attribute.get_float()));
    }
  }
}

// Formats that are read: those that OpenImageIO opens by a header of fixed size, and those of declaredSize(). It
// decodes the others when it opens them (camera RAW, DICOM, movies, volumes, thumbnails of PSD), before their size is
// known, or needs no file at all (null). TGA has no signature and comes last. EXR and PNG are read here only to test
// the other module.
constexpr const char* kFormats[] = {"jpeg", "tiff", "hdr", "bmp", "webp", "gif", "jpeg2000", "heif",
                                    "dds",  "dpx",  "sgi", "pnm", "iff",  "png", "openexr",  "targa"};

// Opens a file by its content, whatever its extension. Returns null and the reason if that fails.
std::unique_ptr<ImageInput> openKnownFormat(const std::string& path, std::string& problem) {
  ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // as stored, not multiplied by alpha
  for (const char* format : kFormats) {
    std::unique_ptr<ImageInput> input = ImageInput::create(format);
    ImageSpec ignored;
    if (!input) continue;  // built without it
    if (input->open(path, ignored, config)) return input;
    problem = messageOr(input->geterror(), "damaged file");
    if (input->valid_file(path)) return nullptr;
  }
  problem =
      "unknown format; expected PNG, EXR, JPEG, TIFF, HDR, BMP, TGA, WebP, GIF, JPEG 2000, HEIF, DDS, DPX, SGI, PNM or "
      "IFF";
  return nullptr;
}

// start: the first bytes of the file.
std::string readByOpenImageIo(const std::string& path, std::string_view start, Image& image) {
  std::optional<RadianceHeader> header;
  if (start.starts_with("#?")) header = readRadianceHeader(start);
  if (header && header->format == "32-bit_rle_xyze")
    return "FORMAT=32-bit_rle_xyze is not supported; expected 32-bit_rle_rgbe: convert it with 'ra_xyze -r IN OUT' of "
           "Radiance";
  std::string unopened;
  const auto input = openKnownFormat(path, unopened);
  if (!input) return unopened;
  const ImageSpec spec = input->spec();
  if (spec.depth > 1) return fmt::format("unsupported volume of {} slices; expected an image", spec.depth);
  const std::uint64_t fileBytes = std::filesystem::file_size(path);
  if (std::string problem = checkSize({spec.width, spec.height, spec.nchannels}, fileBytes); !problem.empty())
    return problem;
  if (spec.tile_width > 0 || spec.tile_height > 0)
    if (std::string problem = checkSize({spec.tile_width, spec.tile_height, spec.nchannels}, fileBytes);
        !problem.empty())
      return "tiles of " + problem;
  const std::string_view format = input->format_name();
  if (format == "hdr") {
    if (!header || header->rows != spec.height || header->columns != spec.width || spec.nchannels != 3)
      return "unsupported header; expected a positive EXPOSURE and COLORCORR, and a line as -Y HEIGHT +X WIDTH";
  }
  image.width = spec.width;
  image.height = spec.height;
  image.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                      static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, image.pixels.data()))
    return messageOr(input->geterror(), "damaged file");
  readAttributes(spec, image);
  if (header) applyRadianceHeader(*header, image);
  if (!spec.format.is_floating_point()) {
    image.encoding = integerEncoding(spec);
    divideByAlpha(spec, format, image);
  }
  applyOrientation(image, header ? header->orientation : spec.get_int_attribute("Orientation", 1));
  return {};
}

std::string readImage(const std::string& path, Image& image) {
  try {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::strerror(errno);
    std::string start(65536, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    if (const std::optional<ImageSize> size = declaredSize(file))
      if (std::string problem = checkSize(*size, std::filesystem::file_size(path)); !problem.empty()) return problem;
    return readByOpenImageIo(path, start, image);
  } catch (const std::exception& error) {
    return messageOr(error.what(), "damaged file");
  }
}

// Into the existing file.
std::string writeSpec(const std::string& path, const ImageSpec& spec, const TypeDesc& type, const void* pixels) {
  const auto output = ImageOutput::create(path);
  if (!output) return messageOr(OIIO::geterror(), "unknown format");
  if (!output->open(path, spec)) return messageOr(output->geterror(), "cannot open");
  if (!output->write_image(type, pixels)) return messageOr(output->geterror(), "cannot write");
  if (!output->close()) return messageOr(output->geterror(), "cannot close");
  return {};
}

std::string writeTiff(const std::string& path, const GreyPixels& grey) {
  try {
    ImageSpec spec(grey.width, grey.height, 1, grey.depth == GreyDepth::bits8 ? TypeDesc::UINT8 : TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("ImageDescription", grey.description);
    spec.attribute("compression", "none");
    // Keep OpenImageIO from adding the current date, so that equal images give identical files: it looks for an
    // attribute of this name and writes only one of type string.
    spec.attribute("DateTime", 0);
    if (grey.depth == GreyDepth::bits16) return writeSpec(path, spec, TypeDesc::UINT16, grey.values);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(grey.width) * static_cast<std::size_t>(grey.height));
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(grey.values[i]);
    return writeSpec(path, spec, TypeDesc::UINT8, bytes.data());
  } catch (const std::exception& error) {
    return messageOr(error.what(), "cannot write");
  }
}

}  // namespace
}  // namespace malus::image

extern "C" __attribute__((visibility("default"))) const malus::image::FormatsModule* malusFormatsModule() {
  OIIO::attribute("debug", 0);  // Debian's build prints to stderr otherwise
  static const malus::image::FormatsModule kModule = {malus::image::readImage, malus::image::writeTiff};
  return &kModule;
}

// The image module with every format of OpenImageIO: the only file that includes it.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "meshprep/base/image_module.h"

namespace malus::image {

namespace {
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::string messageOr(const std::string& message, const char* otherwise) {
  return message.empty() ? otherwise : message;
}

std::string readImage(const std::string& path, Image& image) {
  try {
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // as stored, not multiplied by alpha
    const auto input = ImageInput::open(path, &config);
    if (!input) return messageOr(OIIO::geterror(), "unknown format");
    const ImageSpec spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kMaxSide || spec.height > kMaxSide || spec.depth > 1 ||
        spec.nchannels < 1 || spec.nchannels > kMaxChannels ||
        spec.image_pixels() * static_cast<std::uint64_t>(spec.nchannels) > kMaxValues)
      return fmt::format("unsupported size {} x {} with {} channels", spec.width, spec.height, spec.nchannels);
    image.width = spec.width;
    image.height = spec.height;
    image.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
    image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, image.pixels.data()))
      return messageOr(input->geterror(), "damaged file");
    for (const auto& attribute : spec.extra_attribs) {
      const std::string name = attribute.name().string();
      if (attribute.type() == TypeDesc::STRING) {
        image.attributes.emplace_back(name, attribute.get_string());
      } else if (attribute.type().basetype == TypeDesc::FLOAT && attribute.type().numelements() == 1 &&
                 attribute.type().aggregate == TypeDesc::SCALAR) {
        image.attributes.emplace_back(name, static_cast<double>(attribute.get_float()));
      }
    }
    return {};
  } catch (const std::exception& error) {
    return messageOr(error.what(), "damaged file");
  }
}

// Writes to the file, or to proxy if it is not null. The extension of path selects the format.
std::string writeSpec(const std::string& path, const ImageSpec& spec, const TypeDesc& type, const void* pixels,
                      OIIO::Filesystem::IOProxy* proxy = nullptr) {
  try {
    const auto output = ImageOutput::create(path);
    if (!output) return messageOr(OIIO::geterror(), "unknown format");
    if (proxy != nullptr && !output->set_ioproxy(proxy)) return "cannot write to memory";
    if (!output->open(path, spec)) return messageOr(output->geterror(), "cannot open");
    if (!output->write_image(type, pixels)) return messageOr(output->geterror(), "cannot write");
    if (!output->close()) return messageOr(output->geterror(), "cannot close");
    return {};
  } catch (const std::exception& error) {
    return messageOr(error.what(), "cannot write");
  }
}

std::string writeExrImage(const std::string& path, const Image& image) {
  ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), TypeDesc::FLOAT);
  spec.channelnames.assign(image.channels.begin(), image.channels.end());
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : image.attributes) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      spec.attribute(name, *text);
    } else if (const auto* number = std::get_if<double>(&value)) {
      spec.attribute(name, static_cast<float>(*number));
    } else if (const auto* list = std::get_if<std::vector<float>>(&value)) {
      if (list->size() == 16)
        spec.attribute(name, TypeDesc::TypeMatrix44, list->data());
      else if (list->size() == 3)
        spec.attribute(name, TypeDesc::TypeVector, list->data());
      else
        spec.attribute(name, TypeDesc(TypeDesc::FLOAT, static_cast<int>(list->size())), list->data());
    }
  }
  // Keep OpenImageIO from adding the current date, so that equal images give identical files: it looks for an attribute
  // of this name and writes only one of type string.
  spec.attribute("DateTime", 0);
  return writeSpec(path, spec, TypeDesc::FLOAT, image.pixels.data());
}

std::string encodePngImage(int width, int height, int channels, const std::uint8_t* pixels,
                           std::vector<unsigned char>& bytes) {
  ImageSpec spec(width, height, channels, TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  OIIO::Filesystem::IOVecOutput memory(bytes);
  return writeSpec("memory.png", spec, TypeDesc::UINT8, pixels, &memory);
}

std::string writeGreyImage(const std::string& path, int width, int height, GreyDepth depth, const std::uint16_t* values,
                           const std::string& description) {
  ImageSpec spec(width, height, 1, depth == GreyDepth::bits8 ? TypeDesc::UINT8 : TypeDesc::UINT16);
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("ImageDescription", description);
  spec.attribute("compression", "none");  // TIFF only; PNG has one method
  spec.attribute("DateTime", 0);          // no date, as in writeExrImage
  if (depth == GreyDepth::bits16) return writeSpec(path, spec, TypeDesc::UINT16, values);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(values[i]);
  return writeSpec(path, spec, TypeDesc::UINT8, bytes.data());
}

}  // namespace
}  // namespace malus::image

extern "C" __attribute__((visibility("default"))) const malus::image::Module* malusImageModule() {
  OIIO::attribute("debug", 0);  // Debian's build prints to stderr otherwise
  static const malus::image::Module kModule = {malus::image::readImage, malus::image::writeExrImage,
                                               malus::image::encodePngImage, malus::image::writeGreyImage};
  return &kModule;
}

#include "meshprep/base/exr_file.h"

#include <strings.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <tuple>

#include <ImfChannelList.h>
#include <ImfEnvmap.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfVecAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include "meshprep/base/exr_header.h"
#include "meshprep/base/exr_zip.h"
#include "meshprep/base/image_size.h"

namespace malus::image {

namespace {

// Gives OpenEXR, which has its own threads, as many as the current arena of TBB.
void useThreads() {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  if (threads != Imf::globalThreadCount()) Imf::setGlobalThreadCount(threads);
}

// The bytes of a file as the stream that OpenEXR reads.
class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::vector<unsigned char>& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char out[], int count) override {
    if (static_cast<std::uint64_t>(count) > bytes_.size() - at_) throw std::runtime_error("the file is truncated");
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = std::min<std::uint64_t>(position, bytes_.size()); }

 private:
  const std::vector<unsigned char>& bytes_;
  std::uint64_t at_ = 0;
};

// Sorts as OpenImageIO does: by layer, then the usual names of colours, alpha and depth
// in any case of letters, then by name.
auto channelKey(const std::string& channel) {
  static constexpr const char* kUsual[] = {"R",  "Red", "G",  "Green", "B",  "Blue", "real", "imag",  "A",    "Alpha",
                                           "AR", "RA",  "AG", "GA",    "AB", "BA",   "Z",    "Depth", "Zback"};
  const std::size_t dot = channel.find_last_of('.');
  const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot);
  const std::string suffix = dot == std::string::npos ? channel : channel.substr(dot + 1);
  const auto* const usual = std::find_if(std::begin(kUsual), std::end(kUsual),
                                         [&](const char* name) { return ::strcasecmp(name, suffix.c_str()) == 0; });
  return std::tuple(layer, usual - std::begin(kUsual), suffix);
}

// Throws std::runtime_error: channels with fewer samples than pixels.
std::vector<std::string> listChannels(const Imf::Header& header) {
  std::vector<std::string> result;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
    if (at.channel().xSampling != 1 || at.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("channel '{}' is subsampled; expected a sample for each pixel", at.name()));
    result.emplace_back(at.name());
  }
  std::sort(result.begin(), result.end(),
            [](const std::string& a, const std::string& b) { return channelKey(a) < channelKey(b); });
  return result;
}

void readAttributes(const Imf::Header& header, Image& image) {
  for (auto at = header.begin(); at != header.end(); ++at) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&at.attribute()))
      image.attributes.emplace_back(at.name(), text->value());
    else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&at.attribute()))
      image.attributes.emplace_back(at.name(), static_cast<double>(number->value()));
  }
}

ImageSize windowSize(const Imath::Box2i& window, std::size_t channels) {
  const auto side = [](int low, int high) { return std::max<std::int64_t>(std::int64_t{high} - low + 1, 0); };
  return {side(window.min.x, window.max.x), side(window.min.y, window.max.y), static_cast<std::int64_t>(channels)};
}

// Reads the pixels of the data window as floats. Integers keep their value: they are counts or numbers of objects.
std::vector<float> readPixels(Imf::InputFile& file, const std::vector<std::string>& channels) {
  const Imath::Box2i window = file.header().dataWindow();
  const ImageSize size = windowSize(window, channels.size());
  std::vector<float> pixels(static_cast<std::size_t>(size.width * size.height) * channels.size());
  const std::size_t pixelBytes = channels.size() * sizeof(float),
                    rowBytes = pixelBytes * static_cast<std::size_t>(size.width);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c], Imf::Slice::Make(Imf::FLOAT, pixels.data() + c, window, pixelBytes, rowBytes));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return pixels;
}

// Places the pixels of the data window in the display window, which is the image.
std::vector<float> placeInDisplay(const std::vector<float>& pixels, const Imath::Box2i& data,
                                  const Imath::Box2i& display, std::size_t channels) {
  const ImageSize from = windowSize(data, channels), to = windowSize(display, channels);
  std::vector<float> placed(static_cast<std::size_t>(to.width * to.height) * channels);
  const std::int64_t left = std::max(data.min.x, display.min.x),
                     right = std::min<std::int64_t>(data.max.x, display.max.x) + 1;
  for (std::int64_t y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y) && left < right;
       ++y) {
    const auto source =
        pixels.begin() + ((y - data.min.y) * from.width + left - data.min.x) * static_cast<std::int64_t>(channels);
    std::copy_n(
        source, (right - left) * static_cast<std::int64_t>(channels),
        placed.begin() + ((y - display.min.y) * to.width + left - display.min.x) * static_cast<std::int64_t>(channels));
  }
  return placed;
}

void readChromaticities(const Imf::Header& header, Encoding& encoding) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  encoding.chromaticities = {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
}

void insertAttribute(Imf::Header& header, const std::string& name, const Image::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    header.insert(name, Imf::StringAttribute(*text));
  } else if (const auto* number = std::get_if<double>(&value)) {
    header.insert(name, Imf::FloatAttribute(static_cast<float>(*number)));
  } else if (const auto* list = std::get_if<std::vector<float>>(&value)) {
    Imath::M44f matrix;
    if (list->size() == 16) {
      std::memcpy(matrix.x, list->data(), sizeof matrix.x);
      header.insert(name, Imf::M44fAttribute(matrix));
    } else if (list->size() == 3) {
      header.insert(name, Imf::V3fAttribute({(*list)[0], (*list)[1], (*list)[2]}));
    } else {
      header.insert(name, Imf::FloatVectorAttribute(*list));
    }
  }
}

}  // namespace

bool isExr(const std::vector<unsigned char>& bytes) {
  return bytes.size() >= 4 && Imf::isImfMagic(reinterpret_cast<const char*>(bytes.data()));
}

std::string decodeExr(const std::vector<unsigned char>& bytes, Image& image) {
  try {
    std::string problem = checkExrHeader(bytes);
    if (!problem.empty()) return problem;
    constexpr std::size_t kLarge = std::size_t{1} << 20;
    if (bytes.size() > kLarge) useThreads();
    MemoryInput stream(bytes);
    Imf::InputFile file(stream);
    const Imath::Box2i data = file.header().dataWindow(), display = file.header().displayWindow();
    const std::vector<std::string> channels = listChannels(file.header());
    const ImageSize shown = windowSize(display, channels.size());
    for (const ImageSize& size : {windowSize(data, channels.size()), shown})
      if (problem = checkSize(size, bytes.size()); !problem.empty()) return problem;
    image.width = static_cast<int>(shown.width);
    image.height = static_cast<int>(shown.height);
    image.channels = channels;
    readAttributes(file.header(), image);
    readChromaticities(file.header(), image.encoding);
    if (Imf::hasEnvmap(file.header()) && Imf::envmap(file.header()) == Imf::ENVMAP_CUBE)
      image.encoding.notes.emplace_back("is marked as a cube map (envmap), and is read as a plain image");
    image.pixels = readPixels(file, channels);
    if (data != display) image.pixels = placeInDisplay(image.pixels, data, display, channels.size());
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string writeExrFile(const std::string& path, const Image& image, ExrCompression compression) {
  try {
    Imf::Header header(image.width, image.height);
    for (const std::string& name : image.channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    for (const auto& [name, value] : image.attributes) insertAttribute(header, name, value);
    if (compression == ExrCompression::zip) return writeZipExr(path, header, image);
    header.compression() = compression == ExrCompression::dwaa ? Imf::DWAA_COMPRESSION : Imf::NO_COMPRESSION;
    const std::size_t pixelBytes = image.channels.size() * sizeof(float);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < image.channels.size(); ++c)
      buffer.insert(image.channels[c],
                    Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, header.dataWindow(), pixelBytes,
                                     pixelBytes * static_cast<std::size_t>(image.width)));
    useThreads();
    std::ofstream file(path, std::ios::binary);
    {
      Imf::StdOFStream stream(file, path.c_str());
      Imf::OutputFile output(stream, header);
      output.setFrameBuffer(buffer);
      output.writePixels(image.height);
    }
    file.close();
    return file ? std::string() : std::string(std::strerror(errno));
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace malus::image

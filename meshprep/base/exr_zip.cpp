#include "meshprep/base/exr_zip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>
#include <sstream>
#include <vector>

#include <ImfChannelList.h>
#include <ImfStdIO.h>
#include <ImfVersion.h>
#include <isa-l/igzip_lib.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

namespace malus::image {

namespace {

static_assert(std::endian::native == std::endian::little, "EXR files are little endian");

constexpr int kChunkRows = 16;       // of Imf::ZIP_COMPRESSION
constexpr std::uint32_t kLevel = 1;  // of 0 to 3: the table in the header

// Indices of the channels in the order of the file, which is that of their names.
std::vector<std::size_t> channelOrder(const Imf::Header& header, const Image& image) {
  std::vector<std::size_t> order;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
    order.push_back(static_cast<std::size_t>(std::ranges::find(image.channels, at.name()) - image.channels.begin()));
  return order;
}

// Encodes chunks one after the other. One per thread.
class ChunkEncoder {
 public:
  ChunkEncoder(const Image& image, std::span<const std::size_t> order) : image_(image), order_(order) {}

  // The bytes of a chunk as stored in the file: its first row, its size, and its data.
  std::vector<std::uint8_t> encode(int row) {
    const int rows = std::min(kChunkRows, image_.height - row);
    const std::size_t count = order_.size() * static_cast<std::size_t>(rows) * static_cast<std::size_t>(image_.width);
    encoded_.resize(kHeader + count * sizeof(float));
    splitBytes(row, rows, count);
    takeDifferences();
    std::size_t size = compress(encoded_.data() + kHeader, count * sizeof(float));
    if (size == 0) size = storeValues(row, rows, encoded_.data() + kHeader);
    const std::array<std::int32_t, 2> head = {row, static_cast<std::int32_t>(size)};
    std::memcpy(encoded_.data(), head.data(), kHeader);
    return {encoded_.data(), encoded_.data() + kHeader + size};
  }

 private:
  static constexpr std::size_t kHeader = 2 * sizeof(std::int32_t);

  template <class Function>
  void forEachRow(int row, int rows, Function function) const {
    const std::size_t width = static_cast<std::size_t>(image_.width), channels = image_.channels.size();
    for (int y = row; y < row + rows; ++y)
      for (const std::size_t channel : order_)
        function(image_.pixels.data() + static_cast<std::size_t>(y) * width * channels + channel, width, channels);
  }

  // ImfZip.cpp, Zip::compress: bytes 0 and 2 of every value, then bytes 1 and 3.
  void splitBytes(int row, int rows, std::size_t count) {
    split_.resize(2 * count);
    std::uint16_t *even = split_.data(), *odd = even + count;
    forEachRow(row, rows, [&](const float* value, std::size_t width, std::size_t stride) {
      for (std::size_t x = 0; x < width; ++x) {
        const auto bits = std::bit_cast<std::uint32_t>(value[x * stride]);
        *even++ = static_cast<std::uint16_t>((bits & 0xffu) | (bits >> 8u & 0xff00u));
        *odd++ = static_cast<std::uint16_t>((bits >> 8u & 0xffu) | (bits >> 16u & 0xff00u));
      }
    });
  }

  // Each byte minus the one before it, plus 128.
  void takeDifferences() {
    const std::size_t count = 2 * split_.size();
    differences_.resize(count);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(split_.data());
    differences_[0] = bytes[0];
    std::size_t i = 1;
    for (; i + 8 <= count; i += 8) {  // eight bytes at once: without the top bits no byte borrows from the next
      constexpr std::uint64_t kTop = 0x8080808080808080u;
      std::uint64_t a = 0, b = 0;
      std::memcpy(&a, bytes + i, 8);
      std::memcpy(&b, bytes + i - 1, 8);
      const std::uint64_t difference = ((a | kTop) - (b & ~kTop)) ^ (~(a ^ b) & kTop) ^ kTop;
      std::memcpy(differences_.data() + i, &difference, 8);
    }
    for (; i < count; ++i) differences_[i] = static_cast<std::uint8_t>(bytes[i] - bytes[i - 1] + 128);
  }

  // Returns the size of the zlib stream; 0 if it is not smaller than the values, which are stored then.
  std::size_t compress(std::uint8_t* out, std::size_t limit) {
    isal_deflate_stateless_init(stream_.get());
    stream_->level = kLevel;
    stream_->level_buf = buffer_.data();
    stream_->level_buf_size = static_cast<std::uint32_t>(buffer_.size());
    stream_->gzip_flag = IGZIP_ZLIB;
    stream_->end_of_stream = 1;
    stream_->flush = NO_FLUSH;
    stream_->next_in = differences_.data();
    stream_->avail_in = static_cast<std::uint32_t>(differences_.size());
    stream_->next_out = out;
    stream_->avail_out = static_cast<std::uint32_t>(limit - 1);
    return isal_deflate_stateless(stream_.get()) == COMP_OK ? stream_->total_out : 0;
  }

  std::size_t storeValues(int row, int rows, std::uint8_t* out) const {
    std::uint8_t* at = out;
    forEachRow(row, rows, [&](const float* value, std::size_t width, std::size_t stride) {
      for (std::size_t x = 0; x < width; ++x, at += sizeof(float)) std::memcpy(at, value + x * stride, sizeof(float));
    });
    return static_cast<std::size_t>(at - out);
  }

  const Image& image_;
  std::span<const std::size_t> order_;
  std::vector<std::uint16_t> split_;
  std::vector<std::uint8_t> differences_;
  std::vector<std::uint8_t> encoded_;
  std::vector<std::uint8_t> buffer_ = std::vector<std::uint8_t>(ISAL_DEF_LVL1_DEFAULT);
  std::unique_ptr<isal_zstream> stream_ = std::make_unique<isal_zstream>();
};

// Magic number, version and attributes: the file up to the table of offsets.
std::string fileStart(const Imf::Header& header) {
  Imf::StdOSStream stream;
  constexpr std::size_t kShortName = 31;
  bool hasLongNames = false;
  for (auto at = header.begin(); at != header.end(); ++at)
    hasLongNames = hasLongNames || std::strlen(at.name()) > kShortName;
  for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
    hasLongNames = hasLongNames || std::strlen(at.name()) > kShortName;
  const std::array<std::int32_t, 2> head = {Imf::MAGIC,
                                            Imf::EXR_VERSION | (hasLongNames ? int{Imf::LONG_NAMES_FLAG} : 0)};
  stream.write(reinterpret_cast<const char*>(head.data()), sizeof head);
  header.writeTo(stream);
  return stream.str();
}

// Encodes and writes all chunks in the order of their rows. Returns the offset of each in the file.
std::vector<std::uint64_t> writeChunks(std::ostream& file, const Image& image, std::span<const std::size_t> order) {
  namespace tbb = oneapi::tbb;
  tbb::enumerable_thread_specific<ChunkEncoder> encoders([&] { return ChunkEncoder(image, order); });
  std::vector<std::uint64_t> offsets;
  int next = 0;
  const auto tokens = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(tokens,
                         tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order,
                                                     [&](tbb::flow_control& control) {
                                                       const int row = next;
                                                       if (row >= image.height || !file) control.stop();
                                                       next += kChunkRows;
                                                       return row;
                                                     }) &
                             tbb::make_filter<int, std::vector<std::uint8_t>>(
                                 tbb::filter_mode::parallel, [&](int row) { return encoders.local().encode(row); }) &
                             tbb::make_filter<std::vector<std::uint8_t>, void>(
                                 tbb::filter_mode::serial_in_order, [&](const std::vector<std::uint8_t>& chunk) {
                                   offsets.push_back(static_cast<std::uint64_t>(file.tellp()));
                                   file.write(reinterpret_cast<const char*>(chunk.data()),
                                              static_cast<std::streamsize>(chunk.size()));
                                 }));
  return offsets;
}

}  // namespace

std::string writeZipExr(const std::string& path, Imf::Header& header, const Image& image) {
  header.compression() = Imf::ZIP_COMPRESSION;
  header.sanityCheck();
  const std::vector<std::size_t> order = channelOrder(header, image);
  const std::string start = fileStart(header);
  std::ofstream file(path, std::ios::binary);
  file << start;
  // The offsets are known at the end.
  std::vector<std::uint64_t> offsets(static_cast<std::size_t>((image.height + kChunkRows - 1) / kChunkRows));
  const auto writeOffsets = [&] {
    file.write(reinterpret_cast<const char*>(offsets.data()),
               static_cast<std::streamsize>(offsets.size() * sizeof(std::uint64_t)));
  };
  writeOffsets();
  offsets = writeChunks(file, image, order);
  file.seekp(static_cast<std::streamoff>(start.size()));
  writeOffsets();
  file.close();
  return file ? std::string() : std::string(std::strerror(errno));
}

}  // namespace malus::image

#include "meshprep/base/declared_size.h"

#include <cstdlib>
#include <istream>
#include <limits>
#include <string>
#include <string_view>

namespace malus::image {

namespace {
constexpr std::uint64_t kEnd = std::numeric_limits<std::int64_t>::max();

// Returns up to `count` bytes from an offset on.
std::string bytesAt(std::istream& file, std::uint64_t offset, std::size_t count) {
  std::string bytes(count, '\0');
  file.clear();
  if (offset > kEnd || !file.seekg(static_cast<std::streamoff>(offset))) return {};
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

std::uint32_t byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }
std::uint32_t little(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8u | byteAt(bytes, at + i);
  return value;
}
std::uint32_t big(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8u | byteAt(bytes, at + i);
  return value;
}

std::optional<ImageSize> sizeOfBmp(std::istream& file) {
  constexpr std::size_t kInfoHeader = 14;          // offset; begins with its size
  constexpr std::uint32_t kShortHeaderBytes = 12;  // of OS/2, with 16-bit sizes
  constexpr std::int64_t kColourChannels = 3;      // of the palette
  const std::string header = bytesAt(file, 0, 26);
  if (header.size() < 26) return std::nullopt;
  if (little(header, kInfoHeader, 4) == kShortHeaderBytes)
    return ImageSize{little(header, kInfoHeader + 4, 2), little(header, kInfoHeader + 6, 2), kColourChannels};
  // The height is negative if the first row is the top one.
  return ImageSize{static_cast<std::int32_t>(little(header, kInfoHeader + 4, 4)),
                   std::abs(std::int64_t{static_cast<std::int32_t>(little(header, kInfoHeader + 8, 4))}),
                   kColourChannels};
}

std::optional<ImageSize> sizeOfGif(std::istream& file) {
  constexpr std::int64_t kChannels = 4;
  const std::string header = bytesAt(file, 0, 10);
  if (header.size() < 10) return std::nullopt;
  return ImageSize{little(header, 6, 2), little(header, 8, 2), kChannels};
}

// Of the first chunk: lossy, lossless or extended.
std::optional<ImageSize> sizeOfWebp(std::istream& file) {
  constexpr std::int64_t kChannels = 4;
  constexpr std::size_t kChunk = 12, kContent = 20;  // behind the header of RIFF; behind type and size of the chunk
  const std::string header = bytesAt(file, 0, 30);
  if (header.size() < 30) return std::nullopt;
  const std::string_view type = std::string_view(header).substr(kChunk, 4);
  if (type == "VP8 ")
    return ImageSize{little(header, kContent + 6, 2) & 0x3fffu, little(header, kContent + 8, 2) & 0x3fffu, kChannels};
  if (type == "VP8X")
    return ImageSize{std::int64_t{little(header, kContent + 4, 3)} + 1,
                     std::int64_t{little(header, kContent + 7, 3)} + 1, kChannels};
  if (type != "VP8L") return std::nullopt;
  const std::uint32_t sizes = little(header, kContent + 1, 4);
  return ImageSize{std::int64_t{sizes & 0x3fffu} + 1, std::int64_t{sizes >> 14u & 0x3fffu} + 1, kChannels};
}

// Finds the frame header, as libjpeg does: it skips bytes between segments.
std::optional<ImageSize> sizeOfJpeg(std::istream& file) {
  constexpr std::uint32_t kFirstFrame = 0xc0, kLastFrame = 0xcf;
  constexpr std::uint32_t kHuffmanTables = 0xc4, kExtension = 0xc8, kArithmeticTables = 0xcc;  // among the frames
  constexpr std::uint32_t kTemporary = 0x01, kFirstRestart = 0xd0, kStartOfImage = 0xd8, kEndOfImage = 0xd9,
                          kStartOfScan = 0xda;
  for (std::uint64_t at = 2;;) {
    // Find a marker: 0xff, any number of times, and a code other than 0.
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    int code = file.get();
    for (int last = 0; code != std::istream::traits_type::eof(); code = file.get()) {
      if (last == 0xff && code != 0xff && code != 0) break;
      last = code;
    }
    if (code == std::istream::traits_type::eof()) return std::nullopt;
    const auto marker = static_cast<std::uint32_t>(code);
    at = static_cast<std::uint64_t>(file.tellg());
    if (marker == kTemporary || (marker >= kFirstRestart && marker <= kStartOfImage)) continue;
    if (marker == kEndOfImage || marker == kStartOfScan) return std::nullopt;
    const std::string segment = bytesAt(file, at, 8);
    if (segment.size() < 8) return std::nullopt;
    if (marker >= kFirstFrame && marker <= kLastFrame && marker != kHuffmanTables && marker != kExtension &&
        marker != kArithmeticTables)
      return ImageSize{big(segment, 5, 2), big(segment, 3, 2), byteAt(segment, 7)};
    at += big(segment, 0, 2);
  }
}

// Size of a codestream of JPEG 2000: start, and the marker segment SIZ.
std::optional<ImageSize> sizeOfCodestream(std::istream& file, std::uint64_t at) {
  const std::string header = bytesAt(file, at, 42);
  if (header.size() < 42 || !header.starts_with("\xff\x4f\xff\x51")) return std::nullopt;
  return ImageSize{std::int64_t{big(header, 8, 4)} - big(header, 16, 4),
                   std::int64_t{big(header, 12, 4)} - big(header, 20, 4), big(header, 40, 2)};
}

// Calls visit(type, begin, end) for the contents of each box of ISO/IEC 14496-12 between two offsets.
template <class Visit>
void forEachBox(std::istream& file, std::uint64_t begin, std::uint64_t end, Visit visit) {
  constexpr int kMostBoxes = 10'000;
  for (int count = 0; count < kMostBoxes && begin < end; ++count) {
    const std::string header = bytesAt(file, begin, 16);
    if (header.size() < 8) return;
    std::uint64_t size = big(header, 0, 4), headerBytes = 8;
    if (size == 1 && header.size() == 16) {
      headerBytes = 16;
      size = std::uint64_t{big(header, 8, 4)} << 32u | big(header, 12, 4);
    }
    if (size == 0 || size > end - begin) size = end - begin;  // 0: to the end
    if (size < headerBytes) return;
    visit(std::string_view(header).substr(4, 4), begin + headerBytes, begin + size);
    begin += size;
  }
}

std::optional<ImageSize> sizeOfJpeg2000(std::istream& file) {
  std::optional<ImageSize> size;
  forEachBox(file, 0, kEnd, [&](std::string_view type, std::uint64_t begin, std::uint64_t) {
    if (type == "jp2c" && !size) size = sizeOfCodestream(file, begin);
  });
  return size;
}

// Largest of the properties `ispe`.
std::optional<ImageSize> sizeOfHeif(std::istream& file) {
  constexpr std::uint64_t kVersionBytes = 4;  // of a full box
  constexpr std::int64_t kChannels = 4;
  std::optional<ImageSize> size;
  const auto visitProperty = [&](std::string_view type, std::uint64_t begin, std::uint64_t) {
    if (type != "ispe") return;
    const std::string value = bytesAt(file, begin + kVersionBytes, 8);
    if (value.size() < 8) return;
    const ImageSize found{big(value, 0, 4), big(value, 4, 4), kChannels};
    const auto pixels = [](const ImageSize& s) { return static_cast<double>(s.width) * static_cast<double>(s.height); };
    if (!size || pixels(found) > pixels(*size)) size = found;
  };
  forEachBox(file, 0, kEnd, [&](std::string_view type, std::uint64_t begin, std::uint64_t end) {
    if (type != "meta") return;
    forEachBox(file, begin + kVersionBytes, end, [&](std::string_view inner, std::uint64_t from, std::uint64_t to) {
      if (inner != "iprp") return;
      forEachBox(file, from, to, [&](std::string_view list, std::uint64_t first, std::uint64_t last) {
        if (list == "ipco") forEachBox(file, first, last, visitProperty);
      });
    });
  });
  return size;
}

}  // namespace

std::optional<ImageSize> declaredSize(std::istream& file) {
  const std::string start = bytesAt(file, 0, 12);
  if (start.starts_with("BM")) return sizeOfBmp(file);
  if (start.starts_with("GIF8")) return sizeOfGif(file);
  if (start.starts_with("\xff\xd8")) return sizeOfJpeg(file);
  if (start.starts_with("\xff\x4f\xff\x51")) return sizeOfCodestream(file, 0);
  if (start.size() < 12) return std::nullopt;
  if (start.starts_with("RIFF") && start.substr(8, 4) == "WEBP") return sizeOfWebp(file);
  if (start.substr(4, 4) == "jP  ") return sizeOfJpeg2000(file);
  if (start.substr(4, 4) == "ftyp") return sizeOfHeif(file);
  return std::nullopt;
}

}  // namespace malus::image

#include "meshprep/base/exr_header.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/image_size.h"

namespace malus::image {

namespace {

constexpr std::size_t kMagicBytes = 4;
constexpr std::uint32_t kSeveralParts = 0x1000;  // of the version field
constexpr std::size_t kMaxNameBytes = 255;
constexpr std::size_t kChannelBytes = 16;      // behind a channel's name
constexpr std::uint64_t kTileOffsetBytes = 8;  // of each tile, in a table behind the header
constexpr unsigned kDwab = 9;                  // compression of 256 rows; others take 32 at most
constexpr std::int64_t kDwabRows = 256, kMaxRows = 32;

// Types of a fixed size, with their bytes.
constexpr std::array<std::pair<std::string_view, std::size_t>, 24> kFixedSizes = {{{"box2f", 16},
                                                                                   {"box2i", 16},
                                                                                   {"chromaticities", 32},
                                                                                   {"compression", 1},
                                                                                   {"deepImageState", 1},
                                                                                   {"double", 8},
                                                                                   {"envmap", 1},
                                                                                   {"float", 4},
                                                                                   {"int", 4},
                                                                                   {"keycode", 28},
                                                                                   {"lineOrder", 1},
                                                                                   {"m33d", 72},
                                                                                   {"m33f", 36},
                                                                                   {"m44d", 128},
                                                                                   {"m44f", 64},
                                                                                   {"rational", 8},
                                                                                   {"tiledesc", 9},
                                                                                   {"timecode", 8},
                                                                                   {"v2d", 16},
                                                                                   {"v2f", 8},
                                                                                   {"v2i", 8},
                                                                                   {"v3d", 24},
                                                                                   {"v3f", 12},
                                                                                   {"v3i", 12}}};

// Position in the bytes. All functions throw std::runtime_error beyond their end.
class Cursor {
 public:
  explicit Cursor(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  bool atEnd() const { return at_ == bytes_.size(); }
  std::span<const unsigned char> take(std::size_t count) {
    if (count > bytes_.size() - at_) throw std::runtime_error("the header is damaged, or the file is truncated");
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  std::uint32_t number() {
    const std::span<const unsigned char> four = take(4);
    return four[0] | std::uint32_t{four[1]} << 8u | std::uint32_t{four[2]} << 16u | std::uint32_t{four[3]} << 24u;
  }
  std::int64_t signedNumber() { return static_cast<std::int32_t>(number()); }
  std::string name() {
    std::string result;
    for (unsigned char c = take(1)[0]; c != 0; c = take(1)[0]) {
      if (result.size() == kMaxNameBytes) throw std::runtime_error("a name in the header is too long");
      result += static_cast<char>(c);
    }
    return result;
  }

 private:
  std::span<const unsigned char> bytes_;
  std::size_t at_ = 0;
};

struct Window {
  std::int64_t width = 0, height = 0;
};

// Declarations of a part of the file.
struct Part {
  Window data, tile;
  std::uint64_t channels = 0;
  unsigned compression = 0;
};

std::uint64_t countChannels(Cursor value) {
  std::uint64_t count = 0;
  for (; !value.name().empty(); ++count) value.take(kChannelBytes);
  if (!value.atEnd()) throw std::runtime_error("wrong size of the list of channels");
  return count;
}

void readAttribute(const std::string& name, const std::string& type, std::span<const unsigned char> bytes, Part& part) {
  const auto* const fixed =
      std::find_if(kFixedSizes.begin(), kFixedSizes.end(), [&](const auto& entry) { return entry.first == type; });
  if (fixed != kFixedSizes.end() && fixed->second != bytes.size())
    throw std::runtime_error(
        fmt::format("attribute '{}' has {} bytes; expected {}", name, bytes.size(), fixed->second));
  Cursor value(bytes);
  if (name == "dataWindow" && type == "box2i") {
    const std::int64_t left = value.signedNumber(), top = value.signedNumber();
    part.data.width = value.signedNumber() - left + 1;
    part.data.height = value.signedNumber() - top + 1;
  } else if (name == "tiles" && type == "tiledesc") {
    part.tile.width = value.number();
    part.tile.height = value.number();
  } else if (name == "compression" && type == "compression") {
    part.compression = bytes[0];
  } else if (type == "chlist") {
    const std::uint64_t count = countChannels(value);
    if (name == "channels") part.channels = count;
  } else if (type == "stringvector") {
    while (!value.atEnd()) value.take(value.number());
  } else if (type == "floatvector" && bytes.size() % sizeof(float) != 0) {
    throw std::runtime_error(fmt::format("attribute '{}' has {} bytes; expected floats", name, bytes.size()));
  } else if (type == "preview") {
    const std::uint64_t width = value.number(), height = value.number();
    if (std::max(width, height) > bytes.size() || bytes.size() != 8 + 4 * width * height)
      throw std::runtime_error(fmt::format("the preview of {} x {} pixels has {} bytes", width, height, bytes.size()));
  }
}

// Throws std::runtime_error if a part exceeds the limits.
void checkPart(const Part& part, std::uint64_t fileBytes) {
  const auto channels = static_cast<std::int64_t>(part.channels);
  const Window rows{part.data.width, part.compression == kDwab ? kDwabRows : kMaxRows};
  const bool isTiled = part.tile.width != 0 || part.tile.height != 0;
  for (const Window& window : {part.data, isTiled ? part.tile : rows})
    if (const std::string problem = checkSize({window.width, window.height, channels}, fileBytes); !problem.empty())
      throw std::runtime_error(problem);
  if (!isTiled) return;
  const auto count = [](std::int64_t side, std::int64_t tile) {
    return static_cast<std::uint64_t>((side + tile - 1) / tile);
  };
  const std::uint64_t tiles = count(part.data.width, part.tile.width) * count(part.data.height, part.tile.height);
  if (tiles > fileBytes / kTileOffsetBytes)
    throw std::runtime_error(fmt::format("the file is truncated; expected {} tiles", tiles));
}

}  // namespace

std::string checkExrHeader(const std::vector<unsigned char>& bytes) {
  try {
    Cursor file(bytes);
    file.take(kMagicBytes);
    const bool hasParts = (file.number() & kSeveralParts) != 0;
    do {
      Part part;
      bool isEmpty = true;
      for (std::string name = file.name(); !name.empty(); name = file.name()) {
        isEmpty = false;
        const std::string type = file.name();
        readAttribute(name, type, file.take(file.number()), part);
      }
      if (isEmpty && hasParts) break;  // ends the list of parts
      checkPart(part, bytes.size());
    } while (hasParts);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace malus::image

#include "meshprep/compress/draco_header.h"

#include <string>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr std::uint8_t kVersionMajor = 2;
constexpr std::uint8_t kVersionMinor = 2;
constexpr std::uint8_t kTriangularMesh = 1;

// Sequential reader with bounds checks.
class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, std::string_view where) : bytes_(bytes), where_(where) {}

  std::uint8_t byte(std::string_view what) {
    if (offset_ >= bytes_.size())
      throw Error(fmt::format("{}, byte {}", where_, offset_), "Draco data is truncated", what, "the end of the data");
    return std::to_integer<std::uint8_t>(bytes_[offset_++]);
  }

  // LEB128, at most 32 bits.
  std::uint32_t varint(std::string_view what) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint8_t b = byte(what);
      value |= static_cast<std::uint64_t>(b & 0x7fu) << shift;
      if ((b & 0x80u) != 0) continue;
      if (value <= 0xffffffffu) return static_cast<std::uint32_t>(value);
      break;
    }
    fail("Draco data is corrupt", fmt::format("{} of at most 32 bits", what), "more bits");
  }

  [[noreturn]] void fail(std::string_view problem, std::string_view expected, std::string_view found) const {
    throw Error(fmt::format("{}, byte {}", where_, offset_), problem, expected, found);
  }

 private:
  std::span<const std::byte> bytes_;
  std::string_view where_;
  std::size_t offset_ = 0;
};

}  // namespace

DracoHeader parseHeader(std::span<const std::byte> bytes, std::string_view where, int maxSeams) {
  Cursor cursor(bytes, where);
  DracoHeader header;

  // Parse magic, version, kind of geometry, method and flags.
  for (const char expected : std::string_view("DRACO"))
    if (static_cast<char>(cursor.byte("DRACO")) != expected) cursor.fail("is not Draco data", "DRACO", "other bytes");
  const std::uint8_t major = cursor.byte("a version");
  const std::uint8_t minor = cursor.byte("a version");
  if (major != kVersionMajor || minor != kVersionMinor)
    cursor.fail("unsupported version of Draco data", fmt::format("{}.{}", kVersionMajor, kVersionMinor),
                fmt::format("{}.{}", major, minor));
  const std::uint8_t kind = cursor.byte("a geometry type");
  if (kind != kTriangularMesh) cursor.fail("Draco data is not a mesh", "geometry type 1", fmt::to_string(kind));
  const std::uint8_t method = cursor.byte("an encoding method");
  if (method > 1) cursor.fail("unknown encoding method of Draco data", "0 or 1", fmt::to_string(method));
  header.method = static_cast<Method>(method);
  const unsigned flagsLow = cursor.byte("flags");
  const unsigned flags = flagsLow | static_cast<unsigned>(cursor.byte("flags")) << 8u;
  if (flags != 0) cursor.fail("Draco data has flags or metadata", "flags 0", fmt::format("{:#x}", flags));

  // Parse the counts of the connectivity, whose order depends on the method.
  if (header.method == Method::kSequential) {
    header.triangles = cursor.varint("a number of faces");
    header.vertices = cursor.varint("a number of points");
    return header;
  }
  const std::uint8_t traversal = cursor.byte("a traversal");
  if (traversal > 2) cursor.fail("unknown edgebreaker traversal", "0 to 2", fmt::to_string(traversal));
  header.vertices = cursor.varint("a number of vertices");
  header.triangles = cursor.varint("a number of faces");
  const std::uint8_t attributeData = cursor.byte("a number of attribute connectivities");
  if (attributeData > maxSeams)
    cursor.fail("too many attributes in Draco data", fmt::format("at most {} with separate connectivity", maxSeams),
                fmt::to_string(attributeData));

  // Draco allocates tables for vertices + split symbols. Each symbol stands for one face.
  const std::uint32_t symbols = cursor.varint("a number of symbols");
  const std::uint32_t splits = cursor.varint("a number of split symbols");
  if (symbols > header.triangles)
    cursor.fail("Draco data is corrupt", fmt::format("at most {} symbols", header.triangles), fmt::to_string(symbols));
  if (splits > symbols)
    cursor.fail("Draco data is corrupt", fmt::format("at most {} split symbols", symbols), fmt::to_string(splits));
  return header;
}

}  // namespace malus::compress

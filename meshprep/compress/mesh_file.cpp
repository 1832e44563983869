#include "meshprep/compress/mesh_file.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr std::string_view kMark = "MALUSGRD", kTextureMark = "MALUSGR2";
constexpr std::size_t kNumbers = 4, kTextureNumbers = 7;

constexpr std::size_t trailerBytes(std::size_t numbers) { return kMark.size() + numbers * sizeof(double); }

// Returns true if the file ends with this mark and so many numbers.
bool endsWith(std::span<const std::byte> bytes, std::string_view mark, std::size_t numbers) {
  const std::size_t size = trailerBytes(numbers);
  return bytes.size() >= size && std::memcmp(bytes.data() + (bytes.size() - size), mark.data(), mark.size()) == 0;
}

void append(double value, std::vector<std::byte>& bytes) {
  const auto number = std::bit_cast<std::uint64_t>(value);
  for (unsigned i = 0; i < sizeof number; ++i) bytes.push_back(static_cast<std::byte>(number >> (8 * i) & 0xffu));
}

double numberAt(std::span<const std::byte> bytes) {
  std::uint64_t number = 0;
  for (unsigned i = 0; i < sizeof number; ++i) number |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return std::bit_cast<double>(number);
}

}  // namespace

std::vector<std::byte> meshFileBytes(std::span<const std::byte> draco, const Grid& grid, const TextureGrids& textures) {
  std::vector<std::byte> bytes(draco.begin(), draco.end());
  for (const char c : textures.any() ? kTextureMark : kMark) bytes.push_back(static_cast<std::byte>(c));
  for (const double value : {grid.origin.x, grid.origin.y, grid.origin.z, grid.step}) append(value, bytes);
  if (!textures.any()) return bytes;
  for (const CoordinateGrid& set : textures.sets)
    for (const double value : {set.origin.x, set.origin.y, set.step}) append(value, bytes);
  append(textures.tangentBits, bytes);
  return bytes;
}

TriangleMesh decodeMeshFile(std::span<const std::byte> bytes, std::string_view where) {
  const bool textured = endsWith(bytes, kTextureMark, kNumbers + kTextureNumbers);
  if (!textured && !endsWith(bytes, kMark, kNumbers))
    throw Error(where, "is not a mesh of malus prep", fmt::format("{} and a grid at its end", kMark));
  const std::size_t count = textured ? kNumbers + kTextureNumbers : kNumbers, at = bytes.size() - trailerBytes(count);
  std::array<double, kNumbers + kTextureNumbers> n{};
  for (std::size_t i = 0; i < count; ++i) n[i] = numberAt(bytes.subspan(at + kMark.size() + i * sizeof(double)));
  const Grid grid{{n[0], n[1], n[2]}, n[3], kMaxPositionBits};
  TextureGrids textures;
  textures.sets = {{{{n[4], n[5]}, n[6]}, {{n[7], n[8]}, n[9]}}};
  textures.tangentBits = n[10] >= 0 && n[10] <= kMaxTangentBits ? static_cast<int>(n[10]) : -1;
  const std::span<const std::byte> draco = bytes.first(at);
  return decode(draco, declaredCounts(draco, where), grid, where, textures);
}

}  // namespace malus::compress

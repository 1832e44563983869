#include "meshprep/compress/mesh_file.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr std::string_view kMark = "MALUSGRD";
constexpr std::size_t kNumbers = 4;
constexpr std::size_t kGridBytes = kMark.size() + kNumbers * sizeof(double);

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

std::vector<std::byte> meshFileBytes(std::span<const std::byte> draco, const Grid& grid) {
  std::vector<std::byte> bytes(draco.begin(), draco.end());
  for (const char c : kMark) bytes.push_back(static_cast<std::byte>(c));
  for (const double value : {grid.origin.x, grid.origin.y, grid.origin.z, grid.step}) append(value, bytes);
  return bytes;
}

TriangleMesh decodeMeshFile(std::span<const std::byte> bytes, std::string_view where) {
  const std::size_t at = bytes.size() < kGridBytes ? 0 : bytes.size() - kGridBytes;
  if (bytes.size() < kGridBytes || std::memcmp(bytes.data() + at, kMark.data(), kMark.size()) != 0)
    throw Error(where, "is not a mesh of malus prep", fmt::format("{} and a grid at its end", kMark));
  std::array<double, kNumbers> numbers{};
  for (std::size_t i = 0; i < kNumbers; ++i)
    numbers[i] = numberAt(bytes.subspan(at + kMark.size() + i * sizeof(double)));
  const Grid grid{{numbers[0], numbers[1], numbers[2]}, numbers[3], kMaxPositionBits};
  const std::span<const std::byte> draco = bytes.first(at);
  return decode(draco, declaredCounts(draco, where), grid, where);
}

}  // namespace malus::compress

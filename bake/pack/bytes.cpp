#include "bake/pack/bytes.h"

#include <cmath>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::pack {

void ByteWriter::text(std::string_view value) {
  u32(static_cast<std::uint32_t>(value.size()));
  raw(std::as_bytes(std::span(value)));
}

void ByteReader::fail(std::string_view problem, std::string_view expected, std::string_view found) const {
  throw Error(fmt::format("{}, byte {}", where_, base_ + at_), problem, expected, found);
}

std::span<const std::byte> ByteReader::raw(std::uint64_t size) {
  if (size > left()) fail("section ends early", fmt::format("{} more bytes", size), fmt::format("{}", left()));
  const std::span<const std::byte> part = bytes_.subspan(at_, static_cast<std::size_t>(size));
  at_ += static_cast<std::size_t>(size);
  return part;
}

double ByteReader::f64(std::string_view what) {
  const double value = std::bit_cast<double>(u64());
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite", what), "a finite number", fmt::format("{}", value));
  return value;
}

glm::dvec3 ByteReader::dvec3() {
  const double x = f64(), y = f64(), z = f64();
  return {x, y, z};
}

void ByteReader::requireUnit(const glm::dvec3& v, std::string_view what) const {
  const double squared = v.x * v.x + v.y * v.y + v.z * v.z;
  if (std::abs(squared - 1) > 1e-9)
    fail(what, "a unit vector", fmt::format("a vector of length {:g}", std::sqrt(squared)));
}

std::uint32_t ByteReader::u32AtMost(std::uint32_t high, std::string_view what) {
  const std::uint32_t value = u32();
  if (value > high) fail(what, fmt::format("at most {}", high), fmt::format("{}", value));
  return value;
}

std::string ByteReader::text(std::uint32_t maxLength) {
  const std::uint32_t length = u32AtMost(maxLength, "length of a text");
  const std::span<const std::byte> source = raw(length);
  return {reinterpret_cast<const char*>(source.data()), source.size()};
}

std::uint32_t ByteReader::count(std::size_t recordBytes, std::uint32_t most, std::string_view what) {
  const std::uint32_t value = u32();
  if (value > most) fail(what, fmt::format("at most {}", most), fmt::format("{}", value));
  if (value > left() / recordBytes)
    fail(what, fmt::format("at most {} in the remaining {} bytes", left() / recordBytes, left()),
         fmt::format("{}", value));
  return value;
}

void ByteReader::end() {
  if (left() != 0) fail("section is longer than its contents", "its end", fmt::format("{} more bytes", left()));
}

}  // namespace malus::pack

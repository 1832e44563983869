// Little-endian numbers to and from bytes. The reader checks every access and throws Error with the file, the section
// and the byte.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::pack {

class ByteWriter {
 public:
  void u16(std::uint16_t value) { integer(value); }
  void u32(std::uint32_t value) { integer(value); }
  void u64(std::uint64_t value) { integer(value); }
  void f32(float value) { integer(std::bit_cast<std::uint32_t>(value)); }
  void f64(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
  void dvec3(const glm::dvec3& v) { f64(v.x), f64(v.y), f64(v.z); }
  void text(std::string_view value);  // u32 length, then UTF-8 bytes
  void raw(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void padTo(std::size_t alignment) { bytes_.resize((bytes_.size() + alignment - 1) / alignment * alignment); }
  std::size_t size() const { return bytes_.size(); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  template <std::unsigned_integral T>
  void integer(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
  }
  std::vector<std::byte> bytes_;
};

class ByteReader {
 public:
  // bytes: a section; base: its offset in the file, for messages; where: file and section, for messages.
  ByteReader(std::span<const std::byte> bytes, std::uint64_t base, std::string_view where)
      : bytes_(bytes), base_(base), where_(where) {}

  std::uint16_t u16() { return integer<std::uint16_t>(); }
  std::uint32_t u32() { return integer<std::uint32_t>(); }
  std::uint64_t u64() { return integer<std::uint64_t>(); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64(std::string_view what = "number");  // finite
  glm::dvec3 dvec3();
  std::uint32_t u32AtMost(std::uint32_t high, std::string_view what);
  std::string text(std::uint32_t maxLength = 65536);
  std::span<const std::byte> raw(std::uint64_t size);
  std::uint64_t left() const { return bytes_.size() - at_; }
  // A count of records of at least recordBytes each: at most `most`, and no more than the remaining bytes can contain.
  std::uint32_t count(std::size_t recordBytes, std::uint32_t most, std::string_view what);
  void requireUnit(const glm::dvec3& v, std::string_view what) const;  // a unit vector within 1e-9
  void end();                                                          // everything was read
  [[noreturn]] void fail(std::string_view problem, std::string_view expected, std::string_view found) const;

 private:
  template <std::unsigned_integral T>
  T integer() {
    const std::span<const std::byte> source = raw(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::to_integer<std::uint64_t>(source[i]) << (8 * i);
    return static_cast<T>(value);
  }
  std::span<const std::byte> bytes_;
  std::uint64_t base_;
  std::string where_;
  std::size_t at_ = 0;
};

}  // namespace malus::pack

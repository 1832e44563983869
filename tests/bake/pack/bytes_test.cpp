#include "bake/pack/bytes.h"

#include <array>
#include <cmath>
#include <limits>

#include "tests/bake/fixtures.h"

namespace malus::pack {
namespace {

using bake::test::contains;
using bake::test::errorMessage;

std::vector<std::byte> makeBytes(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(Bytes, LittleEndian) {
  ByteWriter w;
  w.u16(0x0102);
  w.u32(0x03040506);
  w.u64(0x0708090a0b0c0d0e);
  EXPECT_EQ(w.size(), 14u);
  EXPECT_EQ(w.take(), makeBytes({2, 1, 6, 5, 4, 3, 14, 13, 12, 11, 10, 9, 8, 7}));
}

TEST(Bytes, FloatsAreTheirBits) {
  ByteWriter w;
  w.f32(1.0f);
  w.f64(-2.0);
  EXPECT_EQ(w.take(), makeBytes({0, 0, 0x80, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0xc0}));
}

TEST(Bytes, RoundTrip) {
  ByteWriter w;
  w.u16(65535);
  w.u32(4000000000u);
  w.u64(~std::uint64_t{0});
  w.f32(-0.0f);
  w.f64(1e-300);
  w.dvec3({1, 2, 3});
  w.text("caf\xc3\xa9");
  w.text("");
  const std::vector<std::byte> bytes = w.take();
  ByteReader r(bytes, 0, "file");
  EXPECT_EQ(r.u16(), 65535);
  EXPECT_EQ(r.u32(), 4000000000u);
  EXPECT_EQ(r.u64(), ~std::uint64_t{0});
  EXPECT_TRUE(std::signbit(r.f32()));
  EXPECT_EQ(r.f64(), 1e-300);
  EXPECT_EQ(r.dvec3(), glm::dvec3(1, 2, 3));
  EXPECT_EQ(r.text(), "caf\xc3\xa9");
  EXPECT_EQ(r.text(), "");
  EXPECT_EQ(r.left(), 0u);
  r.end();
}

TEST(Bytes, PaddingIsZero) {
  ByteWriter w;
  w.padTo(16);
  EXPECT_EQ(w.size(), 0u);
  w.u16(0xffff);
  w.padTo(8);
  EXPECT_EQ(w.take(), makeBytes({255, 255, 0, 0, 0, 0, 0, 0}));
}

TEST(Bytes, ReadingPastTheEndReportsTheOffset) {
  const std::vector<std::byte> bytes(6);
  ByteReader r(bytes, 100, "file");
  r.u32();
  EXPECT_CONTAINS(errorMessage([&] { r.u32(); }), "file", "byte 104", "ends early", "4 more", "found 2");
  EXPECT_EQ(r.left(), 2u);  // nothing was consumed
  EXPECT_NE(errorMessage([&] { r.raw(~std::uint64_t{0}); }), "");
}

TEST(Bytes, TrailingBytesAreAnError) {
  const std::vector<std::byte> bytes(3);
  ByteReader r(bytes, 0, "file");
  r.u16();
  EXPECT_TRUE(contains(errorMessage([&] { r.end(); }), "longer"));
}

TEST(Bytes, NumbersAreFinite) {
  const auto reading = [](double value) {
    ByteWriter w;
    w.f64(value);
    const std::vector<std::byte> bytes = w.take();
    return errorMessage([&] { ByteReader(bytes, 0, "file").f64("width"); });
  };
  EXPECT_EQ(reading(1e308), "");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(contains(reading(bad), "width")) << bad;
    EXPECT_TRUE(contains(reading(bad), "not finite")) << bad;
  }
}

TEST(Bytes, UnitVectors) {
  const ByteReader r({}, 0, "file");
  EXPECT_EQ(errorMessage([&] { r.requireUnit({0, 0.6, -0.8}, "axis"); }), "");
  EXPECT_TRUE(contains(errorMessage([&] { r.requireUnit({0, 3, 4}, "axis"); }), "axis", "unit vector"));
}

TEST(Bytes, CountsFitTheBytesThatAreLeft) {
  const auto counting = [](std::uint32_t count, std::size_t following) {
    ByteWriter w;
    w.u32(count);
    for (std::size_t i = 0; i < following; ++i) w.raw(std::array<std::byte, 1>{});
    const std::vector<std::byte> bytes = w.take();
    return errorMessage([&] { EXPECT_EQ(ByteReader(bytes, 0, "file").count(10, 100, "records"), count); });
  };
  EXPECT_EQ(counting(0, 0), "");
  EXPECT_EQ(counting(2, 20), "");
  EXPECT_TRUE(contains(counting(2, 19), "records", "at most 1"));
  EXPECT_TRUE(contains(counting(101, 2000), "records", "100", "101"));
  EXPECT_TRUE(contains(counting(0xffffffffu, 20), "records"));
}

TEST(Bytes, TextLengthIsLimited) {
  ByteWriter w;
  w.text(std::string(70000, 'a'));
  const std::vector<std::byte> bytes = w.take();
  EXPECT_TRUE(contains(errorMessage([&] { ByteReader(bytes, 0, "file").text(); }), "text", "65536"));
  EXPECT_EQ(ByteReader(bytes, 0, "file").text(80000).size(), 70000u);
}

}  // namespace
}  // namespace malus::pack

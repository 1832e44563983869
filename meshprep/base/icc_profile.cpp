#include "meshprep/base/icc_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace malus::image {

namespace {

using Bytes = std::span<const unsigned char>;

// Big-endian numbers; 0 past the end.
std::uint32_t u32(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0u);
  return value;
}
double u16(Bytes bytes, std::size_t at) { return u32(bytes, at) >> 16; }
double s15Fixed16(Bytes bytes, std::size_t at) { return static_cast<std::int32_t>(u32(bytes, at)) / 65536.0; }
std::string_view text(Bytes bytes, std::size_t at, std::size_t count) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, at + count <= bytes.size() ? count : 0};
}

// The element of a tag; empty: the profile has none.
Bytes findTag(Bytes profile, std::string_view name) {
  constexpr std::size_t kTable = 128, kMost = 1000;
  const std::size_t count = std::min<std::size_t>(u32(profile, kTable), kMost);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = kTable + 4 + 12 * i, offset = u32(profile, entry + 4), size = u32(profile, entry + 8);
    if (entry + 12 > profile.size()) break;
    if (text(profile, entry, 4) == name && offset <= profile.size() && size <= profile.size() - offset)
      return profile.subspan(offset, size);
  }
  return {};
}

// A sampled curve, a single exponent or a parametric curve of types 0 to 4.
std::optional<double> evaluateCurve(Bytes curve, double x) {
  if (curve.size() < 12) return std::nullopt;
  if (text(curve, 0, 4) == "curv") {
    const std::size_t count = u32(curve, 8);
    if (count == 0) return x;
    if (count == 1) return std::pow(x, u16(curve, 12) / 256);
    if (count > (curve.size() - 12) / 2) return std::nullopt;
    const double at = x * static_cast<double>(count - 1);
    const auto low = std::min(static_cast<std::size_t>(at), count - 2);
    const double f = at - static_cast<double>(low);
    return (u16(curve, 12 + 2 * low) * (1 - f) + u16(curve, 14 + 2 * low) * f) / 65535;
  }
  if (text(curve, 0, 4) != "para") return std::nullopt;
  const auto type = static_cast<int>(u16(curve, 8));
  std::array<double, 7> p{};  // g a b c d e f
  constexpr std::array<std::size_t, 5> kParameters = {1, 3, 4, 5, 7};
  if (type > 4) return std::nullopt;
  for (std::size_t i = 0; i < kParameters[static_cast<std::size_t>(type)]; ++i) p[i] = s15Fixed16(curve, 12 + 4 * i);
  const auto [g, a, b, c, d, e, f] = p;
  if (type == 0) return std::pow(x, g);
  const double power = std::pow(std::max(a * x + b, 0.0), g);
  if (type <= 2) return (x >= -b / a ? power : 0) + (type == 2 ? c : 0);
  return x >= d ? power + e : c * x + f;
}

bool isSrgbCurve(Bytes curve) {
  for (const double x : {0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    const double expected = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    const std::optional<double> found = evaluateCurve(curve, x);
    if (!found || std::abs(*found - expected) > 0.005) return false;
  }
  return true;
}

bool isNear(Bytes xyz, const std::array<double, 3>& expected) {
  if (xyz.size() < 20) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(s15Fixed16(xyz, 8 + 4 * i) - expected[i]) > 0.002) return false;
  return true;
}

// The letters of a description in ASCII or UTF-16.
bool namesSrgb(Bytes description) {
  std::string letters;
  for (const unsigned char byte : description)
    if (byte != 0) letters += static_cast<char>(byte);
  return letters.find("sRGB") != std::string::npos;
}

}  // namespace

bool isSrgbProfile(Bytes profile) {
  const Bytes grey = findTag(profile, "kTRC");
  if (!grey.empty()) return isSrgbCurve(grey);
  const Bytes red = findTag(profile, "rXYZ");
  if (red.empty()) return namesSrgb(findTag(profile, "desc"));
  // sRGB's colorants under D50 (ICC, "sRGB.icc").
  return isNear(red, {0.4361, 0.2225, 0.0139}) && isNear(findTag(profile, "gXYZ"), {0.3851, 0.7169, 0.0971}) &&
         isNear(findTag(profile, "bXYZ"), {0.1431, 0.0606, 0.7141}) && isSrgbCurve(findTag(profile, "rTRC")) &&
         isSrgbCurve(findTag(profile, "gTRC")) && isSrgbCurve(findTag(profile, "bTRC"));
}

}  // namespace malus::image

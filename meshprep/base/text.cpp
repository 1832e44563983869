#include "meshprep/base/text.h"

#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace malus {

namespace {

struct CodePoint {
  std::uint32_t value = 0;
  std::size_t bytes = 0;  // 0: not UTF-8
};

// Decodes the first character of a text that is not empty. Refuses overlong forms, surrogates and values above 10FFFF
// (Unicode Standard, table 3-7).
CodePoint decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return {};
  constexpr std::array<std::uint32_t, 5> kLowest = {0, 0, 0x80, 0x800, 0x10000};
  std::uint32_t value = first & (0xffu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3f);
  }
  if (value < kLowest[bytes] || value > 0x10ffff || (value >= 0xd800 && value <= 0xdfff)) return {};
  return {value, bytes};
}

bool isControl(std::uint32_t c) { return c < 0x20 || (c >= 0x7f && c <= 0x9f); }

// Invisible or reordering characters. The joiners U+200C and U+200D, which Persian and emoji need, are not among them.
bool isDeceptive(std::uint32_t c) {
  struct Range {
    std::uint32_t low, high;
  };
  constexpr std::array<Range, 9> kRanges = {{{0x61c, 0x61c},
                                             {0x200b, 0x200b},
                                             {0x200e, 0x200f},
                                             {0x2028, 0x202e},
                                             {0x2060, 0x206f},
                                             {0xfdd0, 0xfdef},
                                             {0xfeff, 0xfeff},
                                             {0xfff9, 0xfffb},
                                             {0xe0000, 0xe007f}}};
  for (const Range& r : kRanges)
    if (c >= r.low && c <= r.high) return true;
  return (c & 0xfffe) == 0xfffe;
}

}  // namespace

std::string printable(std::string_view text, bool keepsNewlines) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const CodePoint c = decode(text);
    const std::size_t bytes = c.bytes == 0 ? 1 : c.bytes;
    if (c.bytes == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else if (keepsNewlines && (c.value == '\n' || c.value == '\t'))
      result += static_cast<char>(c.value);
    else if (isControl(c.value))
      result += fmt::format("\\x{:02x}", c.value);
    else if (isDeceptive(c.value))
      result += fmt::format("\\u{{{:x}}}", c.value);
    else
      result += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return result;
}

std::string shortened(std::string_view text, std::size_t columns) {
  constexpr std::string_view kEllipsis = "...";
  std::size_t used = 0, at = 0, cut = 0;
  while (at < text.size()) {
    const CodePoint c = decode(text.substr(at));
    used += c.bytes > 1 ? 2 : 1;
    at += c.bytes == 0 ? 1 : c.bytes;
    if (used + kEllipsis.size() <= columns) cut = at;
    if (used > columns) return std::string(text.substr(0, cut)).append(kEllipsis.substr(0, columns));
  }
  return std::string(text);
}

}  // namespace malus

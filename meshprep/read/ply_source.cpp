#include "meshprep/read/ply_source.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep::ply {

namespace {

// Text with one item per line. Empty lines are skipped.
class Text : public Source {
 public:
  Text(std::string& bytes, std::string_view where, const Header& header)
      : lines_(bytes, where, header.end, header.nextLine), where_(where) {}

  void beginItem(std::string_view what, std::size_t index) override {
    what_ = what;
    do {
      if (!lines_.next()) throw Error(where_, "unexpected end of file", fmt::format("{} {}", what, index));
    } while (lines_.line().empty());
    rest_ = lines_.line();
  }
  void endItem() override {
    const std::string_view word = takeWord(rest_);
    if (!word.empty()) lines_.fail(fmt::format("too many numbers in a {}", what_), "the end of the line", quoted(word));
  }
  void endFile() override {
    while (lines_.next())
      if (!lines_.line().empty())
        lines_.fail("content after the elements of the header", "the end of the file", quoted(lines_.line()));
  }
  bool hasPadding() const override { return false; }  // removed before scanning
  bool hasCrLineEnds() const override { return lines_.hasCrLineEnds(); }

  double coordinate(Type) override { return prep::coordinate(word(), lines_); }
  double real(Type) override {
    const std::string_view number = word();
    const std::string digits(number);
    char* stop = nullptr;
    const double value = std::strtod(digits.c_str(), &stop);
    if (*stop != 0) lines_.fail("invalid number", "a decimal number", quoted(digits));
    lines_.zero(number);
    return value;
  }
  std::int64_t whole(Type) override { return wholeNumber(word(), "an integer", lines_); }
  void skip(Type, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) lines_.zero(word());
  }

  bool locationsAreBytes() const override { return false; }
  std::uint64_t location() const override { return lines_.number(); }
  void fail(std::string_view problem, std::string_view expected, std::string_view found) const override {
    lines_.fail(fmt::format("{} in a {}", problem, what_), expected, found);
  }

 private:
  std::string_view word() {
    const std::string_view word = takeWord(rest_);
    if (word.empty()) lines_.fail(fmt::format("missing numbers in a {}", what_), "one per property");
    return word;
  }

  Lines lines_;
  std::string_view where_;
  std::string_view what_;
  std::string_view rest_;
};

// Binary values.
class Binary : public Source {
 public:
  Binary(std::string_view bytes, std::string_view where, const Header& header)
      : bytes_(bytes),
        where_(where),
        offset_(header.end),
        bigEndian_(header.encoding == Encoding::kBigEndian),
        converted_(header.hasCrLfLineEnds) {}

  void beginItem(std::string_view what, std::size_t index) override {
    what_ = what;
    index_ = index;
    begin_ = offset_;
  }
  void endItem() override {}
  void endFile() override {
    // After a conversion of line ends, zeros at the end may be data.
    hasPadding_ = offset_ < bytes_.size() && !converted_ && isPadding(bytes_.substr(offset_));
    if (offset_ != bytes_.size() && !hasPadding_)
      failAt("content after the elements of the header", "the end of the file",
             fmt::format("{} bytes", bytes_.size() - offset_));
  }
  bool hasPadding() const override { return hasPadding_; }
  bool hasCrLineEnds() const override { return false; }

  double coordinate(Type type) override {
    const double value = real(type);
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
      failAt(fmt::format("invalid number in {} {}", what_, index_), "a finite number within the range of float",
             fmt::to_string(value));
    return value;
  }
  double real(Type type) override {
    if (type == Type::kDouble) return std::bit_cast<double>(raw(8));
    if (type == Type::kFloat) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw(4))));
    return static_cast<double>(whole(type));
  }
  std::int64_t whole(Type type) override {
    const std::uint64_t bits = raw(byteSize(type));
    const auto shift = static_cast<unsigned>(64 - 8 * byteSize(type));
    const bool isSigned = type == Type::kInt8 || type == Type::kInt16 || type == Type::kInt32;
    return isSigned ? static_cast<std::int64_t>(bits << shift) >> shift : static_cast<std::int64_t>(bits);
  }
  void skip(Type type, std::size_t count) override {
    if (count > (bytes_.size() - offset_) / byteSize(type))
      failAt(fmt::format("unexpected end of file in {} {}", what_, index_), fmt::format("{} values", count),
             fmt::format("{} bytes", bytes_.size() - offset_));
    offset_ += count * byteSize(type);
  }

  bool locationsAreBytes() const override { return true; }
  std::uint64_t location() const override { return begin_; }
  void fail(std::string_view problem, std::string_view expected, std::string_view found) const override {
    failAt(fmt::format("{} in {} {}", problem, what_, index_), expected, found);
  }

 private:
  [[noreturn]] void failAt(std::string_view problem, std::string_view expected, std::string_view found) const {
    if (converted_)
      throw Error(fmt::format("{}, byte {}", where_, offset_),
                  fmt::format("{}; the header has CR LF line ends, so the data were probably converted too", problem),
                  fmt::format("{}: transfer the file in binary mode", expected), found);
    throw Error(fmt::format("{}, byte {}", where_, offset_), problem, expected, found);
  }

  // Reads up to 8 bytes as an unsigned integer.
  std::uint64_t raw(std::size_t count) {
    if (count > bytes_.size() - offset_)
      failAt(fmt::format("unexpected end of file in {} {}", what_, index_), fmt::format("{} more bytes", count),
             fmt::to_string(bytes_.size() - offset_));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = bigEndian_ ? i : count - 1 - i;  // most significant first
      value = value << 8u | static_cast<unsigned char>(bytes_[offset_ + from]);
    }
    offset_ += count;
    return value;
  }

  std::string_view bytes_;
  std::string_view where_;
  std::string_view what_;
  std::size_t index_ = 0;
  std::size_t begin_ = 0;
  std::size_t offset_;
  bool bigEndian_;
  bool converted_;  // perhaps: the header has CR LF line ends
  bool hasPadding_ = false;
};

}  // namespace

std::unique_ptr<Source> openSource(std::string& bytes, std::string_view where, const Header& header) {
  if (header.encoding == Encoding::kAscii) return std::make_unique<Text>(bytes, where, header);
  return std::make_unique<Binary>(bytes, where, header);
}

}  // namespace malus::prep::ply

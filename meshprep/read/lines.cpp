#include "meshprep/read/lines.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) - first + 1);
}

// Validates UTF-8 by RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    const unsigned first = byte(i);
    const std::size_t more = first < 0x80 ? 0 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
    if ((first >= 0x80 && first < 0xc2) || first > 0xf4) return false;
    for (std::size_t k = 1; k <= more; ++k)
      if (byte(i + k) < 0x80 || byte(i + k) > 0xbf) return false;
    const unsigned second = byte(i + 1);
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
        (first == 0xf4 && second > 0x8f))
      return false;
    i += more + 1;
  }
  return true;
}

}  // namespace

std::string_view Lines::takeRaw() {
  const std::size_t begin = end_;
  const std::size_t lineFeed = text_.find('\n', begin);
  std::size_t stop = lineFeed == std::string::npos ? text_.size() : lineFeed;
  end_ = lineFeed == std::string::npos ? text_.size() : lineFeed + 1;
  ++nextNumber_;
  if (stop > begin && text_[stop - 1] == '\r') --stop;
  const std::string_view raw = std::string_view(text_).substr(begin, stop - begin);
  for (const char c : raw)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
      fail("control character in a text file", "ASCII or UTF-8", fmt::format("byte {:#04x}", static_cast<unsigned>(c)));
  return raw;
}

bool Lines::next() {
  if (end_ >= text_.size()) return false;
  number_ = nextNumber_;
  raw_ = takeRaw();
  line_ = trimmed(raw_);
  return true;
}

void Lines::joinContinued() {
  if (!raw_.ends_with('\\')) return;
  const auto begin = static_cast<std::size_t>(raw_.data() - text_.data());
  while (raw_.ends_with('\\')) {
    if (end_ >= text_.size()) fail("the file ends after a backslash", "a continuation line");
    const std::size_t backslash = begin + raw_.size() - 1;
    for (std::size_t i = backslash; i < end_; ++i) text_[i] = ' ';
    const std::string_view next = takeRaw();
    raw_ = std::string_view(text_).substr(begin,
                                          static_cast<std::size_t>(next.data() - text_.data()) + next.size() - begin);
  }
  line_ = trimmed(raw_);
}

bool Lines::nextStatement(char comment) {
  while (next()) {
    if (line_.empty()) continue;
    if (line_.front() != comment) return true;
    blank();
  }
  return false;
}

void Lines::blank(std::size_t keep) {
  const auto begin = static_cast<std::size_t>(line_.data() - text_.data());
  for (std::size_t i = keep; i < line_.size(); ++i) text_[begin + i] = ' ';
}

void Lines::zero(std::string_view word) {
  const auto begin = static_cast<std::size_t>(word.data() - text_.data());
  for (std::size_t i = 0; i < word.size(); ++i) text_[begin + i] = i == 0 ? '0' : ' ';
}

void Lines::fail(std::string_view problem, std::string_view expected, std::string_view found) const {
  throw Error(fmt::format("{}:{}", where_, number_), problem, expected, found);
}

std::string_view takeWord(std::string_view& rest) {
  const std::size_t begin = rest.find_first_not_of(kBlanks);
  rest.remove_prefix(begin == std::string_view::npos ? rest.size() : begin);
  const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
  rest.remove_prefix(word.size());
  return word;
}

std::string parseName(std::string_view rest, const Lines& at, std::size_t maxBytes) {
  const std::string_view name = trimmed(rest);
  if (name.size() > maxBytes)
    at.fail("name is too long", fmt::format("at most {} bytes", maxBytes), fmt::format("{} bytes", name.size()));
  if (isUtf8(name)) return std::string(name);
  std::string converted;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      converted += c;
    } else {
      converted += static_cast<char>(0xc0u | code >> 6u);
      converted += static_cast<char>(0x80u | (code & 0x3fu));
    }
  }
  return converted;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  if (word.empty()) return "nothing";
  if (word.size() > kLongest) return fmt::format("\"{}...\"", word.substr(0, kLongest));
  return fmt::format("\"{}\"", word);
}

double coordinate(std::string_view word, const Lines& at) {
  // from_chars accepts "inf" and "nan", and rejects a plus sign.
  std::string_view digits = word;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const std::size_t sign = !digits.empty() && digits.front() == '-' ? 1 : 0;
  if (sign == 1 && digits.size() != word.size()) at.fail("invalid number", "a decimal number", quoted(word));
  const bool decimal =
      digits.size() > sign && (std::isdigit(static_cast<unsigned char>(digits[sign])) != 0 || digits[sign] == '.');
  double value = 0;
  const auto [stop, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // from_chars does not distinguish overflow from underflow; strtod does.
  const bool tooLarge =
      status == std::errc::result_out_of_range && std::isinf(std::strtod(std::string(digits).c_str(), nullptr));
  if (!decimal || stop != digits.data() + digits.size() ||
      (status != std::errc() && status != std::errc::result_out_of_range))
    at.fail("invalid number", "a finite decimal number", quoted(word));
  if (status == std::errc::result_out_of_range && !tooLarge) return sign == 1 ? -0.0 : 0.0;  // underflow
  if (tooLarge || std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
    at.fail("number out of range", "a magnitude of at most 3.4e38", quoted(word));
  return value;
}

long long wholeNumber(std::string_view word, std::string_view expected, const Lines& at) {
  long long value = 0;
  const auto [stop, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || status != std::errc() || stop != word.data() + word.size())
    at.fail("invalid number", expected, quoted(word));
  return value;
}

}  // namespace malus::prep

#include "meshprep/read/lines.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

// Words are short: a loop over their characters is several times faster than the searches of std::string_view.
constexpr bool isBlank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
  while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
  return line;
}

// Returns the position of the first byte below 0x20 from `begin` on, or the size of the text. Reads eight bytes at a
// time; source: S. E. Anderson, "Bit Twiddling Hacks", "Determine if a word has a byte less than n".
std::size_t findControl(std::string_view text, std::size_t begin) {
  constexpr std::uint64_t kOnes = 0x0101010101010101u, kHighBits = 0x80 * kOnes, kBlank = 0x20 * kOnes;
  for (std::uint64_t word = 0; begin + sizeof word <= text.size(); begin += sizeof word) {
    std::memcpy(&word, text.data() + begin, sizeof word);
    if (((word - kBlank) & ~word & kHighBits) != 0) break;
  }
  while (begin < text.size() && static_cast<unsigned char>(text[begin]) >= 0x20) ++begin;
  return begin;
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

// Returns the begin of a comment, or npos. Old runtimes of Microsoft write numbers that are not finite
// as 1.#IND, 1.#INF, 1.#QNAN and 1.#SNAN.
std::size_t findComment(std::string_view line, char comment) {
  std::size_t at = line.find(comment);
  for (; at != std::string_view::npos && at > 0 && line[at - 1] == '.'; at = line.find(comment, at + 1)) {
    const std::string_view word = line.substr(at + 1);
    if (!word.starts_with("IND") && !word.starts_with("INF") && !word.starts_with("QNAN") && !word.starts_with("SNAN"))
      break;
  }
  return at;
}

}  // namespace

std::string_view Lines::takeRaw() {
  // Find the line end, and reject other control characters.
  const std::size_t begin = end_, size = text_.size();
  std::size_t stop = findControl(text_, begin);
  while (stop < size && text_[stop] == '\t') stop = findControl(text_, stop + 1);
  if (stop < size && text_[stop] != '\n' && text_[stop] != '\r')
    fail("control character in a text file", "ASCII or UTF-8",
         fmt::format("byte {:#04x}", static_cast<unsigned char>(text_[stop])));

  // Skip it. In a file of CR alone, an LF belongs to the data after the line.
  end_ = std::min(stop + 1, size);
  if (stop < size && text_[stop] == '\r') {
    const bool onlyCr = hasCrLineEnds_ && !hasCrLfLineEnds_ && !hasLfLineEnds_;
    if (end_ < size && text_[end_] == '\n' && !onlyCr) {
      hasCrLfLineEnds_ = true;
      ++end_;
    } else {
      hasCrLineEnds_ = true;
      text_[stop] = '\n';
    }
  } else if (stop < size) {
    hasLfLineEnds_ = true;
  }
  ++nextNumber_;
  return std::string_view(text_).substr(begin, stop - begin);
}

bool Lines::next() {
  if (end_ >= text_.size()) return false;
  number_ = nextNumber_;
  raw_ = takeRaw();
  line_ = trimmed(raw_);
  return true;
}

void Lines::joinContinued(char comment) {
  if (comment != 0) cutComment(comment);
  // Some writers leave blanks behind the backslash.
  const auto isContinued = [](std::string_view part) { return trimmed(part).ends_with('\\'); };
  if (!isContinued(raw_)) return;
  const auto begin = static_cast<std::size_t>(raw_.data() - text_.data());
  std::string_view last = raw_;
  while (isContinued(last)) {
    if (end_ >= text_.size()) fail("the file ends after a backslash", "a continuation line");
    const std::size_t backslash = static_cast<std::size_t>(last.data() - text_.data()) + last.find_last_of('\\');
    for (std::size_t i = backslash; i < end_; ++i) text_[i] = ' ';
    last = takeRaw();
    raw_ = std::string_view(text_).substr(begin,
                                          static_cast<std::size_t>(last.data() - text_.data()) + last.size() - begin);
    if (const std::size_t begins = comment != 0 ? findComment(last, comment) : std::string_view::npos;
        begins < last.size()) {
      hasCutComments_ = true;
      blankWord(last.substr(begins));
    }
  }
  line_ = trimmed(raw_);
}

void Lines::cutFrom(std::size_t begin) {
  if (begin >= line_.size()) return;
  hasCutComments_ = true;
  blank(begin);
  line_ = trimmed(line_.substr(0, begin));
}

void Lines::cutComment(char comment) { cutFrom(findComment(line_, comment)); }

void Lines::cutSeparateComment(char comment) { cutFrom(lengthWithoutComment(line_, comment)); }

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

void Lines::blankWord(std::string_view word) {
  const auto begin = static_cast<std::size_t>(word.data() - text_.data());
  for (std::size_t i = 0; i < word.size(); ++i) text_[begin + i] = ' ';
}

void Lines::fail(std::string_view problem, std::string_view expected, std::string_view found) const {
  throw Error(fmt::format("{}:{}", where_, number_), problem, expected, found);
}

std::size_t lengthWithoutComment(std::string_view names, char comment) {
  for (std::size_t i = names.find(comment); i < names.size(); i = names.find(comment, i + 1))
    if (i > 0 && isBlank(names[i - 1]) && (i + 1 == names.size() || isBlank(names[i + 1]))) return i;
  return names.size();
}

namespace {

constexpr std::string_view kPadding("\0\x1a \t\r\n", 6);

}  // namespace

bool removePadding(std::string& text) {
  const std::size_t last = text.find_last_not_of(kPadding);
  const std::size_t length = last == std::string::npos ? 0 : last + 1;
  const bool found = text.find_first_of(std::string_view("\0\x1a", 2), length) != std::string::npos;
  if (found) text.resize(length);
  return found;
}

bool isPadding(std::string_view bytes) { return bytes.find_first_not_of(kPadding) == std::string_view::npos; }

std::string_view takeWord(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && isBlank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !isBlank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
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

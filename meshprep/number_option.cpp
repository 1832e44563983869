#include "meshprep/number_option.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace malus {

namespace {

// Removes a plus sign, which from_chars does not accept; "+-1" stays wrong.
std::string_view withoutPlus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

template <class T>
std::optional<T> parse(std::string_view text) {
  text = withoutPlus(text);
  T value{};
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "0 to 64", "0 or more", "over 0"; empty if every finite number is in the range.
std::string rangeText(double low, double high, bool excludesLow) {
  constexpr double kMost = std::numeric_limits<double>::max();
  if (low == -kMost && high == kMost) return {};
  if (high == kMost) return excludesLow ? fmt::format("over {:g}", low) : fmt::format("{:g} or more", low);
  return excludesLow ? fmt::format("over {:g}, to {:g}", low, high) : fmt::format("{:g} to {:g}", low, high);
}

std::string problem(std::string_view kind, const std::string& range, const std::string& found) {
  return fmt::format("expected a {} number{}{}, found '{}'", kind, range.empty() ? "" : ", ", range, found);
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  const std::optional<double> value = parse<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parseWholeNumber(std::string_view text) { return parse<std::int64_t>(text); }

CLI::Validator numberBetween(double low, double high, bool excludesLow) {
  const std::string range = rangeText(low, high, excludesLow);
  return {[=](std::string& text) {
            const std::optional<double> value = parseNumber(text);
            if (!value || *value < low || *value > high || (excludesLow && *value == low))
              return problem("decimal", range, text);
            text = fmt::format("{}", *value);  // the shortest text of this number
            return std::string();
          },
          range};
}

CLI::Validator wholeNumberBetween(std::int64_t low, std::int64_t high) {
  const std::string range = high == std::numeric_limits<std::int64_t>::max() ? fmt::format("{} or more", low)
                                                                             : fmt::format("{} to {}", low, high);
  return {[=](std::string& text) {
            const std::optional<std::int64_t> value = parseWholeNumber(text);
            if (!value || *value < low || *value > high) return problem("whole", range, text);
            text = fmt::format("{}", *value);  // without leading zeros, which CLI11 reads as octal
            return std::string();
          },
          range};
}

CLI::Validator anyNumber() {
  return numberBetween(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
}
CLI::Validator nonNegativeNumber() { return numberBetween(0, std::numeric_limits<double>::max()); }
CLI::Validator positiveNumber() { return numberBetween(0, std::numeric_limits<double>::max(), true); }

}  // namespace malus

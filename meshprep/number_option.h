// Numbers of command-line options. One reading for all: decimal, finite, with an optional sign, without spaces, digit
// separators or a base ("010" is ten; "0x10", " 5", "nan", "inf" and "1e400" are errors). Whole numbers have digits
// only.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace malus {

// Nothing: not such a number, or not representable.
std::optional<double> parseNumber(std::string_view text);
std::optional<std::int64_t> parseWholeNumber(std::string_view text);

// Accepts numbers from low to high. excludesLow: numbers over low. The text becomes one that CLI11 converts to the same
// number. Add them with transform(), so that they run before other checks of the option.
CLI::Validator numberBetween(double low, double high, bool excludesLow = false);
CLI::Validator wholeNumberBetween(std::int64_t low, std::int64_t high = std::numeric_limits<std::int64_t>::max());

// Any finite number; one from 0; one over 0.
CLI::Validator anyNumber();
CLI::Validator nonNegativeNumber();
CLI::Validator positiveNumber();

}  // namespace malus

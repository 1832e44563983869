#include "meshprep/number_option.h"

#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace malus {
namespace {

TEST(NumberOption, ReadsDecimalNumbers) {
  EXPECT_EQ(parseNumber("010"), 10);
  EXPECT_EQ(parseNumber("+5"), 5);
  EXPECT_EQ(parseNumber("-.5"), -0.5);
  EXPECT_EQ(parseNumber("1e3"), 1000);
  EXPECT_EQ(parseWholeNumber("010"), 10);
  EXPECT_EQ(parseWholeNumber("+5"), 5);
  EXPECT_EQ(parseWholeNumber("4294967296"), 4294967296);
}

TEST(NumberOption, RefusesEverythingElse) {
  for (const char* text : {"", " 5", "5 ", "0x10", "1_000", "1,5", "nan", "-nan", "inf", "-inf", "1e400", "-1e400", "+",
                           "-", "--5", "+-5", "5m", "1e", "\xd9\xa5"}) {
    EXPECT_FALSE(parseNumber(text)) << text;
    EXPECT_FALSE(parseWholeNumber(text)) << text;
  }
  for (const char* text : {"1e3", "5.", "5.0", "99999999999999999999"}) EXPECT_FALSE(parseWholeNumber(text)) << text;
}

// The message of a validator, and the text that it leaves for CLI11.
std::pair<std::string, std::string> applied(const CLI::Validator& validator, std::string text) {
  const std::string message = validator(text);
  return {message, text};
}

TEST(NumberOption, ChecksRanges) {
  EXPECT_EQ(applied(wholeNumberBetween(1, 64), "010"), std::pair(std::string(), std::string("10")));
  EXPECT_EQ(applied(numberBetween(0, 1), "+.5").first, "");
  for (const char* text : {"0", "65", "-1", "4294967297"}) {
    const std::string message = applied(wholeNumberBetween(1, 64), text).first;
    EXPECT_NE(message.find("1 to 64"), std::string::npos) << message;
    EXPECT_NE(message.find(text), std::string::npos) << message;
  }
  EXPECT_NE(applied(positiveNumber(), "0").first, "");
  EXPECT_NE(applied(positiveNumber(), "0").first.find("over 0"), std::string::npos);
  EXPECT_EQ(applied(positiveNumber(), "1e-300").first, "");
  EXPECT_EQ(applied(nonNegativeNumber(), "0").first, "");
  EXPECT_EQ(applied(anyNumber(), "-1e300").first, "");
  EXPECT_NE(applied(anyNumber(), "nan").first, "");
}

// CLI11 reads the text that is left as the same number.
TEST(NumberOption, KeepsTheValue) {
  for (const double value : {0.1, 1e-300, 123456789.123, -2.5e17}) {
    double read = 0;
    const std::string text = applied(anyNumber(), fmt::format("{}", value)).second;
    ASSERT_TRUE(CLI::detail::lexical_cast(text, read));
    EXPECT_EQ(read, value);
  }
}

}  // namespace
}  // namespace malus

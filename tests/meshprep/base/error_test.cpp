#include "meshprep/base/error.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <gtest/gtest.h>

namespace malus {
namespace {

// The positions of the location, problem, expected and found values of an error in its text.
struct Positions {
  std::size_t location, problem, expected, found;
};
Positions positions(const std::string& text) {
  return {text.find("a.obj:3"), text.find("invalid index"), text.find("expected 1 to 8"), text.find("found 9")};
}
constexpr std::size_t kNone = std::string::npos;

TEST(Error, ComposesOneLine) {
  const Positions all = positions(Error("a.obj:3", "invalid index", "1 to 8", "9").what());
  EXPECT_EQ(all.location, 0u);
  EXPECT_LT(all.location, all.problem);
  EXPECT_LT(all.problem, all.expected);
  EXPECT_LT(all.expected, all.found);
  EXPECT_NE(all.found, kNone);
}

TEST(Error, LeavesOutEmptyParts) {
  const Positions noFound = positions(Error("a.obj:3", "invalid index", "1 to 8").what());
  EXPECT_NE(noFound.expected, kNone);
  EXPECT_EQ(noFound.found, kNone);
  const std::string noExpected = Error("a.obj:3", "invalid index", "", "9").what();
  EXPECT_EQ(noExpected.find("expected"), kNone);
  EXPECT_NE(positions(noExpected).found, kNone);
  EXPECT_EQ(noExpected.find(','), kNone);
  EXPECT_EQ(positions(Error("", "invalid index").what()).problem, 0u);  // no separator in front
}

TEST(Error, ReplacesControlCharacters) {
  const std::string text = Error("a\nb", "c\x7f\td").what();
  EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }));
  for (const char c : {'a', 'b', 'c', 'd'}) EXPECT_NE(text.find(c), kNone);
}

}  // namespace
}  // namespace malus

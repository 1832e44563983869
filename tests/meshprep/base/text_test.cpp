#include "meshprep/base/text.h"

#include <gtest/gtest.h>

namespace malus {
namespace {

TEST(Text, EscapesControlCharacters) {
  EXPECT_EQ(printable("a\x1b[31m"), "a\\x1b[31m");
  EXPECT_EQ(printable("\a\b\r\n\t\x7f"), "\\x07\\x08\\x0d\\x0a\\x09\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("a\n\tb\x1b", true), "a\n\tb\\x1b");
  EXPECT_EQ(printable("\xc2\x9b[31m"), "\\x9b[31m");  // U+009B, the C1 form of ESC [
}

TEST(Text, EscapesCharactersThatReorderOrHide) {
  EXPECT_EQ(printable("\xe2\x80\xae"), "\\u{202e}");       // right-to-left override
  EXPECT_EQ(printable("\xe2\x81\xa6"), "\\u{2066}");       // isolate
  EXPECT_EQ(printable("\xe2\x80\xa8"), "\\u{2028}");       // line separator
  EXPECT_EQ(printable("\xf3\xa0\x81\x81"), "\\u{e0041}");  // tag
}

TEST(Text, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");           // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // surrogate
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");  // cut
  EXPECT_EQ(printable("\xe2\x82z"), "\\xe2\\x82z");
}

TEST(Text, KeepsNamesOfEveryLanguage) {
  for (const char* name : {"plain", "Gl\xc3\xa4ser", "\xe9\x8f\xa1", "\xd0\xb7\xd0\xb5\xd1\x80", "\xf0\x9f\x94\xad"})
    EXPECT_EQ(printable(name), name);
  const std::string once = printable("\x1b\xff");
  EXPECT_EQ(printable(once), once);
}

TEST(Text, IsShortenedToColumns) {
  EXPECT_EQ(shortened("short", 5), "short");
  EXPECT_EQ(shortened("longer", 5), "lo...");
  EXPECT_EQ(shortened("longer", 2), "..");
  EXPECT_EQ(shortened("\xe9\x8f\xa1\xe9\x8f\xa1\xe9\x8f\xa1", 5), "\xe9\x8f\xa1...");  // two columns each
}

}  // namespace
}  // namespace malus

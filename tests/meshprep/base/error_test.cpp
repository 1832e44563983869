#include "meshprep/base/error.h"

#include <gtest/gtest.h>

namespace malus {
namespace {

TEST(Error, ComposesOneLine) {
  EXPECT_STREQ(Error("a.obj:3", "invalid index", "1 to 8", "9").what(),
               "a.obj:3: invalid index; expected 1 to 8, found 9");
  EXPECT_STREQ(Error("a.obj:3", "invalid index", "1 to 8").what(), "a.obj:3: invalid index; expected 1 to 8");
  EXPECT_STREQ(Error("a.obj:3", "invalid index", "", "9").what(), "a.obj:3: invalid index; found 9");
  EXPECT_STREQ(Error("", "invalid index").what(), "invalid index");
}

TEST(Error, ReplacesControlCharacters) { EXPECT_STREQ(Error("a\nb", "c\x7f\td").what(), "a b: c  d"); }

}  // namespace
}  // namespace malus

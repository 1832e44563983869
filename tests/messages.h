// Messages in tests: the text of an Error, and key words of a text.
#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"

namespace malus::test {

// Returns the message of the Error that `act` throws, or "" if it throws none. Other exceptions propagate.
template <class Act>
std::string errorMessage(Act act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

// Whether the text contains every one of the parts.
template <class... Parts>
bool contains(std::string_view text, const Parts&... parts) {
  return (... && (text.find(parts) != std::string_view::npos));
}

#define EXPECT_CONTAINS(text, ...) EXPECT_TRUE(malus::test::contains(text, __VA_ARGS__)) << (text)

}  // namespace malus::test

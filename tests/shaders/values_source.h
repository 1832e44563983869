// The text of values.h, embedded by the build.
#pragma once

#include <string_view>

namespace malus::test {

extern const std::string_view kValuesSource;

}  // namespace malus::test

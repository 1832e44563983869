// The texts of the probes, embedded by the build.
#pragma once

#include <string_view>

namespace malus::test {

std::string_view probeSource(std::string_view file);  // "probes.h"; empty for a name that is none

}  // namespace malus::test

// The texts of the probes, embedded by the build.
#pragma once

#include <string_view>

namespace malus::test {

std::string_view probeSource(std::string_view file);  // file: such as "probes.h"; empty if unknown

}  // namespace malus::test

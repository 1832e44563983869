// The GLSL sources, embedded by the build.
#pragma once

#include <string_view>

namespace malus::shaders {

// Text of a file by its path in the repository ("shaders/optics/fresnel.h"); empty where there is none.
std::string_view source(std::string_view path);

}  // namespace malus::shaders

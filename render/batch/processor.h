// Features of the processor that images may depend on in their last digits.
#pragma once

#include <string>

namespace malus::render {

// Names of the vector and arithmetic extensions that Embree, the packets of the Embree renderer and the compression of
// EXR files choose their code by, separated by spaces. Source: /proc/cpuinfo; empty if it cannot be read.
std::string processorFeatures();

}  // namespace malus::render

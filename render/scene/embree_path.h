// The two ways in which the Embree renderer traces the rays of a method.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace malus::render {

// packet: batches of rays, shaded on the lanes of SIMD registers. scalar: one ray at a time, which also checks
// numerics.
enum class EmbreePath : std::uint8_t { automatic, packet, scalar };

// On the command line and in JSON, in the order of the enumeration.
inline constexpr std::array<const char*, 3> kEmbreePathNames = {"auto", "packet", "scalar"};
constexpr const char* embreePathName(EmbreePath path) { return kEmbreePathNames[static_cast<std::size_t>(path)]; }

}  // namespace malus::render

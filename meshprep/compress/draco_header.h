// The first bytes of a Draco 2.2 triangle mesh, parsed without Draco: what the file claims about its size
// has to be judged before Draco allocates by it.
// Source: Draco bitstream specification 2.2, sections "DRACO decoder", "Sequential connectivity decoder" and
// "EdgeBreaker connectivity decoder", https://google.github.io/draco/spec/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace malus::compress {

enum class Method : std::uint8_t { kSequential = 0, kEdgebreaker = 1 };

struct DracoHeader {
  Method method = Method::kSequential;
  std::uint32_t vertices = 0;  // sequential: points; edgebreaker: vertices of the connectivity
  std::uint32_t triangles = 0;
};

// Throws Error whose text begins with `where`: not Draco, another version, not a mesh, metadata, cut short,
// counts that contradict each other, more than maxSeams attributes with a connectivity of their own (edgebreaker).
DracoHeader parseHeader(std::span<const std::byte> bytes, std::string_view where, int maxSeams = 1);

}  // namespace malus::compress

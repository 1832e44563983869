// Parser of the first bytes of a Draco 2.2 triangle mesh. It does not call Draco: the declared sizes have to be checked
// before Draco allocates memory for them.
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

// Throws Error at "WHERE, byte N" if the bytes are not Draco 2.2 data of a triangle mesh, have flags or metadata, are
// truncated, declare contradictory counts, or (edgebreaker) have more than maxSeams attributes with separate
// connectivity.
DracoHeader parseHeader(std::span<const std::byte> bytes, std::string_view where, int maxSeams = 1);

}  // namespace malus::compress

// The bytes of one Draco encoding, unproved, and the order that edgebreaker gives a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "meshprep/compress/draco_header.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Nothing where Draco refuses. The mesh and the settings are those that encode() lets through.
std::optional<std::vector<std::byte>> dracoBytes(Method method, const MeshView& mesh, const Settings& settings);

// For each vertex that edgebreaker decodes to, the vertex that it was, as far as Draco tells: the mesh is encoded once
// more with the vertices' numbers in place of their positions, on which the order does not depend. Nothing where Draco
// refuses. Whoever uses it compares.
std::optional<std::vector<std::uint32_t>> edgebreakerOrder(const MeshView& mesh);

}  // namespace malus::compress

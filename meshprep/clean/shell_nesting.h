// Which closed shells lie inside which.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Shell {
  std::vector<glm::uvec3> triangles;  // closed and consistently oriented, to either side
  double volume = 0;                  // without sign
};

struct Nesting {
  std::optional<std::size_t> parent;  // the smallest shell around it
  std::size_t depth = 0;              // how many shells are around it, counted along the parents
};

// More shells than this are not compared with each other.
inline constexpr std::size_t kMaxShells = 4096;

// A shell is inside another where its box lies within the other's (or touches it from inside) and 16 of its vertices,
// evenly chosen, have a winding number of more than 3/4. Shells that only poke into each other are not nested. Returns
// false, having told nothing, where that takes more than 2^28 angles of triangles. nesting: one a shell.
bool nestShells(std::span<const Shell> shells, std::span<const glm::dvec3> positions, std::vector<Nesting>& nesting);

// How often the shell winds around p: 1 or -1 inside, 0 outside, about 1/2 on the surface.
double windingNumber(const Shell& shell, std::span<const glm::dvec3> positions, const glm::dvec3& p);

}  // namespace malus::prep

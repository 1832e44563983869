// Nesting of closed shells.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Shell {
  std::vector<glm::uvec3> triangles;  // closed and consistently oriented, outward or inward
  double volume = 0;                  // absolute value
};

struct Nesting {
  std::optional<std::size_t> parent;  // smallest shell around it
  std::size_t depth = 0;              // number of ancestors
};

// Largest number of shells that are compared.
inline constexpr std::size_t kMaxShells = 4096;

// A shell is inside another if its bounding box is inside the other's and 16 of its vertices, evenly chosen, have a
// winding number above 3/4. Shells that intersect are not nested. nesting: one per shell. Returns false, and resets
// nesting, if more than 2^28 solid angles have to be computed.
bool nestShells(std::span<const Shell> shells, std::span<const glm::dvec3> positions, std::vector<Nesting>& nesting);

// Returns the winding number of the shell around p: 1 or -1 inside, 0 outside, about 1/2 on the surface.
// Source: A. van Oosterom and J. Strackee, IEEE Trans. Biomedical Engineering 30(2), 1983.
double windingNumber(const Shell& shell, std::span<const glm::dvec3> positions, const glm::dvec3& p);

}  // namespace malus::prep

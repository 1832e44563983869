// Draco compression of one triangle mesh, proved by decoding what was written.
//
// Positions are metres in whatever frame the caller keeps; they are rounded to a cubic grid that the
// caller gives. Meshes that share a grid share its points: equal positions decode to equal floats in every
// mesh, so a surface cut into several meshes does not crack. Normals are unit vectors in octahedral
// coordinates. Triangles are counter-clockwise seen from outside and stay so.
//
// Two encodings. Edgebreaker is the smaller; it may reorder vertices and triangles and quietly changes
// non-manifold or degenerate connectivity, so it is kept only where the decoded result has the same counts
// and the same multiset of oriented triangles, corner by corner, as the sequential encoding. Sequential
// keeps counts and order and is itself compared with the input.
//
// The bytes are a plain Draco file (bit stream 2.2, no metadata): draco_decoder reads them. The same mesh
// and settings give the same bytes.
//
// Source: J. Rossignac, "Edgebreaker: Connectivity compression for triangle meshes", IEEE TVCG 5(1), 1999;
// Draco bitstream specification 2.2, https://google.github.io/draco/spec/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::compress {

struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit length; empty, or one a vertex
  std::vector<glm::uvec3> triangles;
};

// More would overflow the corner indices of the codec, which are 32-bit signed.
inline constexpr std::uint32_t kMaxTriangles = 0x7fffffffu / 3;

// The cube [origin, origin + range]^3, divided into 2^positionBits - 1 steps along each axis.
struct Grid {
  glm::vec3 origin{0};
  float range = 1;
  int positionBits = 20;  // 1 to 22: Draco quantizes in float
};

// The smallest cube that holds every position, with a little room for rounding. A mesh without extent gets a
// range of 1. Throws Error where a position is not finite or the extent is beyond what a float holds.
Grid gridFor(std::span<const glm::vec3> positions, int positionBits);

struct Settings {
  Grid grid;
  int normalBits = 12;  // 2 to 16
};

struct Encoded {
  std::vector<std::byte> bytes;
  std::string method;               // "edgebreaker" or "sequential"
  TriangleMesh decoded;             // what decode() makes of the bytes, in that order
  float positionErrorMax = 0;       // largest distance of a vertex from its source, in the unit of positions
  float normalErrorMaxDegrees = 0;  // largest angle between a normal and its source
};

// Throws Error: settings out of bounds, positions outside of the grid, numbers that are not finite, normals
// that are not unit, indices out of range, no vertices or no triangles, more than kMaxTriangles vertices or
// triangles, or a result that does not decode to the input.
Encoded encode(const TriangleMesh& mesh, const Settings& settings);

// What the caller knows the mesh to hold. decode() accepts these counts and no others, and checks them
// before anything is allocated.
struct Limits {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
};

// The counts that a file claims, read from its first bytes without decoding. For an edgebreaker file the
// claim covers files that encode() wrote (one vertex per position). Throws Error where the bytes are not a
// Draco 2.2 triangle mesh.
Limits claimedCounts(std::span<const std::byte> bytes, std::string_view where);

// Throws Error whose text begins with `where`. Accepts what encode() writes: one float position attribute,
// at most one float normal attribute. Everything returned is finite, indices are below the number of
// vertices and normals have unit length. Damaged bytes may still decode to another valid mesh: a caller
// that must know keeps a hash.
TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, std::string_view where);

}  // namespace malus::compress

// Draco compression of one triangle mesh, proved by decoding what was written.
//
// Positions are metres in whatever frame the caller keeps; they are rounded to a cubic grid that the
// caller gives. Meshes that share a grid share its points: equal positions decode to equal floats in every
// mesh, so a surface cut into several meshes does not crack. Normals are unit vectors in octahedral
// coordinates. Triangles are counter-clockwise seen from outside and stay so.
//
// Two encodings. Edgebreaker is the smaller; it may reorder vertices and triangles and quietly changes
// non-manifold or degenerate connectivity, so it is kept only where the decoded result is the sequential one in
// another order: every vertex and every oriented triangle once. Sequential keeps counts and order and is itself
// compared with the input. How many bits are enough is bounds.h.
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

// A mesh that somebody else keeps.
struct MeshView {
  std::span<const glm::vec3> positions;
  std::span<const glm::vec3> normals;
  std::span<const glm::uvec3> triangles;

  MeshView(std::span<const glm::vec3> p, std::span<const glm::vec3> n, std::span<const glm::uvec3> t)
      : positions(p), normals(n), triangles(t) {}
  MeshView(const TriangleMesh& mesh)  // NOLINT(google-explicit-constructor): it is the same thing
      : positions(mesh.positions), normals(mesh.normals), triangles(mesh.triangles) {}
};

// More would overflow the corner indices of the codec, which are 32-bit signed.
inline constexpr std::uint32_t kMaxTriangles = 0x7fffffffu / 3;

// More brings nothing: floats hold 24 bits, and Draco quantizes in float. Measured over cubes of 1 to 5 m, the error of
// a coordinate in shares of the side, largest / mean: 20 bits 5.2e-7 / 2.4e-7, 22 bits 1.9e-7 / 6e-8, 23 bits
// 9.5e-8 / 2.8e-8, 24 bits 1.25e-7 / 3e-8 to 5e-8 (its rounding adds a half that floats there cannot hold), 25 bits
// 6e-8 / 5e-9 to 2e-8, 26 bits 6e-8 / 5e-10 to 2e-8: most floats come back as they were.
inline constexpr int kMaxPositionBits = 26;
inline constexpr int kMinNormalBits = 2;
inline constexpr int kMaxNormalBits = 16;

// The cube [origin, origin + range]^3, divided into 2^positionBits - 1 steps along each axis.
struct Grid {
  glm::vec3 origin{0};
  float range = 1;
  int positionBits = 20;  // 1 to kMaxPositionBits
};

// The smallest cube that holds every position, with a little room for rounding. A mesh without extent gets a
// range of 1. Throws Error where a position is not finite or the extent is beyond what a float holds, or below 1e-30.
Grid gridFor(std::span<const glm::vec3> positions, int positionBits);

struct Settings {
  Grid grid;
  int normalBits = 12;  // kMinNormalBits to kMaxNormalBits
};

// How far a decoded mesh is off its source.
struct Deviation {
  double positionMax = 0;            // largest distance of a vertex, in the unit of positions
  double normalMaxDegrees = 0;       // largest angle between a normal and its source
  double tiltMaxDegrees = 0;         // largest angle between a face and its source, of faces with area in both
  std::uint32_t tiltFace = 0;        // the source's face that has it
  std::uint64_t flipped = 0;         // faces tilted by more than 90 degrees
  std::uint64_t newDegenerate = 0;   // faces that lost their area
  std::uint32_t degenerateFace = 0;  // the first of them
};

struct Encoded {
  std::vector<std::byte> bytes;
  std::string method;         // "edgebreaker" or "sequential"
  std::string whySequential;  // why edgebreaker was not taken; empty where it was
  TriangleMesh decoded;       // what decode() makes of the bytes, in that order

  // The map to the source: the vertex that each decoded vertex is, the triangle that each decoded triangle is. Both are
  // permutations.
  std::vector<std::uint32_t> sourceVertices;
  std::vector<std::uint32_t> sourceTriangles;

  Deviation deviation;
  double encodeMs = 0, decodeMs = 0;  // wall clock, of the bytes that were kept
};

// Throws Error: settings out of bounds, positions outside of the grid, numbers that are not finite, normals
// that are not unit, indices out of range, no vertices or no triangles, more than kMaxTriangles vertices or
// triangles, or a result that does not decode to the input.
Encoded encode(const MeshView& mesh, const Settings& settings);

// What a byte of a Draco file may stand for, at most. Draco sizes its tables by what a file claims, before it has read
// that much: so a claim beyond this is refused, and memory stays in proportion to the file. A flat, even grid of 2
// million triangles takes a byte for 3.4 of them at 20 bits and for 8 at 8 bits; what edgebreaker makes smaller is
// encoded sequentially.
inline constexpr std::uint64_t kMostPerByte = 64;  // vertices; triangles

// What the caller knows the mesh to hold. decode() accepts these counts and no others, and checks them,
// and that the bytes can hold so much, before anything is allocated.
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

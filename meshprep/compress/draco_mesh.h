// Draco compression of one triangle mesh, verified by decoding the result.
//
// Positions are in metres, in the frame of the caller, and are rounded to the cubic grid that the caller gives. Equal
// positions decode to equal floats in all meshes with the same grid, so a surface that is cut into several meshes does
// not crack. Normals are unit vectors, encoded in octahedral coordinates. Triangles are counter-clockwise seen from
// outside and keep their orientation.
//
// There are two encodings. Sequential encoding keeps counts and order, and its result is compared with the input.
// Edgebreaker is smaller, but may reorder vertices and triangles, and silently changes non-manifold or degenerate
// connectivity. It is used only if it decodes to a permutation of the sequential result: every vertex and every
// oriented triangle once. bounds.h chooses the numbers of bits.
//
// The bytes are a plain Draco file (bitstream 2.2, no metadata), which draco_decoder reads. Equal meshes and settings
// give equal bytes.
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
  std::vector<glm::vec3> normals;  // unit length, one per vertex; or empty
  std::vector<glm::uvec3> triangles;
};

// Reference to a mesh, which must outlive it.
struct MeshView {
  std::span<const glm::vec3> positions;
  std::span<const glm::vec3> normals;
  std::span<const glm::uvec3> triangles;

  MeshView(std::span<const glm::vec3> p, std::span<const glm::vec3> n, std::span<const glm::uvec3> t)
      : positions(p), normals(n), triangles(t) {}
  MeshView(const TriangleMesh& mesh)  // NOLINT(google-explicit-constructor): implicit, as std::span
      : positions(mesh.positions), normals(mesh.normals), triangles(mesh.triangles) {}
};

// Limit of vertices and of triangles: Draco indexes corners by 32-bit signed integers.
inline constexpr std::uint32_t kMaxTriangles = 0x7fffffffu / 3;

// Largest useful number of bits, because Draco quantizes in float (24 bits). Measured for cubes of 1 to 5 m, largest
// and mean error of a coordinate relative to the side: 20 bits 5.2e-7 and 2.4e-7; 22 bits 1.9e-7 and 6e-8; 23
// bits 9.5e-8 and 2.8e-8; 24 bits 1.25e-7 and 3e-8 to 5e-8 (Draco adds 0.5, which is not representable there); 25 bits
// 6e-8 and 5e-9 to 2e-8; 26 bits 6e-8 and 5e-10 to 2e-8, where most floats are reproduced exactly.
inline constexpr int kMaxPositionBits = 26;
inline constexpr int kMinNormalBits = 2;
inline constexpr int kMaxNormalBits = 16;

// Cube from origin to origin + range, metres, with 2^positionBits - 1 steps along each axis.
struct Grid {
  glm::vec3 origin{0};
  float range = 1;
  int positionBits = 20;  // 1 to kMaxPositionBits
};

// Returns the smallest cube that contains all positions, enlarged by a few rounding errors. The range is 1 if all
// positions are equal. Throws Error if a position is not finite, or the extent is above the range of float or in
// (0, 1e-30).
Grid gridFor(std::span<const glm::vec3> positions, int positionBits);

struct Settings {
  Grid grid;
  int normalBits = 12;  // kMinNormalBits to kMaxNormalBits
};

// Deviation of a decoded mesh from its source.
struct Deviation {
  double positionMax = 0;            // largest distance between a vertex and its source, metres
  double normalMaxDegrees = 0;       // largest angle between a normal and its source
  double tiltMaxDegrees = 0;         // largest angle between a face and its source, if both have area
  std::uint32_t tiltFace = 0;        // face of the source with this angle
  std::uint64_t flipped = 0;         // faces tilted by more than 90 degrees
  std::uint64_t newDegenerate = 0;   // faces that lost their area
  std::uint32_t degenerateFace = 0;  // first of these faces
};

struct Encoded {
  std::vector<std::byte> bytes;
  std::string method;            // "edgebreaker" or "sequential"
  std::string sequentialReason;  // reason against edgebreaker; empty if it is used. Stored in packs
  TriangleMesh decoded;          // result of decode(bytes)

  // Map to the source: source vertex of each decoded vertex, source triangle of each decoded triangle. Permutations.
  std::vector<std::uint32_t> sourceVertices;
  std::vector<std::uint32_t> sourceTriangles;

  Deviation deviation;
  double encodeMs = 0, decodeMs = 0;  // wall-clock time of the chosen encoding
};

// Throws Error: settings out of range, positions outside of the grid, values that are not finite, normals that do not
// have unit length, indices out of range, no vertices or no triangles, more than kMaxTriangles of either, or a result
// that does not decode to the input.
Encoded encode(const MeshView& mesh, const Settings& settings);

// Largest number of vertices, and of triangles, per byte of a Draco file. Draco allocates its tables for the declared
// counts before it reads the data; files that declare more are refused, so that memory is proportional to the file
// size. A flat, regular grid of 2 million triangles has 3.4 triangles per byte at 20 bits and 8 at 8 bits. Meshes that
// edgebreaker compresses below the limit are encoded sequentially.
inline constexpr std::uint64_t kMaxPerByte = 64;

// Counts that decode() requires. It checks them against the declared counts and the number of bytes before it
// allocates memory.
struct Limits {
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
};

// Returns the counts that the header declares, without decoding. Valid for edgebreaker files by encode() only, which
// have one vertex per position. Throws Error (begins with `where`) if the bytes are not a Draco 2.2 triangle mesh.
Limits declaredCounts(std::span<const std::byte> bytes, std::string_view where);

// Decodes files by encode(): one position attribute and at most one normal attribute, both of floats. All values of
// the result are finite, indices are below the number of vertices and normals have unit length. Throws Error (begins
// with `where`). Corrupt bytes may decode to a different valid mesh: store a hash to detect them.
TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, std::string_view where);

}  // namespace malus::compress

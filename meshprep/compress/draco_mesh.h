// Draco compression of one triangle mesh, verified by decoding the result.
//
// Positions are in metres, in double, and are rounded to a grid: origin + step * integer, with a step that is a power
// of two and an origin that is a multiple of it. Draco stores the integers, without a further quantization; origin
// and step are stored beside its data. Every position of a grid is exact in double, so that grids with the same anchor
// agree on all points that they share. Normals are unit vectors, encoded in octahedral coordinates. Triangles are
// counter-clockwise seen from outside and keep their orientation.
//
// There are two encodings. Sequential encoding keeps counts and order. Edgebreaker is smaller, but may reorder vertices
// and triangles, and silently changes non-manifold or degenerate connectivity. It is used only if it is smaller than
// the sequential encoding, which is encoded only where the size of its indices does not decide that, and if it decodes
// to a permutation of the input: every vertex and every oriented triangle once. Both are compared with the input: the
// integers of the grid and the rounded normals are equal. bounds.h and rounding.h choose the grid and the numbers of
// bits.
//
// The bytes are a plain Draco file (bitstream 2.2, no metadata), which draco_decoder reads: its positions are the
// integers. Equal meshes and settings give equal bytes.
//
// Source: J. Rossignac, "Edgebreaker: Connectivity compression for triangle meshes", IEEE TVCG 5(1), 1999;
// Draco bitstream specification 2.2, https://google.github.io/draco/spec/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "meshprep/compress/texture_rounding.h"

namespace malus::compress {

struct TriangleMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  // unit length, one per vertex; or empty
  std::vector<glm::uvec3> triangles;
  std::array<std::vector<glm::vec2>, 2> textureCoordinates;  // one per vertex, or empty
  std::vector<glm::vec4> tangents;                           // unit length, and the sign of the bitangent; or empty
};

// Factors by which the places of a mesh in a scene change its lengths and may change its angles. Bounds of errors
// are kept at every place.
struct Magnification {
  bool isPlaced = false;  // by transforms too
  double smallest = 1;    // factors of lengths; without transforms: 1
  double largest = 1;
  double angle = 1;  // at least 1
};

// Reference to a mesh, which must outlive it.
struct MeshView {
  std::span<const glm::dvec3> positions;
  std::span<const glm::vec3> normals;
  std::span<const glm::uvec3> triangles;
  Magnification magnification = {};

  MeshView(std::span<const glm::dvec3> p, std::span<const glm::vec3> n, std::span<const glm::uvec3> t)
      : positions(p), normals(n), triangles(t) {}
  MeshView(const TriangleMesh& mesh)  // NOLINT(google-explicit-constructor): implicit, as std::span
      : positions(mesh.positions), normals(mesh.normals), triangles(mesh.triangles) {}
};

// Limit of vertices and of triangles: Draco indexes corners by 32-bit signed integers.
inline constexpr std::uint32_t kMaxTriangles = 0x7fffffffu / 3;

// Draco's prediction of 32-bit integers needs two spare bits.
inline constexpr int kMaxPositionBits = 30;
inline constexpr int kMinNormalBits = 2;
inline constexpr int kMaxNormalBits = 16;

// Positions are at most this number of steps from zero, so that they and their differences are exact in double.
inline constexpr double kMaxSteps = 0x1p52;

// Accepted sizes (largest extents along an axis) of a mesh, metres, and its distance from zero relative to its size.
// Within them, areas and volumes neither overflow nor underflow, and double resolves a millionth of the size.
inline constexpr double kMinExtent = 1e-40;
inline constexpr double kMaxExtent = 1e38;
inline constexpr double kMaxDistance = 1e9;

// The positions origin + step * (i, j, k), with integers from 0 to 2^positionBits - 1.
struct Grid {
  glm::dvec3 origin{0};   // multiple of the step, metres; at most kMaxSteps steps
  double step = 1;        // power of two, metres
  int positionBits = 20;  // 1 to kMaxPositionBits
};

// Returns the grid of the smallest step for which this number of bits suffices. Throws Error if a position is not
// finite, or the mesh is outside of the accepted range; `where` begins the message.
Grid gridFor(std::span<const glm::dvec3> positions, int positionBits, std::string_view where = "mesh to compress");

// Returns the grid of the given step around positions that are multiples of it. Its number of bits may exceed
// kMaxPositionBits.
Grid gridWithStep(std::span<const glm::dvec3> positions, double step);

// Throws Error unless size and distance from zero are in the accepted range. Meshes of one point are accepted.
void requireAcceptedSize(std::span<const glm::dvec3> positions, std::string_view where);

struct Settings {
  Grid grid;
  int normalBits = 12;    // kMinNormalBits to kMaxNormalBits
  double leastCross = 0;  // faces below it count as having lost their area (deviation.h)
};

// Deviation of a decoded mesh from its source.
struct Deviation {
  double positionMax = 0;            // largest distance between a vertex and its source, metres
  double normalMaxDegrees = 0;       // largest angle between a normal and its source
  double tiltMaxDegrees = 0;         // largest angle between a face and its source, if both have area
  std::uint32_t tiltFace = 0;        // face of the source with this angle
  std::uint64_t faces = 0;           // faces of the source that have area
  std::uint64_t tilted = 0;          // faces tilted by more than kDefaultTiltDegrees (bounds.h)
  double tiltedArea = 0;             // their area in the source, square metres
  std::uint64_t flipped = 0;         // faces tilted by more than 90 degrees
  std::uint32_t flippedFace = 0;     // first of these faces
  std::uint64_t newDegenerate = 0;   // faces that lost their area
  double degenerateArea = 0;         // their area in the source, square metres
  std::uint32_t degenerateFace = 0;  // first of these faces
};

struct Encoded {
  std::vector<std::byte> bytes;
  std::string method;            // "edgebreaker" or "sequential"
  std::string sequentialReason;  // reason against edgebreaker; empty if it is used. Stored in packs

  // Map to the source: source vertex of each decoded vertex, source triangle of each decoded triangle. Permutations.
  std::vector<std::uint32_t> sourceVertices;
  std::vector<std::uint32_t> sourceTriangles;

  Deviation deviation;
  double encodeMs = 0, decodeMs = 0;  // processor time of the chosen encoding
};

// Encoder of one mesh. It has a copy of what Draco needs, so that the caller may free the mesh before encode(), which
// takes most memory: some 80 bytes per triangle.
class Encoder {
 public:
  // As encode() below.
  Encoder(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
          const RoundedTextures& textures = {});
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  // Deviation of the rounded mesh, and of the decoded one: encode() throws unless they are equal.
  const Deviation& deviation() const { return deviation_; }

  Encoded encode() const;

 private:
  struct Input;
  std::unique_ptr<Input> input_;
  Deviation deviation_;
};

// Rounds the positions to the grid. Throws Error: settings out of range, positions outside of the grid, values that are
// not finite, normals that do not have unit length, indices out of range, no vertices or no triangles, more than
// kMaxTriangles of either, or a result that does not decode to the input.
Encoded encode(const MeshView& mesh, const Settings& settings);

// The same for positions that the caller rounded: one point of the grid per vertex of mesh. The deviation is that from
// mesh. textures: rounded attributes, which Draco stores without a change.
Encoded encode(const MeshView& mesh, std::span<const glm::dvec3> rounded, const Settings& settings,
               const RoundedTextures& textures = {});

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

// Decodes files by encode(): one attribute of positions, three integers of the grid (draco_write.h: above 20 bits
// in two attributes), at most one of normals, three floats, and those of textures that have a grid. All values of the
// result are finite, indices are below the number of vertices and normals have unit length. Throws Error (begins with
// `where`). Corrupt bytes may decode to a different valid mesh: store a hash to detect them.
TriangleMesh decode(std::span<const std::byte> bytes, const Limits& limits, const Grid& grid, std::string_view where,
                    const TextureGrids& textures = {});

// Decodes the files of packs of format version 1, whose positions are three floats that Draco quantized.
TriangleMesh decodeFloats(std::span<const std::byte> bytes, const Limits& limits, std::string_view where);

// Throws Error (begins with `where`) unless step, origin and bits are as Grid states.
void requireValid(const Grid& grid, std::string_view where);

}  // namespace malus::compress

// The header of a PLY file: which elements follow, with which properties, in which encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/read/lines.h"

namespace malus::prep::ply {

enum class Type : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
std::size_t sizeOf(Type type);  // bytes
inline bool isReal(Type type) { return type == Type::kFloat || type == Type::kDouble; }

// What a property is to the surface.
enum class Role : std::uint8_t { kNone, kColour, kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kCorners };

struct Property {
  Type type{};
  std::optional<Type> countType;  // set for lists
  Role role = Role::kNone;
  bool openMeshReadsLength = false;  // of the list: it knows few names of types there
};

enum class Kind : std::uint8_t { kVertices, kFaces, kStrips, kOther };

struct Element {
  Kind kind = Kind::kOther;
  std::size_t count = 0;
  std::size_t line = 0;  // that declares it
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;  // in the order of their data; those that count none are left out
  std::size_t vertices = 0;
  bool hasNormals = false;    // all three of nx, ny, nz are there as real numbers
  std::size_t end = 0;        // offset of the first byte of data
  std::size_t nextLine = 0;   // number of the first line of data, if it is text
  bool openMeshReads = true;  // vertices, then faces, in the types that OpenMesh knows, and nothing else
};

// Reads to the end of the header and checks it: every property known, coordinates and corners there, every count
// backed by bytes of the file. Comments and elements without data become blanks, which OpenMesh skips. Throws Error
// that names where:line.
Header scanHeader(std::string& bytes, std::string_view where);

}  // namespace malus::prep::ply

// Header of a PLY file: encoding, elements and their properties.
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
// Returns the size of a value in bytes.
std::size_t byteSize(Type type);
inline bool isReal(Type type) { return type == Type::kFloat || type == Type::kDouble; }

// Meaning of a property.
enum class Role : std::uint8_t { kNone, kColour, kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kCorners };

struct Property {
  Type type{};
  std::optional<Type> countType;  // set for lists
  Role role = Role::kNone;
  bool openMeshReadsLength = false;  // OpenMesh knows the name of countType; it knows few
};

enum class Kind : std::uint8_t { kVertices, kFaces, kStrips, kOther };

struct Element {
  Kind kind = Kind::kOther;
  std::size_t count = 0;
  std::size_t line = 0;  // declared in this line
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;  // in the order of their data, without empty ones
  std::size_t vertices = 0;
  bool hasNormals = false;    // nx, ny and nz are real numbers
  std::size_t end = 0;        // offset of the data
  std::size_t nextLine = 0;   // number of the first line of the data, if it is text
  bool openMeshReads = true;  // only vertices, then faces, in types that OpenMesh knows
  bool hasCrLineEnds = false, hasCrLfLineEnds = false;
};

// Parses and checks the header: types, coordinates, corners, and counts against the file size. Comments and empty
// elements become blanks, which OpenMesh skips. The data of a binary file begin after the LF, CR LF or, if all lines of
// the header end in CR, the CR. Throws Error at "WHERE:LINE".
Header scanHeader(std::string& bytes, std::string_view where);

}  // namespace malus::prep::ply

#include "meshprep/read/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::prep::ply {

namespace {

struct NamedType {
  std::string_view name;
  Type type;
};
constexpr std::array<NamedType, 16> kTypes = {{{"char", Type::kInt8},
                                               {"int8", Type::kInt8},
                                               {"uchar", Type::kUint8},
                                               {"uint8", Type::kUint8},
                                               {"short", Type::kInt16},
                                               {"int16", Type::kInt16},
                                               {"ushort", Type::kUint16},
                                               {"uint16", Type::kUint16},
                                               {"int", Type::kInt32},
                                               {"int32", Type::kInt32},
                                               {"uint", Type::kUint32},
                                               {"uint32", Type::kUint32},
                                               {"float", Type::kFloat},
                                               {"float32", Type::kFloat},
                                               {"double", Type::kDouble},
                                               {"float64", Type::kDouble}}};

struct NamedRole {
  std::string_view name;
  Role role;
};
constexpr std::array<NamedRole, 14> kVertexRoles = {{{"x", Role::kX},
                                                     {"y", Role::kY},
                                                     {"z", Role::kZ},
                                                     {"nx", Role::kNormalX},
                                                     {"ny", Role::kNormalY},
                                                     {"nz", Role::kNormalZ},
                                                     {"red", Role::kColour},
                                                     {"green", Role::kColour},
                                                     {"blue", Role::kColour},
                                                     {"alpha", Role::kColour},
                                                     {"diffuse_red", Role::kColour},
                                                     {"diffuse_green", Role::kColour},
                                                     {"diffuse_blue", Role::kColour},
                                                     {"diffuse_alpha", Role::kColour}}};

Type typeNamed(std::string_view name, const Lines& at) {
  for (const NamedType& type : kTypes)
    if (type.name == name) return type.type;
  at.fail("unknown type of a property", "char to double, or int8 to float64", quoted(name));
}

Role roleNamed(std::string_view name, const Property& property, Kind kind) {
  const bool isCorners = name == "vertex_indices" || name == "vertex_index";
  if (property.countType) return isCorners && kind != Kind::kVertices ? Role::kCorners : Role::kNone;
  for (const NamedRole& role : kVertexRoles)
    if (role.name == name && (kind == Kind::kVertices || role.role == Role::kColour)) return role.role;
  return Role::kNone;
}

Property scanProperty(std::string_view rest, Kind kind, const Lines& at) {
  Property property;
  std::string_view word = takeWord(rest);
  if (word == "list") {
    const std::string_view length = takeWord(rest);
    property.countType = typeNamed(length, at);
    property.openMeshReadsLength = length == "uchar" || length == "uint8" || length == "int";
    if (isReal(*property.countType)) at.fail("list length is not an integer", "char to uint", quoted(at.line()));
    word = takeWord(rest);
  }
  property.type = typeNamed(word, at);
  const std::string_view name = takeWord(rest);
  if (name.empty() || !takeWord(rest).empty()) at.fail("invalid property", "a type and a name", quoted(at.line()));
  property.role = roleNamed(name, property, kind);
  if (property.role == Role::kCorners && isReal(property.type))
    at.fail("corners are not integers", "a list of char to uint", quoted(at.line()));
  return property;
}

std::ptrdiff_t countProperties(Role role, const Element& element) {
  return std::count_if(element.properties.begin(), element.properties.end(),
                       [role](const Property& p) { return p.role == role; });
}

// Returns the smallest size of an item in bytes; a value of text has a digit and a separator.
std::size_t minItemBytes(const Element& element, Encoding encoding) {
  std::size_t bytes = 0;
  for (const Property& p : element.properties)
    bytes += encoding == Encoding::kAscii ? 2 : byteSize(p.countType.value_or(p.type));
  return bytes;
}

void checkVertices(Element& element, Header& header, const Lines& at) {
  constexpr std::array<std::pair<Role, char>, 3> kAxes = {{{Role::kX, 'x'}, {Role::kY, 'y'}, {Role::kZ, 'z'}}};
  for (const auto& [role, name] : kAxes) {
    const std::ptrdiff_t count = countProperties(role, element);
    if (count == 0) at.fail("missing coordinates of vertices", "properties x, y and z");
    if (count > 1) at.fail("duplicate coordinate", "one x, one y, one z", std::string(1, name));
  }
  for (const Property& p : element.properties)
    if (p.countType || (p.role >= Role::kX && p.role <= Role::kZ && !isReal(p.type))) header.openMeshReads = false;

  // Use normals if all three components exist once as real numbers; otherwise ignore them as other properties.
  header.hasNormals = true;
  for (const Role role : {Role::kNormalX, Role::kNormalY, Role::kNormalZ}) {
    const auto isNormal = [role](const Property& p) { return p.role == role && isReal(p.type); };
    if (std::count_if(element.properties.begin(), element.properties.end(), isNormal) != 1 ||
        countProperties(role, element) != 1)
      header.hasNormals = false;
  }
  if (!header.hasNormals)
    for (Property& p : element.properties)
      if (p.role >= Role::kNormalX && p.role <= Role::kNormalZ) p.role = Role::kNone;
}

void checkCorners(const Element& element, Header& header, const Lines& at) {
  if (countProperties(Role::kCorners, element) != 1)
    at.fail(element.kind == Kind::kFaces ? "missing corners of faces" : "missing corners of strips",
            "one list of integers, vertex_indices");
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& p = element.properties[i];
    if ((p.role == Role::kCorners) != (i == 0) || (p.countType && (i > 0 || !p.openMeshReadsLength)))
      header.openMeshReads = false;
  }
}

// The header is checked as a whole once it is known.
void checkHeader(Header& header, std::size_t fileBytes, std::string_view where, const Lines& at) {
  std::size_t room = fileBytes - header.end + 1;  // the last line need not end
  bool hasVertices = false, hasSurface = false;
  for (Element& element : header.elements) {
    // Check its properties.
    if (element.properties.empty()) at.fail("element without properties", "one property or more");
    if (element.kind == Kind::kVertices) {
      hasVertices = true;
      header.vertices = element.count;
      checkVertices(element, header, at);
    } else if (element.kind == Kind::kFaces || element.kind == Kind::kStrips) {
      hasSurface = true;
      if (!hasVertices || element.kind == Kind::kStrips) header.openMeshReads = false;
      checkCorners(element, header, at);
    } else {
      header.openMeshReads = false;
    }

    // Check its count.
    const std::size_t most = room / minItemBytes(element, header.encoding);
    if (element.count > most)
      throw Error(fmt::format("{}:{}", where, element.line), "count exceeds the file size",
                  fmt::format("at most {}", most), fmt::to_string(element.count));
    room -= element.count * minItemBytes(element, header.encoding);
  }
  if (!hasVertices) at.fail("missing element in the header", "vertex");
  if (!hasSurface) at.fail("missing element in the header", "face or tristrips");
}

Encoding scanFormat(Lines& lines) {
  if (!lines.next() || lines.line() != "ply") lines.fail("is not a PLY file", "ply", quoted(lines.line()));
  if (!lines.next()) lines.fail("unexpected end of the header", "a format");
  std::string_view rest = lines.line();
  const std::string_view keyword = takeWord(rest);
  const std::string_view format = takeWord(rest);
  if (keyword != "format") lines.fail("missing format in the second line", "format ... 1.0", quoted(lines.line()));
  constexpr std::array<std::pair<std::string_view, Encoding>, 3> kFormats = {
      {{"ascii", Encoding::kAscii},
       {"binary_little_endian", Encoding::kLittleEndian},
       {"binary_big_endian", Encoding::kBigEndian}}};
  const auto* const known =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& named) { return named.first == format; });
  if (known == kFormats.end())
    lines.fail("unknown PLY format", "ascii, binary_little_endian or binary_big_endian", quoted(format));
  if (takeWord(rest) != "1.0") lines.fail("unknown PLY version", "1.0", quoted(lines.line()));
  return known->second;
}

// Parses the declaration of an element.
Element scanElement(std::string_view rest, std::size_t fileBytes, const Lines& at) {
  const std::string_view name = takeWord(rest);
  const long long count = wholeNumber(takeWord(rest), "a number of elements", at);
  const std::size_t most = std::min<std::size_t>(fileBytes, std::numeric_limits<int>::max());
  if (count < 0 || static_cast<unsigned long long>(count) > most)
    at.fail("count exceeds the file size", fmt::format("at most {}", most), fmt::to_string(count));
  Element element;
  if (name == "vertex") element.kind = Kind::kVertices;
  if (name == "face") element.kind = Kind::kFaces;
  if (name == "tristrips") element.kind = Kind::kStrips;
  element.count = static_cast<std::size_t>(count);
  element.line = at.number();
  return element;
}

}  // namespace

std::size_t byteSize(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Header scanHeader(std::string& bytes, std::string_view where) {
  Lines lines(bytes, where);
  Header header;
  header.encoding = scanFormat(lines);
  std::array<bool, 4> seen{};  // by kind
  Element* element = nullptr;  // current element
  Element withoutData;         // receives the properties of empty elements
  while (lines.next()) {
    std::string_view rest = lines.line();
    const std::string_view statement = takeWord(rest);
    if (statement == "end_header") {
      header.end = lines.endOffset();
      header.nextLine = lines.nextNumber();
      header.hasCrLineEnds = lines.hasCrLineEnds();
      header.hasCrLfLineEnds = lines.hasCrLfLineEnds();
      if (header.encoding != Encoding::kAscii && header.hasCrLfLineEnds) header.openMeshReads = false;
      checkHeader(header, bytes.size(), where, lines);
      return header;
    }
    if (statement == "element") {
      Element next = scanElement(rest, bytes.size(), lines);
      bool& isDuplicate = seen[static_cast<std::size_t>(next.kind)];
      if (isDuplicate && next.kind != Kind::kOther) lines.fail("duplicate element", "each element once", quoted(rest));
      isDuplicate = true;
      const bool counts = next.count > 0 || next.kind == Kind::kVertices || next.kind == Kind::kFaces;
      if (counts) header.elements.push_back(std::move(next));
      element = counts ? &header.elements.back() : &withoutData;
      if (!counts) lines.blank();
    } else if (statement == "property") {
      if (!element) lines.fail("property without an element", "an element first");
      Property property = scanProperty(rest, element->kind, lines);
      if (element == &withoutData) {
        lines.blank();
      } else {
        element->properties.push_back(property);
      }
    } else if (statement == "comment" || statement == "obj_info") {
      // Blank comments, and rename obj_info, after which OpenMesh continues in the same line.
      lines.blank(statement.size());
      const auto begin = static_cast<std::size_t>(lines.line().data() - bytes.data());
      if (statement == "obj_info") bytes.replace(begin, statement.size(), "comment ");
    } else {
      lines.fail("unknown statement", "element, property, comment or end_header", quoted(statement));
    }
  }
  throw Error(where, "unexpected end of the header", "end_header");
}

}  // namespace malus::prep::ply

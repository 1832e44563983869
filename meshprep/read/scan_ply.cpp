// Polygon File Format: ASCII and binary of either byte order, elements `vertex` and `face`. Triangle strips,
// other elements with data and list types that OpenMesh does not read are errors.
// Source: G. Turk, "The PLY Polygon File Format", Stanford University, 1994.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

struct Type {
  std::string_view name;
  std::size_t bytes;
  enum class Kind { kSigned, kUnsigned, kFloat } kind;
};

constexpr std::array<Type, 16> kTypes = {{{"char", 1, Type::Kind::kSigned},
                                          {"int8", 1, Type::Kind::kSigned},
                                          {"uchar", 1, Type::Kind::kUnsigned},
                                          {"uint8", 1, Type::Kind::kUnsigned},
                                          {"short", 2, Type::Kind::kSigned},
                                          {"int16", 2, Type::Kind::kSigned},
                                          {"ushort", 2, Type::Kind::kUnsigned},
                                          {"uint16", 2, Type::Kind::kUnsigned},
                                          {"int", 4, Type::Kind::kSigned},
                                          {"int32", 4, Type::Kind::kSigned},
                                          {"uint", 4, Type::Kind::kUnsigned},
                                          {"uint32", 4, Type::Kind::kUnsigned},
                                          {"float", 4, Type::Kind::kFloat},
                                          {"float32", 4, Type::Kind::kFloat},
                                          {"double", 8, Type::Kind::kFloat},
                                          {"float64", 8, Type::Kind::kFloat}}};

struct Property {
  std::string_view name;
  Type type{};
  std::optional<Type> countType;  // set for lists
};

enum class Encoding { kAscii, kLittle, kBig };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::vector<Property> vertexProperties;
  std::vector<Property> faceProperties;
  std::array<std::size_t, 3> xyz{};                  // which vertex properties are the coordinates
  std::optional<std::array<std::size_t, 3>> normal;  // and the normal, nx ny nz
  std::size_t end = 0;                               // offset of the first byte of data
};

Type typeNamed(std::string_view name, const Lines& at) {
  for (const Type& type : kTypes)
    if (type.name == name) return type;
  at.fail("an unknown property type", "char to double, or int8 to float64", quoted(name));
}

Property scanProperty(std::string_view rest, bool ofFace, const Lines& at) {
  Property property;
  std::string_view word = takeWord(rest);
  if (word == "list") {
    property.countType = typeNamed(takeWord(rest), at);
    word = takeWord(rest);
    if (!ofFace) at.fail("a list in the vertices", "numbers only");
    // The two types of count that OpenMesh reads.
    const std::string_view count = property.countType->name;
    if (count != "uchar" && count != "uint8" && count != "int" && count != "int32")
      at.fail("an unusual type for the number of corners", "uchar or int", quoted(count));
  }
  property.type = typeNamed(word, at);
  property.name = takeWord(rest);
  if (property.name.empty() || !takeWord(rest).empty())
    at.fail("a bad property", "a type and a name", quoted(at.line()));
  return property;
}

// The header is checked as a whole once it is known.
void checkHeader(Header& header, const Lines& at) {
  // Step 1: coordinates.
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto hasName = [&](const Property& p) { return p.name == kAxes[axis]; };
    const auto found = std::find_if(header.vertexProperties.begin(), header.vertexProperties.end(), hasName);
    if (found == header.vertexProperties.end() || found->type.kind != Type::Kind::kFloat)
      at.fail("the vertices have no coordinates", "properties x, y and z of type float or double");
    if (std::count_if(header.vertexProperties.begin(), header.vertexProperties.end(), hasName) > 1)
      at.fail("a coordinate is there twice", "one x, one y, one z", quoted(kAxes[axis]));
    header.xyz[axis] = static_cast<std::size_t>(found - header.vertexProperties.begin());
  }

  // Step 2: normals, where all three are there.
  constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};
  std::array<std::size_t, 3> normal{};
  std::array<int, 3> known{};
  for (std::size_t k = 0; k < header.vertexProperties.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (header.vertexProperties[k].name == kNormal[axis] &&
          header.vertexProperties[k].type.kind == Type::Kind::kFloat) {
        normal[axis] = k;
        ++known[axis];
      }
  if (known == std::array<int, 3>{1, 1, 1}) header.normal = normal;

  // Step 3: corners, first of the face's properties; lists beside them are not read right by OpenMesh.
  const auto isCorners = [](const Property& p) {
    return p.countType && (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  if (header.faceProperties.empty() || !isCorners(header.faceProperties.front()) ||
      header.faceProperties.front().type.kind == Type::Kind::kFloat)
    at.fail("the faces have no corners", "a list of whole numbers, vertex_indices, first of the face's properties");
  for (std::size_t i = 1; i < header.faceProperties.size(); ++i)
    if (header.faceProperties[i].countType)
      at.fail("a second list in the faces", "vertex_indices alone", quoted(header.faceProperties[i].name));
}

Header scanHeader(std::string& bytes, std::string_view where, Lines& lines) {
  Header header;
  if (!lines.next() || lines.line() != "ply") lines.fail("is not a PLY file", "ply", quoted(lines.line()));
  if (!lines.next()) lines.fail("the header ends too early", "a format");
  std::string_view rest = lines.line();
  const std::string_view keyword = takeWord(rest);
  const std::string_view format = takeWord(rest);
  if (keyword != "format") lines.fail("the second line is not the format", "format ... 1.0", quoted(lines.line()));
  if (format == "binary_little_endian") {
    header.encoding = Encoding::kLittle;
  } else if (format == "binary_big_endian") {
    header.encoding = Encoding::kBig;
  } else if (format != "ascii") {
    lines.fail("an unknown PLY format", "ascii, binary_little_endian or binary_big_endian", quoted(format));
  }
  if (takeWord(rest) != "1.0") lines.fail("an unknown PLY version", "1.0", quoted(lines.line()));
  const bool crLf = bytes.find("\r\n") < bytes.find('\n');
  if (header.encoding != Encoding::kAscii && crLf)
    lines.fail("a binary PLY file with CR LF line ends, as a transfer in text mode makes them", "LF line ends");

  enum class Element { kNone, kVertex, kFace, kEmpty } element = Element::kNone;
  bool seenVertex = false, seenFace = false;
  while (lines.next()) {
    rest = lines.line();
    const std::string_view statement = takeWord(rest);
    if (statement == "end_header") {
      header.end = lines.endOffset();
      if (!seenVertex || !seenFace) lines.fail("the header lacks an element", "vertex and face");
      checkHeader(header, lines);
      return header;
    }
    if (statement == "element") {
      const std::string_view name = takeWord(rest);
      const long long count = wholeNumber(takeWord(rest), "a number of elements", lines);
      // Every vertex takes at least 3 bytes of data, every face 1.
      if (count < 0 || count > std::numeric_limits<int>::max() || static_cast<std::size_t>(count) > bytes.size())
        lines.fail("a count that the file cannot hold", fmt::format("at most {}", bytes.size()), fmt::to_string(count));
      if (name == "vertex" && !seenVertex && !seenFace) {
        element = Element::kVertex;
        header.vertices = static_cast<std::size_t>(count);
        seenVertex = true;
      } else if (name == "face" && seenVertex && !seenFace) {
        element = Element::kFace;
        header.faces = static_cast<std::size_t>(count);
        seenFace = true;
      } else if (count == 0 && seenFace) {
        element = Element::kEmpty;
      } else {
        lines.fail("an element that cannot be read", "vertex, then face", quoted(name));
      }
    } else if (statement == "property") {
      if (element == Element::kNone) lines.fail("a property of no element");
      const bool ofFace = element != Element::kVertex;
      Property property = scanProperty(rest, ofFace, lines);
      if (element == Element::kVertex) header.vertexProperties.push_back(property);
      if (element == Element::kFace) header.faceProperties.push_back(property);
      if (element == Element::kEmpty) lines.blank();
    } else if (statement == "comment" || statement == "obj_info") {
      // What a comment says is no business of OpenMesh, which reads on in the line of an obj_info.
      lines.blank(statement.size());
      if (statement == "obj_info") {
        const auto begin = static_cast<std::size_t>(lines.line().data() - bytes.data());
        bytes.replace(begin, statement.size(), "comment ");
      }
    } else {
      lines.fail("an unknown statement", "element, property, comment or end_header", quoted(statement));
    }
    if (element == Element::kEmpty && statement == "element") lines.blank();
  }
  throw Error(where, "the header does not end", "end_header");
}

void scanAscii(const Header& header, Lines& lines, std::string_view where, Polygons& polygons) {
  const auto nextLine = [&](std::string_view what, std::size_t count, std::size_t found) {
    do {
      if (!lines.next()) throw Error(where, "ends too early", fmt::format("{} {}", count, what), fmt::to_string(found));
    } while (lines.line().empty());
    return lines.line();
  };
  for (std::size_t i = 0; i < header.vertices; ++i) {
    std::string_view rest = nextLine("vertices", header.vertices, i);
    glm::dvec3 p(0), n(0);
    for (std::size_t k = 0; k < header.vertexProperties.size(); ++k) {
      const std::string_view word = takeWord(rest);
      if (word.empty()) lines.fail("a vertex lacks numbers", fmt::to_string(header.vertexProperties.size()));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (header.xyz[axis] == k) p[static_cast<int>(axis)] = coordinate(word, lines);
        // What is no number here matters to those alone who take the file's normals.
        if (header.normal && (*header.normal)[axis] == k)
          n[static_cast<int>(axis)] = std::strtod(std::string(word).c_str(), nullptr);
      }
    }
    if (header.normal) polygons.normals.emplace_back(n);
    if (!takeWord(rest).empty())
      lines.fail("a vertex has too many numbers", fmt::to_string(header.vertexProperties.size()));
    polygons.positions.push_back(p);
  }
  for (std::size_t i = 0; i < header.faces; ++i) {
    std::string_view rest = nextLine("faces", header.faces, i);
    const long long corners = wholeNumber(takeWord(rest), "a number of corners", lines);
    if (corners < 3) lines.fail("a face without area", "at least 3 corners", fmt::to_string(corners));
    for (long long c = 0; c < corners; ++c) {
      const long long index = wholeNumber(takeWord(rest), fmt::format("{} corners", corners), lines);
      if (index < 0 || static_cast<unsigned long long>(index) >= header.vertices)
        lines.fail("a face names a vertex that is not there", fmt::format("0 or more and below {}", header.vertices),
                   fmt::to_string(index));
      polygons.corners.push_back(static_cast<std::uint32_t>(index));
    }
    for (std::size_t k = 1; k < header.faceProperties.size(); ++k)
      if (takeWord(rest).empty()) lines.fail("a face lacks numbers", "its properties");
    if (!takeWord(rest).empty()) lines.fail("a face has too many numbers", fmt::format("{} corners", corners));
    polygons.closeFace();
  }
  while (lines.next())
    if (!lines.line().empty()) lines.fail("more than the header counts", "the end of the file", quoted(lines.line()));
}

// Binary values in file order, checked against the end of the file.
class Bytes {
 public:
  Bytes(std::string_view bytes, std::size_t offset, Encoding encoding, std::string_view where)
      : bytes_(bytes),
        offset_(offset),
        swap_((std::endian::native == std::endian::little) != (encoding == Encoding::kLittle)),
        where_(where) {}

  void skip(std::size_t count) {
    need(count);
    offset_ += count;
  }

  double real(const Type& type) {
    const std::uint64_t bits = raw(type.bytes);
    return type.bytes == 8 ? std::bit_cast<double>(bits)
                           : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }

  std::int64_t whole(const Type& type) {
    const std::uint64_t bits = raw(type.bytes);
    const auto shift = static_cast<unsigned>(64 - 8 * type.bytes);
    if (type.kind == Type::Kind::kSigned) return static_cast<std::int64_t>(bits << shift) >> shift;
    return static_cast<std::int64_t>(bits);
  }

  std::size_t remaining() const { return bytes_.size() - offset_; }
  [[noreturn]] void fail(std::string_view problem, std::string_view expected, std::string_view found) const {
    throw Error(fmt::format("{}, byte {}", where_, offset_), problem, expected, found);
  }

 private:
  void need(std::size_t count) const {
    if (count > remaining()) fail("ends too early", fmt::format("{} more bytes", count), fmt::to_string(remaining()));
  }

  // Up to 8 bytes in the machine's order.
  std::uint64_t raw(std::size_t count) {
    need(count);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = swap_ ? i : count - 1 - i;  // most significant first
      value = value << 8u | static_cast<unsigned char>(bytes_[offset_ + from]);
    }
    offset_ += count;
    return value;
  }

  std::string_view bytes_;
  std::size_t offset_;
  bool swap_;
  std::string_view where_;
};

void scanBinary(const Header& header, std::string_view bytes, std::string_view where, Polygons& polygons) {
  Bytes data(bytes, header.end, header.encoding, where);
  for (std::size_t i = 0; i < header.vertices; ++i) {
    glm::dvec3 p(0), n(0);
    for (std::size_t k = 0; k < header.vertexProperties.size(); ++k) {
      const Type& type = header.vertexProperties[k].type;
      glm::dvec3* target = nullptr;
      int axis = 0;
      for (int a = 0; a < 3; ++a) {
        const auto at = static_cast<std::size_t>(a);
        if (header.xyz[at] == k) target = &p, axis = a;
        if (header.normal && (*header.normal)[at] == k) target = &n, axis = a;
      }
      if (!target) {
        data.skip(type.bytes);
        continue;
      }
      const double value = data.real(type);
      if (target == &p && !(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
        data.fail(fmt::format("a bad number in vertex {}", i), "a finite number that a float holds",
                  fmt::to_string(value));
      (*target)[axis] = value;
    }
    if (header.normal) polygons.normals.emplace_back(n);
    polygons.positions.push_back(p);
  }
  const Property& list = header.faceProperties.front();
  for (std::size_t i = 0; i < header.faces; ++i) {
    const std::int64_t corners = data.whole(*list.countType);
    if (corners < 3 || static_cast<std::uint64_t>(corners) > data.remaining())
      data.fail(fmt::format("face {} has a bad number of corners", i), "3 or more, as the file holds",
                fmt::to_string(corners));
    for (std::int64_t c = 0; c < corners; ++c) {
      const std::int64_t index = data.whole(list.type);
      if (index < 0 || static_cast<std::uint64_t>(index) >= header.vertices)
        data.fail(fmt::format("face {} names a vertex that is not there", i),
                  fmt::format("0 or more and below {}", header.vertices), fmt::to_string(index));
      polygons.corners.push_back(static_cast<std::uint32_t>(index));
    }
    for (std::size_t k = 1; k < header.faceProperties.size(); ++k) data.skip(header.faceProperties[k].type.bytes);
    polygons.closeFace();
  }
  if (data.remaining() != 0)
    data.fail("more than the header counts", "the end of the file", fmt::format("{} bytes", data.remaining()));
}

}  // namespace

Polygons scanPly(std::string& bytes, std::string_view where) {
  Lines lines(bytes, where);
  const Header header = scanHeader(bytes, where, lines);
  Polygons polygons;
  if (header.encoding == Encoding::kAscii) {
    scanAscii(header, lines, where, polygons);
  } else {
    scanBinary(header, bytes, where, polygons);
  }
  return polygons;
}

}  // namespace malus::prep

// Polygon File Format: ASCII and binary with either byte order, all numeric types, elements in any order. Vertices,
// normals of vertices, faces and triangle strips are read; other properties, lists and elements, faces of fewer
// than three corners, and padding are ignored with a note. CR line ends, and CR LF in the header of a binary file, are
// accepted with a note.
// Source: G. Turk, "The PLY Polygon File Format", Stanford University, 1994; triangle strips as in files of the
// Stanford 3D Scanning Repository: -1 ends a strip.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "meshprep/read/ply_header.h"
#include "meshprep/read/ply_source.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

using ply::Element;
using ply::Kind;
using ply::Property;
using ply::Role;

class PlyScan {
 public:
  PlyScan(const ply::Header& header, ply::Source& source, bool strict)
      : header_(header), source_(source), invalid_(strict) {
    polygons_.locationsAreBytes = source.locationsAreBytes();
  }

  Scan run(std::string_view where) {
    for (const Element& element : header_.elements) scanElement(element);
    source_.endFile();
    if (source_.hasPadding()) noteOnce(polygons_, kPaddingNote);
    if (header_.hasCrLineEnds || source_.hasCrLineEnds()) noteAccepted(polygons_, "CR line ends");
    if (header_.hasCrLfLineEnds && source_.locationsAreBytes())
      noteAccepted(polygons_, "CR LF line ends in the header of a binary file");
    Scan scan;
    scan.polygons = std::move(polygons_);
    leaveOutInvalid(scan, invalid_, where);
    return scan;
  }

 private:
  void scanElement(const Element& element);
  void scanVertex(const Element& element);
  void scanFace(const Property& list);
  void scanStrip(const Property& list);
  void addStripTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  std::size_t listLength(const Property& list);
  double coordinate(ply::Type type);
  std::uint32_t corner(std::int64_t index);
  void skip(const Property& property);
  void noteSkipped(const Element& element);

  const ply::Header& header_;
  ply::Source& source_;
  InvalidParts invalid_;
  bool isValid_ = true;  // false: a coordinate of the current vertex is not
  Polygons polygons_;
};

void PlyScan::scanElement(const Element& element) {
  // Reserve memory for the counts of the header, which are bounded by the file size.
  constexpr std::array<std::string_view, 4> kNames = {"vertex", "face", "strip", "element"};
  if (element.kind == Kind::kVertices) {
    polygons_.positions.reserve(element.count);
    polygons_.vertexLocations.reserve(element.count);
    if (header_.hasNormals) polygons_.normals.reserve(element.count);
  } else if (element.kind == Kind::kFaces) {
    polygons_.faceLocations.reserve(element.count);
    polygons_.firstCorner.reserve(element.count + 1);
  }
  if (element.count > 0) noteSkipped(element);

  // Read items by properties.
  for (std::size_t i = 0; i < element.count; ++i) {
    source_.beginItem(kNames[static_cast<std::size_t>(element.kind)], i);
    if (element.kind == Kind::kVertices) {
      scanVertex(element);
    } else {
      for (const Property& property : element.properties) {
        const bool corners = property.role == Role::kCorners;
        if (corners && element.kind == Kind::kFaces) {
          scanFace(property);
        } else if (corners && element.kind == Kind::kStrips) {
          scanStrip(property);
        } else {
          skip(property);
        }
      }
    }
    source_.endItem();
  }
}

void PlyScan::scanVertex(const Element& element) {
  glm::dvec3 p(0), n(0);
  isValid_ = true;
  for (const Property& property : element.properties) {
    if (property.role >= Role::kX && property.role <= Role::kZ) {
      p[static_cast<int>(property.role) - static_cast<int>(Role::kX)] = coordinate(property.type);
    } else if (property.role >= Role::kNormalX && property.role <= Role::kNormalZ) {
      n[static_cast<int>(property.role) - static_cast<int>(Role::kNormalX)] = source_.real(property.type);
    } else {
      skip(property);
    }
  }
  polygons_.positions.push_back(isValid_ ? p : kInvalidPosition);
  polygons_.vertexLocations.push_back(source_.location());
  if (!header_.hasNormals) return;
  constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max());
  const bool finite = std::abs(n.x) <= kLargest && std::abs(n.y) <= kLargest && std::abs(n.z) <= kLargest;
  if (!finite) noteOnce(polygons_, "normals that are not finite");
  polygons_.normals.push_back(finite ? glm::vec3(n) : glm::vec3(0));
}

void PlyScan::scanFace(const Property& list) {
  const std::size_t corners = listLength(list);
  if (corners < 3) noteOnce(polygons_, kFewCorners);
  for (std::size_t c = 0; c < corners; ++c) polygons_.corners.push_back(corner(source_.whole(list.type)));
  polygons_.closeFace();
  polygons_.faceLocations.push_back(source_.location());
}

// Each corner after the second makes a triangle with the two before it; every second one is flipped for a consistent
// orientation. Triangles with a repeated corner connect strips and are not faces.
void PlyScan::scanStrip(const Property& list) {
  const std::size_t length = listLength(list);
  std::uint32_t a = 0, b = 0;
  std::size_t known = 0;  // corners of the current strip
  for (std::size_t i = 0; i < length; ++i) {
    const std::int64_t index = source_.whole(list.type);
    if (index == -1) {
      known = 0;
      continue;
    }
    const std::uint32_t c = corner(index);
    if (known >= 2) known % 2 == 0 ? addStripTriangle(a, b, c) : addStripTriangle(b, a, c);
    ++known;
    a = b;
    b = c;
  }
}

void PlyScan::addStripTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a == b || b == c || c == a) return;
  polygons_.corners.insert(polygons_.corners.end(), {a, b, c});
  polygons_.closeFace();
  polygons_.faceLocations.push_back(source_.location());
}

std::size_t PlyScan::listLength(const Property& list) {
  const std::int64_t length = source_.whole(*list.countType);
  if (length < 0) source_.fail("invalid list length", "0 or more", fmt::to_string(length));
  return static_cast<std::size_t>(length);
}

// Returns a coordinate of the current vertex. The end of the file is an error.
double PlyScan::coordinate(ply::Type type) {
  constexpr auto kLargest = static_cast<double>(std::numeric_limits<float>::max());
  double value = 0;
  if (source_.locationsAreBytes()) value = source_.real(type);
  try {
    if (!source_.locationsAreBytes()) value = source_.coordinate(type);
    if (!(std::abs(value) <= kLargest))
      source_.fail(fmt::format("invalid number in vertex {}", polygons_.positions.size()),
                   "a finite number within the range of float", fmt::to_string(value));
  } catch (const Error& error) {
    if (isValid_) invalid_.add("vertices", error);
    isValid_ = false;
  }
  return value;
}

// Returns the index, or kInvalidCorner.
std::uint32_t PlyScan::corner(std::int64_t index) {
  if (index >= 0 && static_cast<std::uint64_t>(index) < header_.vertices) return static_cast<std::uint32_t>(index);
  try {
    source_.fail("invalid vertex index", fmt::format("an index of 0 or more and below {}", header_.vertices),
                 fmt::to_string(index));
  } catch (const Error& error) {
    invalid_.add("vertex indices", error);
  }
  return kInvalidCorner;
}

void PlyScan::skip(const Property& property) {
  source_.skip(property.type, property.countType ? listLength(property) : 1);
}

void PlyScan::noteSkipped(const Element& element) {
  if (element.kind == Kind::kOther) {
    noteOnce(polygons_, "elements other than vertices, faces and triangle strips");
    return;
  }
  const std::string_view owner = element.kind == Kind::kVertices ? "vertices" : "faces";
  for (const Property& property : element.properties) {
    if (property.role > Role::kColour) continue;
    const std::string_view what = property.role == Role::kColour ? "colours"
                                  : property.countType           ? "lists"
                                                                 : "other properties";
    noteOnce(polygons_, fmt::format("{} of {}", what, owner));
  }
}

}  // namespace

Scan scanPly(std::string& bytes, std::string_view where, bool strict) {
  // Text may be padded too.
  constexpr std::string_view kText = "format ascii";
  const bool padded = bytes.find(kText) < bytes.find("end_header") && removePadding(bytes);
  const ply::Header header = ply::scanHeader(bytes, where);
  const std::unique_ptr<ply::Source> source = ply::openSource(bytes, where, header);
  Scan scan = PlyScan(header, *source, strict).run(where);
  if (padded) noteOnce(scan.polygons, kPaddingNote);
  scan.openMeshReads = scan.openMeshReads && header.openMeshReads;
  return scan;
}

}  // namespace malus::prep

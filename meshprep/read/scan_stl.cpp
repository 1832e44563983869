// Stereolithography, ASCII and binary (little-endian). Normals of facets are not read. Attributes, which some programs
// use for colours, and padding after the last facet are ignored with a note. Each solid of an ASCII file with faces is
// a part. Source: 3D Systems, "StereoLithography Interface Specification", 1989.
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of text, 4 of count
constexpr std::size_t kFaceBytes = 50;    // normal, three corners, attribute
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kCornersBytes = 36;

std::uint32_t littleEndian(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8u | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

bool equalsIgnoringCase(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(word[i])) != lower[i]) return false;
  return true;
}

Scan scanBinary(std::string_view bytes, std::string_view where, std::size_t faces, bool strict) {
  Scan scan;
  InvalidParts invalid(strict);
  scan.isBinary = true;
  Polygons& polygons = scan.polygons;
  polygons.locationsAreBytes = true;
  polygons.positions.reserve(3 * faces);
  polygons.corners.reserve(3 * faces);
  polygons.vertexLocations.reserve(3 * faces);
  polygons.firstCorner.reserve(faces + 1);
  polygons.faceLocations.reserve(faces);
  bool coloured = false;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t begin = kHeaderBytes + f * kFaceBytes;
    polygons.faceLocations.push_back(begin);
    std::size_t offset = begin + kNormalBytes;
    for (int corner = 0; corner < 3; ++corner) {
      polygons.vertexLocations.push_back(offset);
      glm::dvec3 p(0);
      for (int axis = 0; axis < 3; ++axis, offset += 4) {
        p[axis] = static_cast<double>(std::bit_cast<float>(littleEndian(bytes, offset)));
        if (!std::isfinite(p[axis]))
          invalid.add("numbers",
                      Error(fmt::format("{}, byte {}", where, offset), fmt::format("invalid number in face {}", f),
                            "a finite number", fmt::to_string(p[axis])));
      }
      if (!std::isfinite(p.x + p.y + p.z)) p = kInvalidPosition;
      polygons.corners.push_back(static_cast<std::uint32_t>(polygons.positions.size()));
      polygons.positions.push_back(p);
    }
    polygons.closeFace();
    const std::size_t attribute = begin + kNormalBytes + kCornersBytes;
    coloured = coloured || bytes[attribute] != 0 || bytes[attribute + 1] != 0;
  }
  if (coloured) noteOnce(polygons, "colours of faces");
  leaveOutInvalid(scan, invalid, where);
  return scan;
}

// Requires these words at the beginning of the line. Returns the rest of it.
std::string_view expectWords(std::string_view expected, const Lines& at) {
  std::string_view rest = at.line();
  std::string_view words = expected;
  for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words))
    if (!equalsIgnoringCase(takeWord(rest), word)) at.fail("invalid STL statement", expected, quoted(at.line()));
  return rest;
}

Scan scanAscii(std::string& bytes, std::string_view where, bool strict) {
  Scan scan;
  InvalidParts invalid(strict);
  Polygons& polygons = scan.polygons;
  Lines lines(bytes, where);
  const auto nextLine = [&](std::string_view expected) {
    do {
      if (!lines.next()) throw Error(where, "unexpected end of file", expected);
    } while (lines.line().empty());
  };
  constexpr std::string_view kSolid = "solid";
  bool inSolid = false;
  std::string name;
  bool newPart = false;  // the next face begins a part
  while (lines.next()) {
    if (lines.line().empty()) continue;
    std::string_view rest = lines.line();
    const std::string_view keyword = takeWord(rest);

    // Blank names: they may contain words that OpenMesh reads as statements.
    if (!inSolid) {
      name = parseName(expectWords(kSolid, lines), lines);
      newPart = true;
      lines.blank(kSolid.size());
      inSolid = true;
    } else if (equalsIgnoringCase(keyword, "endsolid")) {
      lines.blank(keyword.size());
      inSolid = false;
    } else {
      expectWords("facet normal", lines);
      if (newPart) polygons.parts.push_back({name, {}});
      newPart = false;
      polygons.partOf.push_back(static_cast<std::uint32_t>(polygons.parts.size() - 1));
      polygons.faceLocations.push_back(lines.number());
      nextLine("outer loop");
      expectWords("outer loop", lines);
      for (int corner = 0; corner < 3; ++corner) {
        // OpenMesh requires the corners in the next three lines.
        const std::size_t expectedNumber = lines.nextNumber();
        nextLine("three corners");
        if (lines.number() != expectedNumber) scan.openMeshReads = false;
        rest = expectWords("vertex", lines);
        glm::dvec3 p(0);
        try {
          for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(takeWord(rest), lines);
          if (!takeWord(rest).empty()) lines.fail("too many numbers in a corner", "x y z");
        } catch (const Error& error) {
          p = kInvalidPosition;
          invalid.add("vertices", error);
        }
        polygons.corners.push_back(static_cast<std::uint32_t>(polygons.positions.size()));
        polygons.positions.push_back(p);
        polygons.vertexLocations.push_back(lines.number());
      }
      polygons.closeFace();
      nextLine("endloop");
      expectWords("endloop", lines);
      nextLine("endfacet");
      expectWords("endfacet", lines);
    }
  }
  if (inSolid) throw Error(where, "unexpected end of file", "endsolid");
  noteLines(polygons, lines);
  leaveOutInvalid(scan, invalid, where);

  // Drop the list of parts if it is one unnamed part.
  if (polygons.parts == std::vector<Part>{Part{}}) {
    polygons.parts.clear();
    polygons.partOf.clear();
  }
  return scan;
}

// Refuses a binary file whose size does not fit its number of facets.
[[noreturn]] void failSize(std::string_view bytes, std::string_view where) {
  const std::size_t faces = littleEndian(bytes, 80), body = bytes.size() - kHeaderBytes;
  if (body % kFaceBytes == 0)
    throw Error(
        fmt::format("{}, byte 80", where), "wrong number of facets in a binary STL file",
        fmt::format("{}, for which the file has bytes (84, and 50 per facet); correct the number, or export the "
                    "mesh again",
                    body / kFaceBytes),
        fmt::to_string(faces));
  throw Error(
      where, "wrong size of a binary STL file",
      fmt::format("{} bytes (84, and 50 for each of the {} facets that byte 80 states); copy or export the file "
                  "again",
                  kHeaderBytes + faces * kFaceBytes, faces),
      fmt::format("{} bytes", bytes.size()));
}

}  // namespace

Scan scanStl(std::string& bytes, std::string_view where, bool strict) {
  // Decide by size, because binary files may begin with "solid" too.
  if (bytes.size() >= kHeaderBytes) {
    const std::size_t faces = littleEndian(bytes, 80), size = kHeaderBytes + faces * kFaceBytes;
    if (size <= bytes.size() && isPadding(std::string_view(bytes).substr(size))) {
      const bool padded = size < bytes.size();
      bytes.resize(size);
      Scan scan = scanBinary(bytes, where, faces, strict);
      if (padded) noteOnce(scan.polygons, kPaddingNote);
      return scan;
    }
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && equalsIgnoringCase(std::string_view(bytes).substr(first, 5), "solid")) {
    const std::string whole = bytes;
    const bool padded = removePadding(bytes);
    if (whole.size() >= kHeaderBytes && bytes.find('\0') != std::string::npos) failSize(whole, where);
    Scan scan = scanAscii(bytes, where, strict);
    if (padded) noteOnce(scan.polygons, kPaddingNote);
    return scan;
  }
  if (bytes.size() < kHeaderBytes)
    throw Error(where, "is not an STL file", "\"solid\", or at least 84 bytes", fmt::format("{} bytes", bytes.size()));
  failSize(bytes, where);
}

}  // namespace malus::prep

// Object File Format, ASCII, three dimensions: [ST][C][N]OFF, one vertex or face per line, comments anywhere. Normals
// are read; colours and texture coordinates are ignored with a note. Binary files are errors. Source: Geomview manual,
// "OFF: the format of polygon files", http://www.geomview.org/docs/html/OFF.html.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

// Parses a count, and requires at least `bytesEach` bytes of the file per element.
std::size_t scanCount(std::string_view& rest, std::string_view what, std::size_t fileBytes, std::size_t bytesEach,
                      const Lines& at) {
  const long long count = wholeNumber(takeWord(rest), what, at);
  const std::size_t most = std::min<std::size_t>(fileBytes / bytesEach, std::numeric_limits<int>::max());
  if (count < 0 || static_cast<unsigned long long>(count) > most)
    at.fail("count exceeds the file size", fmt::format("{}, at most {}", what, most), fmt::to_string(count));
  return static_cast<std::size_t>(count);
}

// Numbers after x y z, by the letters before OFF.
struct Header {
  std::size_t length = 0;  // in characters
  bool textured = false, coloured = false, normals = false;
};

Header scanHeader(const Lines& at) {
  std::string_view prefix = at.line().substr(0, at.line().find_first_of(" \t"));
  Header header;
  header.length = prefix.size();
  const auto take = [&](std::string_view letters) {
    const bool there = prefix.starts_with(letters);
    if (there) prefix.remove_prefix(letters.size());
    return there;
  };
  header.textured = take("ST");
  header.coloured = take("C");
  header.normals = take("N");
  if (prefix.starts_with("4") || prefix.starts_with("n"))
    at.fail("unsupported dimension of an OFF file", "three dimensions", quoted(at.line()));
  if (prefix != "OFF") at.fail("is not an OFF file", "OFF, COFF, NOFF or STOFF", quoted(at.line()));
  return header;
}

// Blanks the line from the beginning of `rest`, so that OpenMesh finds numbers only.
void blankFrom(std::string_view rest, Lines& lines) {
  lines.blank(static_cast<std::size_t>(rest.data() - lines.line().data()));
}

}  // namespace

Scan scanOff(std::string& bytes, std::string_view where) {
  Lines lines(bytes, where);
  const auto nextLine = [&](std::string_view what) {
    if (!lines.nextStatement('#')) throw Error(where, "unexpected end of file", what);
    std::string_view rest = lines.line();
    const std::size_t comment = rest.find('#');
    return rest.substr(0, comment);
  };

  // Parse the header, which may have the counts on the same line. Reduce it to a line "OFF".
  nextLine("OFF");
  const Header header = scanHeader(lines);
  const std::size_t length = header.length;
  std::string_view rest = lines.line().substr(length);
  rest = rest.substr(0, rest.find('#'));
  std::string_view peek = rest;
  const std::string_view after = takeWord(peek);
  if (after == "BINARY") lines.fail("binary OFF files are not supported", "ASCII", quoted(lines.line()));
  const auto headerBegin = static_cast<std::size_t>(lines.line().data() - bytes.data());
  bytes.replace(headerBegin, length, std::string("OFF") + std::string(length - 3, ' '));
  if (after.empty()) {
    rest = nextLine("three counts");
  } else {
    rest.remove_prefix(1);
    bytes[headerBegin + length] = '\n';
  }

  // Parse the numbers of vertices, faces and edges. The last is not used.
  const std::size_t vertices = scanCount(rest, "a number of vertices", bytes.size(), 6, lines);
  const std::size_t faces = scanCount(rest, "a number of faces", bytes.size(), 8, lines);
  wholeNumber(takeWord(rest), "a number of edges", lines);
  if (!takeWord(rest).empty()) lines.fail("too many counts", "numbers of vertices, faces and edges");
  blankFrom(rest, lines);

  // Parse the vertices, one per line.
  Scan scan;
  Polygons& polygons = scan.polygons;
  polygons.positions.reserve(vertices);
  polygons.vertexLocations.reserve(vertices);
  if (header.normals) polygons.normals.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    rest = nextLine(fmt::format("{} vertices, of which {} were read", vertices, i));
    glm::dvec3 p(0);
    for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(takeWord(rest), lines);
    polygons.positions.push_back(p);
    polygons.vertexLocations.push_back(lines.number());
    std::string_view more = rest;
    if (header.normals) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(takeWord(more), lines);
      polygons.normals.emplace_back(p);
    }
    if (!takeWord(more).empty())
      noteOnce(polygons, header.textured && !header.coloured ? "texture coordinates" : "colours of vertices");
    if (header.textured && header.coloured) noteOnce(polygons, "texture coordinates");
    blankFrom(rest, lines);
  }

  // Parse the faces, one per line: number of corners, corners, optional colour.
  polygons.faceLocations.reserve(faces);
  for (std::size_t i = 0; i < faces; ++i) {
    rest = nextLine(fmt::format("{} faces, of which {} were read", faces, i));
    const long long corners = wholeNumber(takeWord(rest), "a number of corners", lines);
    if (corners < 3) lines.fail("too few corners in a face", "3 or more", fmt::to_string(corners));
    for (long long c = 0; c < corners; ++c) {
      const std::string_view word = takeWord(rest);
      if (word.empty()) lines.fail("missing corners in a face", fmt::format("{} corners", corners), fmt::to_string(c));
      const long long index = wholeNumber(word, "an integer", lines);
      if (index < 0 || static_cast<unsigned long long>(index) >= vertices)
        lines.fail("invalid vertex index", fmt::format("0 to {}", vertices - 1), fmt::to_string(index));
      polygons.corners.push_back(static_cast<std::uint32_t>(index));
    }
    polygons.closeFace();
    polygons.faceLocations.push_back(lines.number());
    std::string_view more = rest;
    if (!takeWord(more).empty()) noteOnce(polygons, "colours of faces");
    blankFrom(rest, lines);
  }
  if (lines.nextStatement('#'))
    lines.fail("content after the elements of the header", "the end of the file", quoted(lines.line()));

  // OpenMesh expects the header in the first line.
  bytes.erase(0, headerBegin);
  return scan;
}

}  // namespace malus::prep

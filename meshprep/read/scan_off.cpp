// Object File Format, ASCII, three dimensions: [ST][C][N]OFF, one vertex or face per line, comments anywhere. Normals
// are read; colours, texture coordinates and faces of fewer than three corners are ignored with a note, and a missing
// number of edges is accepted with a note. Binary files are errors. Source: Geomview manual,
// "OFF: the format of polygon files", http://www.geomview.org/docs/html/OFF.html.
#include <algorithm>
#include <limits>
#include <utility>

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
  if ((prefix.starts_with("4") || prefix.starts_with("n")) && prefix.ends_with("OFF"))
    at.fail("unsupported dimension of an OFF file", "three dimensions", quoted(at.line()));
  if (prefix != "OFF")
    at.fail("no header word of an OFF file", "OFF, COFF, NOFF or STOFF in the first line; insert a line OFF",
            quoted(at.line()));
  return header;
}

// Blanks the line from the beginning of `rest`, so that OpenMesh finds numbers only.
void blankFrom(std::string_view rest, Lines& lines) {
  lines.blank(static_cast<std::size_t>(rest.data() - lines.line().data()));
}

// Reads a file from its header to its last face.
class OffScanner {
 public:
  OffScanner(std::string& bytes, std::string_view where, bool strict)
      : bytes_(bytes), where_(where), lines_(bytes, where), invalid_(strict) {}

  Scan scan() {
    scanFirstLine();
    scanCounts();
    for (std::size_t i = 0; i < vertices_; ++i) scanVertex(i);
    for (std::size_t i = 0; i < faces_; ++i) scanFace(i);
    if (lines_.nextStatement('#'))
      lines_.fail("content after the elements of the header", "the end of the file", quoted(lines_.line()));
    noteLines(scan_.polygons, lines_);
    leaveOutInvalid(scan_, invalid_, where_);
    bytes_.erase(0, headerBegin_);  // OpenMesh expects the header in the first line
    return std::move(scan_);
  }

 private:
  // The next line without its comment.
  std::string_view nextLine(std::string_view what) {
    if (!lines_.nextStatement('#')) throw Error(where_, "unexpected end of file", what);
    return withoutComment(lines_.line());
  }
  static std::string_view withoutComment(std::string_view line) { return line.substr(0, line.find('#')); }

  // Parses the header, which may have the counts on the same line. Reduces it to a line "OFF".
  void scanFirstLine() {
    nextLine("OFF");
    header_ = scanHeader(lines_);
    const std::size_t length = header_.length;
    rest_ = withoutComment(lines_.line().substr(length));
    std::string_view peek = rest_;
    const std::string_view after = takeWord(peek);
    if (after == "BINARY") lines_.fail("binary OFF files are not supported", "ASCII", quoted(lines_.line()));
    headerBegin_ = static_cast<std::size_t>(lines_.line().data() - bytes_.data());
    bytes_.replace(headerBegin_, length, std::string("OFF") + std::string(length - 3, ' '));
    if (after.empty()) {
      rest_ = nextLine("three counts");
    } else {
      rest_.remove_prefix(1);
      bytes_[headerBegin_ + length] = '\n';
    }
  }

  // Parses the numbers of vertices, faces and edges. The last is not used.
  void scanCounts() {
    vertices_ = scanCount(rest_, "a number of vertices", bytes_.size(), 6, lines_);
    faces_ = scanCount(rest_, "a number of faces", bytes_.size(), 8, lines_);
    if (const std::string_view edges = takeWord(rest_); edges.empty()) {
      noteAccepted(scan_.polygons, "a missing number of edges");
      scan_.openMeshReads = false;
    } else {
      wholeNumber(edges, "a number of edges", lines_);
    }
    if (!takeWord(rest_).empty()) lines_.fail("too many counts", "numbers of vertices, faces and edges");
    blankFrom(rest_, lines_);

    Polygons& polygons = scan_.polygons;
    polygons.positions.reserve(vertices_);
    polygons.vertexLocations.reserve(vertices_);
    if (header_.normals) polygons.normals.reserve(vertices_);
    polygons.faceLocations.reserve(faces_);
  }

  glm::dvec3 scanVector(std::string_view& rest) {
    glm::dvec3 v(0);
    for (int axis = 0; axis < 3; ++axis) v[axis] = coordinate(takeWord(rest), lines_);
    return v;
  }

  // Parses a line with a vertex.
  void scanVertex(std::size_t i) {
    Polygons& polygons = scan_.polygons;
    std::string_view rest = nextLine(fmt::format("{} vertices, of which {} were read", vertices_, i));
    polygons.positions.push_back(kInvalidPosition);
    polygons.vertexLocations.push_back(lines_.number());
    if (header_.normals) polygons.normals.emplace_back(0);
    std::string_view more = rest;
    try {
      const glm::dvec3 position = scanVector(rest);
      more = rest;
      if (header_.normals) polygons.normals.back() = glm::vec3(scanVector(more));
      polygons.positions.back() = position;
    } catch (const Error& error) {
      return invalid_.add("vertices", error);
    }
    if (!takeWord(more).empty())
      noteOnce(polygons, header_.textured && !header_.coloured ? "texture coordinates" : "colours of vertices");
    if (header_.textured && header_.coloured) noteOnce(polygons, "texture coordinates");
    blankFrom(rest, lines_);
  }

  void scanFace(std::size_t i) {
    const std::string_view rest = nextLine(fmt::format("{} faces, of which {} were read", faces_, i));
    const std::size_t first = scan_.polygons.corners.size();
    try {
      parseFace(rest);
    } catch (const Error& error) {
      scan_.polygons.corners.resize(first);
      invalid_.add("faces", error);
    }
  }

  // Parses a line with a face: number of corners, corners, optional colour.
  void parseFace(std::string_view rest) {
    Polygons& polygons = scan_.polygons;
    const long long corners = wholeNumber(takeWord(rest), "a number of corners", lines_);
    if (corners < 0) lines_.fail("invalid number of corners", "0 or more", fmt::to_string(corners));
    if (corners < 3) noteOnce(polygons, kFewCorners);
    for (long long c = 0; c < corners; ++c) {
      const std::string_view word = takeWord(rest);
      if (word.empty()) lines_.fail("missing corners in a face", fmt::format("{} corners", corners), fmt::to_string(c));
      const long long index = wholeNumber(word, "an integer", lines_);
      if (index < 0 || static_cast<unsigned long long>(index) >= vertices_)
        lines_.fail("invalid vertex index", fmt::format("0 to {}", vertices_ - 1), fmt::to_string(index));
      polygons.corners.push_back(static_cast<std::uint32_t>(index));
    }
    polygons.closeFace();
    polygons.faceLocations.push_back(lines_.number());
    std::string_view more = rest;
    if (!takeWord(more).empty()) noteOnce(polygons, "colours of faces");
    blankFrom(rest, lines_);
  }

  std::string& bytes_;
  std::string_view where_;
  Lines lines_;
  InvalidParts invalid_;
  Header header_;
  std::size_t headerBegin_ = 0, vertices_ = 0, faces_ = 0;
  std::string_view rest_;  // of the line with the counts
  Scan scan_;
};

}  // namespace

Scan scanOff(std::string& bytes, std::string_view where, bool strict) {
  const bool padded = removePadding(bytes);
  Scan scan = OffScanner(bytes, where, strict).scan();
  if (padded) noteOnce(scan.polygons, kPaddingNote);
  return scan;
}

}  // namespace malus::prep

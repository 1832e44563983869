// Wavefront OBJ: positions, faces, corner normals, groups, objects, names of materials and smoothing groups. Texture
// coordinates, colours, points, lines and faces of fewer than three corners are ignored with a note. Comments after a
// statement and empty slots of corners ("1/", "1//") are accepted with a note; in a statement with names, blanks must
// enclose the '#' of a comment. Invalid vertices, normals, faces and smoothing groups, and unknown statements
// (free-form surfaces, statements that include a file) are left out; a vertex keeps its number. A backslash does not
// continue a comment. Source: Wavefront Technologies, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1.
#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/part_list.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

constexpr long long kMaxIndex =
    std::numeric_limits<int>::max();  // limit of OpenMesh's handles, with which the tests compare
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Statements without effect on the surface, and the note about them.
struct Skipped {
  std::string_view keyword, note;
};
constexpr std::array<Skipped, 13> kSkipped = {{{"l", "lines"},
                                               {"p", "points"},
                                               {"vp", "points in a parameter space"},
                                               {"vc", "colours of vertices"},
                                               {"mg", "merging groups"},
                                               {"lod", "display attributes"},
                                               {"usemap", "texture maps"},
                                               {"maplib", "texture maps"},
                                               {"bevel", "display attributes"},
                                               {"c_interp", "display attributes"},
                                               {"d_interp", "display attributes"},
                                               {"shadow_obj", "objects for shadows and reflections"},
                                               {"trace_obj", "objects for shadows and reflections"}}};

// Statements with names, which may contain '#'.
constexpr std::array<std::string_view, 6> kNamed = {"g", "o", "usemtl", "mtllib", "usemap", "maplib"};

// Numbers of positions, texture coordinates and normals so far.
using Counts = std::array<long long, 3>;
constexpr std::array<std::string_view, 3> kKinds = {"vertex", "texture coordinate", "normal"};

class ObjScan {
 public:
  ObjScan(std::string& bytes, std::string_view where, bool strict)
      : lines_(bytes, where), where_(where), strict_(strict), invalid_(strict) {}

  Scan run() {
    while (lines_.nextStatement('#')) {
      joinStatement();
      std::string_view rest = lines_.line();
      const std::string_view keyword = takeWord(rest);
      if (keyword == "v") {
        scanVertex(rest);
      } else if (keyword == "f") {
        scanFace(rest);
      } else {
        scanOther(keyword, rest);
        lines_.blank();
      }
    }
    finish();
    Scan scan;
    scan.polygons = std::move(polygons_);
    leaveOutInvalid(scan, invalid_, where_);
    return scan;
  }

 private:
  void joinStatement();
  void scanVertex(std::string_view rest);
  glm::dvec3 parsePosition(std::string_view rest);
  void scanFace(std::string_view rest);
  void scanCorner(std::string_view word);
  void acceptEmptySlots(std::string_view corner);
  long long resolve(std::string_view word, std::size_t kind) const;
  void scanNormal(std::string_view rest);
  void scanTextureCoordinate(std::string_view rest);
  void resolveTextureCoordinates();
  void scanSmoothing(std::string_view rest);
  void scanMaterialFiles(std::string_view rest);
  void scanOther(std::string_view keyword, std::string_view rest);
  void finish();

  Lines lines_;
  std::string_view where_;
  bool strict_;
  InvalidParts invalid_;
  Polygons polygons_;
  PartList parts_;

  Counts counts_{};
  Counts highest_ = {-1, -1, -1};           // highest index of each kind in a corner
  std::array<std::size_t, 3> highestAt_{};  // and its line

  std::vector<glm::vec3> normals_;
  std::vector<std::uint32_t> normalOf_;  // one per corner; empty until a corner has one
  std::vector<glm::vec2> coordinates_;
  std::vector<std::uint32_t> coordinateOf_;  // as normalOf_
  bool smoothing_ = false;                   // an `s` statement has been read
  std::uint32_t smoothingGroup_ = 0;
  std::unordered_set<std::string> materialFiles_;
};

// Joins the lines of a statement and removes its comments.
void ObjScan::joinStatement() {
  std::string_view peek = lines_.line();
  const std::string_view keyword = takeWord(peek);
  if (std::find(kNamed.begin(), kNamed.end(), keyword) == kNamed.end()) return lines_.joinContinued('#');
  lines_.cutSeparateComment('#');
  lines_.joinContinued();
  lines_.cutSeparateComment('#');
}

void ObjScan::scanVertex(std::string_view rest) {
  glm::dvec3 position(0);
  try {
    position = parsePosition(rest);
  } catch (const Error& error) {
    position = kInvalidPosition;  // here: GCC 12 assigns the result of a call that throws
    invalid_.add("vertices", error);
  }
  polygons_.positions.push_back(position);
  polygons_.vertexLocations.push_back(lines_.number());
  ++counts_[0];
}

glm::dvec3 ObjScan::parsePosition(std::string_view rest) {
  std::array<double, 7> numbers{};  // x y z, or with a colour: x y z r g b, x y z r g b a, x y z weight r g b
  std::size_t count = 0;
  const char* afterPosition = nullptr;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    if (count == numbers.size())
      lines_.fail("too many numbers in a vertex", "x y z, optionally a weight of 1 and a colour");
    numbers[count++] = coordinate(word, lines_);
    if (count == 3) afterPosition = rest.data();
  }
  if (count < 3 || count == 5)
    lines_.fail("wrong number of numbers in a vertex", "3 (x y z), 4 (weight) or 6 (colour)", fmt::to_string(count));
  if (count == 4 && numbers[3] != 1)
    lines_.fail("rational vertex is not supported", "a weight of 1", fmt::to_string(numbers[3]));
  if (count == 7) lines_.blank(static_cast<std::size_t>(afterPosition - lines_.line().data()));
  if (count > 4) noteOnce(polygons_, "colours of vertices");
  return {numbers[0], numbers[1], numbers[2]};
}

void ObjScan::scanFace(std::string_view rest) {
  const std::size_t first = polygons_.corners.size();
  try {
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) scanCorner(word);
  } catch (const Error& error) {
    polygons_.corners.resize(first);
    if (!normalOf_.empty()) normalOf_.resize(first);
    if (!coordinateOf_.empty()) coordinateOf_.resize(first);
    invalid_.add("faces", error);
    return;
  }
  const std::size_t corners = polygons_.corners.size() - first;
  if (corners < 3) noteOnce(polygons_, kFewCorners);
  polygons_.closeFace();
  polygons_.faceLocations.push_back(lines_.number());
  polygons_.partOf.push_back(parts_.current());
  if (smoothing_) polygons_.smoothingGroups.push_back(smoothingGroup_);
}

// v, v/vt, v//vn or v/vt/vn. Empty slots at the end are accepted.
void ObjScan::scanCorner(std::string_view word) {
  std::uint32_t coordinate = kNone, normal = kNone;
  std::string_view rest = word;
  bool last = false;
  for (std::size_t kind = 0; !last; ++kind) {
    if (kind == 3) lines_.fail("invalid corner", "v, v/vt, v//vn or v/vt/vn", quoted(word));
    const std::size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    last = slash == std::string_view::npos;
    if (part.empty() && kind > 0) {
      if (last) acceptEmptySlots(word);
    } else {
      const long long index = resolve(part, kind);
      if (index > highest_[kind]) {
        highest_[kind] = index;
        highestAt_[kind] = lines_.number();
      }
      if (kind == 0) polygons_.corners.push_back(static_cast<std::uint32_t>(index));
      if (kind == 1) coordinate = static_cast<std::uint32_t>(index);
      if (kind == 2) normal = static_cast<std::uint32_t>(index);
    }
    if (!last) rest.remove_prefix(slash + 1);
  }
  const auto append = [&](std::uint32_t index, std::vector<std::uint32_t>& list) {
    if (index != kNone && list.empty()) list.resize(polygons_.corners.size() - 1, kNone);
    if (index != kNone || !list.empty()) list.push_back(index);
  };
  append(coordinate, coordinateOf_);
  append(normal, normalOf_);
}

// Replaces the slashes at the end of a corner by blanks.
void ObjScan::acceptEmptySlots(std::string_view corner) {
  lines_.blankWord(corner.substr(corner.find_last_not_of('/') + 1));
  noteAccepted(polygons_, "empty slots of corners");
}

// Converts an index from 1, or from -1 for the last vertex so far, to one from 0. finish() checks the upper bound.
long long ObjScan::resolve(std::string_view word, std::size_t kind) const {
  const long long index = wholeNumber(word, "integers as v, v/vt, v//vn or v/vt/vn", lines_);
  const long long resolved = index > 0 ? index - 1 : counts_[kind] + index;
  if (index == 0 || resolved < 0 || resolved > kMaxIndex)
    lines_.fail(fmt::format("invalid {} index", kKinds[kind]),
                fmt::format("1 to {} or -1 to -{}", counts_[kind], counts_[kind]), fmt::to_string(index));
  return resolved;
}

// An invalid normal has length 0, as a corner without one.
void ObjScan::scanNormal(std::string_view rest) {
  glm::dvec3 n(0);
  try {
    for (int axis = 0; axis < 3; ++axis) n[axis] = coordinate(takeWord(rest), lines_);
    if (!takeWord(rest).empty()) lines_.fail("too many numbers in a normal", "x y z");
  } catch (const Error& error) {
    n = glm::dvec3(0);
    invalid_.add("normals", error);
  }
  normals_.emplace_back(n);
  ++counts_[2];
}

// u, optionally v (0 without) and w, which is ignored. v grows upward in OBJ, and downward in Polygons. An invalid one
// is (0, 0) there.
void ObjScan::scanTextureCoordinate(std::string_view rest) {
  glm::dvec2 coordinate(0);
  try {
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = takeWord(rest);
      if (word.empty() && i > 0) break;
      const double value = prep::coordinate(word, lines_);
      if (i == 2) break;
      if (!isAcceptedCoordinate(value))
        lines_.fail("texture coordinate out of range", fmt::format("-{0:g} to {0:g}", kMaxTextureCoordinate),
                    fmt::format("{:g}", value));
      coordinate[i] = value;
    }
    if (!takeWord(rest).empty()) lines_.fail("too many numbers in a texture coordinate", "u, u v or u v w");
  } catch (const Error& error) {
    coordinate = glm::dvec2(0, 1);
    invalid_.addReplaced("texture coordinates", error);
  }
  coordinates_.emplace_back(coordinate.x, 1 - coordinate.y);
  ++counts_[1];
  noteOnce(polygons_, kTextureCoordinatesNote);
}

void ObjScan::scanSmoothing(std::string_view rest) {
  const std::string_view word = takeWord(rest);
  constexpr std::string_view kExpected = "off or an integer of 0 or more";
  const long long group = word == "off" ? 0 : wholeNumber(word, kExpected, lines_);
  if (group < 0 || group > std::numeric_limits<std::uint32_t>::max() || !takeWord(rest).empty())
    lines_.fail("invalid smoothing group", kExpected, quoted(lines_.line()));
  if (!smoothing_) polygons_.smoothingGroups.resize(polygons_.faceCount(), 0);
  smoothing_ = true;
  smoothingGroup_ = static_cast<std::uint32_t>(group);
}

// Stores the whole argument: one name with blanks, or several names. read_mtl.h decides.
void ObjScan::scanMaterialFiles(std::string_view rest) {
  std::string files = parseName(rest, lines_, kMaxPathBytes);
  if (!files.empty() && materialFiles_.insert(files).second) polygons_.materialFiles.push_back(std::move(files));
}

void ObjScan::scanOther(std::string_view keyword, std::string_view rest) {
  if (keyword == "vn") return scanNormal(rest);
  if (keyword == "vt") return scanTextureCoordinate(rest);
  if (keyword == "g" || keyword == "o") return parts_.setName(parseName(rest, lines_));
  if (keyword == "usemtl") return parts_.setMaterial(parseName(rest, lines_));
  if (keyword == "s") {
    try {
      scanSmoothing(rest);
    } catch (const Error& error) {
      smoothingGroup_ = 0;
      invalid_.add("smoothing groups", error);
    }
    return;
  }
  if (keyword == "mtllib") return scanMaterialFiles(rest);
  const auto* const skipped =
      std::find_if(kSkipped.begin(), kSkipped.end(), [&](const Skipped& s) { return s.keyword == keyword; });
  if (skipped == kSkipped.end()) {
    try {
      lines_.fail("unknown statement", "a statement of a polygonal OBJ file", quoted(keyword));
    } catch (const Error& error) {
      invalid_.add("statements", error);
    }
    return;
  }
  noteOnce(polygons_, skipped->note);
}

void ObjScan::finish() {
  noteLines(polygons_, lines_);

  // Check the highest indices: a corner may refer to a vertex that follows it. Faces without a vertex are removed
  // later; a corner without texture coordinates has (0, 0), and one without a normal gets one.
  for (std::size_t kind = 0; kind < 3; ++kind)
    if (highest_[kind] >= counts_[kind] && (kind > 0 || strict_))
      invalid_.add(fmt::format("{} indices", kKinds[kind]),
                   Error(fmt::format("{}:{}", where_, highestAt_[kind]), fmt::format("invalid {} index", kKinds[kind]),
                         fmt::format("1 to {}", counts_[kind]), fmt::to_string(highest_[kind] + 1)));

  // Resolve the normals of the corners.
  polygons_.cornerNormals.reserve(normalOf_.size());
  for (const std::uint32_t normal : normalOf_)
    polygons_.cornerNormals.push_back(normal < normals_.size() ? normals_[normal] : glm::vec3(0));

  resolveTextureCoordinates();

  // Drop the list of parts if it is one part without name and material.
  polygons_.parts = parts_.take();
  if (polygons_.parts == std::vector<Part>{Part{}}) {
    polygons_.parts.clear();
    polygons_.partOf.clear();
  }
}

void ObjScan::resolveTextureCoordinates() {
  std::size_t missing = 0;
  polygons_.textureCoordinates[0].reserve(coordinateOf_.size());
  for (const std::uint32_t coordinate : coordinateOf_) {
    const bool exists = coordinate < coordinates_.size();
    missing += exists ? 0 : 1;
    polygons_.textureCoordinates[0].push_back(exists ? coordinates_[coordinate] : glm::vec2(0));
  }
  if (missing > 0) noteOnce(polygons_, kMissingCoordinatesNote);
}

}  // namespace

Scan scanObj(std::string& bytes, std::string_view where, bool strict) {
  const bool padded = removePadding(bytes);
  Scan scan = ObjScan(bytes, where, strict).run();
  if (padded) noteOnce(scan.polygons, kPaddingNote);
  return scan;
}

}  // namespace malus::prep

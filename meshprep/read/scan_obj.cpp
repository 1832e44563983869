// Wavefront OBJ: `v` and `f` are read, names and materials are skipped, free-form surfaces, continuation
// lines and unknown statements are errors.
// Source: Wavefront Technologies, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

constexpr long long kMaxIndex = std::numeric_limits<int>::max();  // of OpenMesh's handles

// Statements without faces: names, materials, display attributes, points and lines.
constexpr std::array<std::string_view, 21> kSkipped = {
    "g",      "o",      "s",      "mg",     "l",     "p",        "vt",       "vn",         "vp",        "vc",  "lod",
    "usemtl", "mtllib", "usemap", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "call"};

// How many of each kind of vertex there are so far: positions, texture coordinates, normals.
using Counts = std::array<long long, 3>;
constexpr std::array<std::string_view, 3> kKinds = {"a vertex", "a texture coordinate", "a normal"};

// One index of a corner, from 1 or, counted back from the last, from -1; kept from 0 for the check at the end.
long long resolve(std::string_view word, std::size_t kind, const Counts& counts, const Lines& at) {
  const long long index = wholeNumber(word, "v, v/vt, v//vn or v/vt/vn in whole numbers", at);
  const long long resolved = index > 0 ? index - 1 : counts[kind] + index;
  if (index == 0 || resolved < 0 || resolved > kMaxIndex)
    at.fail(fmt::format("a corner names {} that is not there", kKinds[kind]),
            fmt::format("1 to {} or -1 to -{}", counts[kind], counts[kind]), fmt::to_string(index));
  return resolved;
}

// The largest index of each kind and the line that names it.
struct Highest {
  Counts index = {-1, -1, -1};
  std::array<std::size_t, 3> line{};
};

// A corner: v, v/vt, v//vn or v/vt/vn.
std::uint32_t scanCorner(std::string_view word, const Counts& counts, Highest& highest, const Lines& at) {
  std::uint32_t vertex = 0;
  std::string_view rest = word;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    const bool last = slash == std::string_view::npos;
    const bool mayBeEmpty = kind == 1 && !last;
    if (!(mayBeEmpty && part.empty())) {
      const long long index = resolve(part, kind, counts, at);
      if (index > highest.index[kind]) {
        highest.index[kind] = index;
        highest.line[kind] = at.number();
      }
      if (kind == 0) vertex = static_cast<std::uint32_t>(index);
    }
    if (last) return vertex;
    rest.remove_prefix(slash + 1);
  }
  at.fail("a bad corner", "v, v/vt, v//vn or v/vt/vn", quoted(word));
}

void scanVertex(std::string_view rest, Polygons& polygons, const Lines& at) {
  std::array<double, 7> numbers{};
  std::size_t count = 0;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    if (count == numbers.size()) at.fail("a vertex has too many numbers", "x y z, a weight of 1, a colour");
    numbers[count++] = coordinate(word, at);
  }
  if (count < 3 || count == 5)
    at.fail("a vertex has a wrong number of numbers", "3 (x y z), 4 (weight) or 6 (colour)", fmt::to_string(count));
  if ((count == 4 || count == 7) && numbers[3] != 1)
    at.fail("a rational vertex", "a weight of 1", fmt::to_string(numbers[3]));
  polygons.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
}

}  // namespace

Polygons scanObj(std::string& bytes, std::string_view where) {
  Polygons polygons;
  Counts counts{};
  Highest highest;
  Lines lines(bytes, where);
  while (lines.nextStatement('#')) {
    if (lines.line().back() == '\\') lines.fail("a continuation line", "each statement on one line");
    std::string_view rest = lines.line();
    const std::string_view keyword = takeWord(rest);
    if (keyword == "v") {
      scanVertex(rest, polygons, lines);
      ++counts[0];
    } else if (keyword == "f") {
      std::size_t corners = 0;
      for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest), ++corners)
        polygons.corners.push_back(scanCorner(word, counts, highest, lines));
      if (corners < 3) lines.fail("a face without area", "at least 3 corners", fmt::to_string(corners));
      polygons.closeFace();
    } else if (std::find(kSkipped.begin(), kSkipped.end(), keyword) != kSkipped.end()) {
      if (keyword == "vt") ++counts[1];
      if (keyword == "vn") ++counts[2];
      lines.blank();
    } else {
      lines.fail("an unknown statement", "an OBJ file of polygons", quoted(keyword));
    }
  }

  // A corner may name a vertex that is written further down, but not one that never comes.
  for (std::size_t kind = 0; kind < 3; ++kind)
    if (highest.index[kind] >= counts[kind])
      throw Error(fmt::format("{}:{}", where, highest.line[kind]),
                  fmt::format("a corner names {} that is not there", kKinds[kind]),
                  fmt::format("1 to {}", counts[kind]), fmt::to_string(highest.index[kind] + 1));
  return polygons;
}

}  // namespace malus::prep

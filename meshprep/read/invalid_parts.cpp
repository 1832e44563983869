#include "meshprep/read/invalid_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

const glm::dvec3 kInvalidPosition(std::numeric_limits<double>::quiet_NaN());

void InvalidParts::add(std::string_view kind, const Error& error, std::size_t count) {
  this->count(kind, error, count);
  if (++errors_ > kMostErrors)
    throw Error(first_->what(), "too many invalid parts", fmt::format("at most {}", kMostErrors));
}

void InvalidParts::addReplaced(std::string_view kind, const Error& error) { count(kind, error, 1); }

void InvalidParts::count(std::string_view kind, const Error& error, std::size_t count) {
  if (strict_) throw Error(error);
  if (!first_) first_ = error;
  auto found = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.name == kind; });
  if (found == kinds_.end()) found = kinds_.insert(kinds_.end(), {std::string(kind), 0, error.what()});
  found->count += count;
}

void InvalidParts::addNotes(std::vector<std::string>& notes) const {
  for (const Kind& kind : kinds_)
    addNote(notes, fmt::format("invalid {}: {}, the first: {}", kind.name, kind.count, kind.first));
}

namespace {

bool isValid(const glm::dvec3& position) { return std::isfinite(position.x); }

void dropFaces(Polygons& polygons, InvalidParts& invalid, std::string_view where) {
  const auto isInvalid = [&](std::uint32_t corner) {
    return corner >= polygons.positions.size() || !isValid(polygons.positions[corner]);
  };
  if (std::none_of(polygons.corners.begin(), polygons.corners.end(), isInvalid)) return;

  // Move the valid faces to the front.
  std::size_t kept = 0, keptCorners = 0, dropped = 0;
  std::optional<Error> first;
  const std::vector<std::size_t> firstCorner = polygons.firstCorner;
  for (std::size_t f = 0; f + 1 < firstCorner.size(); ++f) {
    const auto begin = polygons.corners.begin() + static_cast<std::ptrdiff_t>(firstCorner[f]);
    const auto end = polygons.corners.begin() + static_cast<std::ptrdiff_t>(firstCorner[f + 1]);
    if (const auto bad = std::find_if(begin, end, isInvalid); bad != end) {
      ++dropped;
      if (first) continue;
      const std::string at = polygons.faceLocations.empty() ? std::string(where)
                             : polygons.locationsAreBytes ? fmt::format("{}, byte {}", where, polygons.faceLocations[f])
                                                          : fmt::format("{}:{}", where, polygons.faceLocations[f]);
      first = *bad >= polygons.positions.size()
                  ? Error(at, "invalid vertex index", fmt::format("1 to {}", polygons.positions.size()),
                          *bad == kInvalidCorner ? std::string() : fmt::to_string(std::uint64_t{*bad} + 1))
                  : Error(at, "a vertex of the face is invalid", "finite coordinates");
      continue;
    }
    for (std::size_t c = firstCorner[f]; c < firstCorner[f + 1]; ++c, ++keptCorners) {
      polygons.corners[keptCorners] = polygons.corners[c];
      if (!polygons.cornerNormals.empty()) polygons.cornerNormals[keptCorners] = polygons.cornerNormals[c];
      for (std::vector<glm::vec2>& set : polygons.textureCoordinates)
        if (!set.empty()) set[keptCorners] = set[c];
    }
    if (!polygons.smoothingGroups.empty()) polygons.smoothingGroups[kept] = polygons.smoothingGroups[f];
    if (!polygons.partOf.empty()) polygons.partOf[kept] = polygons.partOf[f];
    if (!polygons.faceLocations.empty()) polygons.faceLocations[kept] = polygons.faceLocations[f];
    polygons.firstCorner[++kept] = keptCorners;
  }
  invalid.add("faces", *first, dropped);

  // Remove the rest.
  const auto shrink = [](auto& values, std::size_t size) {
    if (!values.empty()) values.resize(size);
  };
  shrink(polygons.corners, keptCorners);
  shrink(polygons.cornerNormals, keptCorners);
  for (std::vector<glm::vec2>& set : polygons.textureCoordinates) shrink(set, keptCorners);
  shrink(polygons.firstCorner, kept + 1);
  shrink(polygons.smoothingGroups, kept);
  shrink(polygons.partOf, kept);
  shrink(polygons.faceLocations, kept);
}

}  // namespace

void dropInvalidFaces(Polygons& polygons, InvalidParts& invalid, std::string_view where) {
  dropFaces(polygons, invalid, where);
  const auto valid = std::find_if(polygons.positions.begin(), polygons.positions.end(), isValid);
  if (valid == polygons.positions.end()) return;
  const glm::dvec3 position = *valid;
  for (glm::dvec3& p : polygons.positions)
    if (!isValid(p)) p = position;
}

}  // namespace malus::prep

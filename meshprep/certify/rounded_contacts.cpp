#include "meshprep/certify/rounded_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/position_ids.h"
#include "meshprep/clean/touching_boxes.h"

namespace malus::prep {

namespace {

using Pair = Intersections::Pair;

constexpr double kRoundingErrors = 0x1p-46;  // of products of matrices, relative to their terms
constexpr double kDistortion = 1e-11;        // of similarities (instances.cpp), relative to the size of a piece

// Vertices and triangles of pieces, which are numbered from 0, piece by piece.
struct Part {
  Mesh mesh;
  std::vector<std::uint32_t> triangles;  // numbers in the whole mesh
};

class Search {
 public:
  Search(const Mesh& mesh, std::span<const glm::dvec3> rounded) : mesh_(mesh), rounded_(rounded) {}

  void run() {
    std::map<std::uint32_t, std::vector<std::size_t>> sets;
    DisjointSets touching = findTouchingBoxes();
    for (std::size_t i = 0; i < mesh_.pieces.size(); ++i)
      sets[touching.find(static_cast<std::uint32_t>(i))].push_back(i);

    // Search pieces beside others, and collect the single ones by their shapes.
    std::map<std::uint32_t, std::vector<std::size_t>> shapes;
    for (const auto& [first, pieces] : sets) {
      if (pieces.size() > 1)
        searchAll(pieces);
      else
        shapes[mesh_.pieces[first].original].push_back(first);
    }
    for (const auto& [original, pieces] : shapes) searchShape(original, pieces);
  }

  // Searches all pairs of these pieces.
  void searchAll(const std::vector<std::size_t>& pieces) {
    const Part part = take(pieces, rounded_);
    searchedTriangles += part.mesh.triangles.size();
    add(findIntersections(part.mesh), part);
  }

  std::vector<Pair> crossing, coincident;
  std::size_t searchedTriangles = 0;

 private:
  std::size_t endVertex(std::size_t i) const {
    return i + 1 < mesh_.pieces.size() ? mesh_.pieces[i + 1].firstVertex : mesh_.positions.size();
  }
  std::size_t endTriangle(std::size_t i) const {
    return i + 1 < mesh_.pieces.size() ? mesh_.pieces[i + 1].firstTriangle : mesh_.triangles.size();
  }

  // positions: of all vertices of the whole mesh.
  Part take(const std::vector<std::size_t>& pieces, std::span<const glm::dvec3> positions) const {
    Part part;
    for (const std::size_t i : pieces) {
      const MeshPiece& piece = mesh_.pieces[i];
      const auto first = static_cast<std::uint32_t>(part.mesh.positions.size());
      part.mesh.positions.insert(part.mesh.positions.end(), positions.begin() + piece.firstVertex,
                                 positions.begin() + static_cast<std::ptrdiff_t>(endVertex(i)));
      for (std::size_t t = piece.firstTriangle; t < endTriangle(i); ++t) {
        part.mesh.triangles.push_back(mesh_.triangles[t] - piece.firstVertex + first);
        part.triangles.push_back(static_cast<std::uint32_t>(t));
      }
    }
    return part;
  }

  void add(const Intersections& found, const Part& part) {
    for (const auto& [from, to] : {std::pair{&found.crossing, &crossing}, std::pair{&found.coincident, &coincident}})
      for (const auto& [a, b] : *from) to->emplace_back(part.triangles[a], part.triangles[b]);
  }

  // Returns the sets of pieces whose boxes overlap or touch.
  DisjointSets findTouchingBoxes() const {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < mesh_.pieces.size(); ++i) {
      Box box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
      for (std::size_t v = mesh_.pieces[i].firstVertex; v < endVertex(i); ++v)
        box = {glm::min(box.low, rounded_[v]), glm::max(box.high, rounded_[v])};
      boxes.push_back(box);
    }
    return *touchingSets(boxes);
  }

  // Returns a bound of the displacement of the vertices of a piece by rounding, in the lengths of the original piece.
  double displacement(const MeshPiece& piece, std::span<const glm::dvec3> from) const {
    double squared = 0;
    glm::dvec3 low = from.front(), high = low;
    for (std::size_t v = 0; v < from.size(); ++v) {
      const glm::dvec3 d = rounded_[piece.firstVertex + v] - (piece.linear * from[v] + piece.translation);
      squared = std::max(squared, glm::dot(d, d));
      low = glm::min(low, from[v]);
      high = glm::max(high, from[v]);
    }
    const double farthest = glm::length(glm::max(glm::abs(low), glm::abs(high)));
    return (std::sqrt(squared) + kRoundingErrors * glm::length(piece.translation)) / piece.scale +
           kRoundingErrors * farthest + kDistortion * glm::distance(low, high);
  }

  // Searches single pieces of one shape.
  void searchShape(std::size_t original, const std::vector<std::size_t>& pieces) {
    const Part shape = take({original}, mesh_.positions);
    double most = 0;
    for (const std::size_t i : pieces) most = std::max(most, displacement(mesh_.pieces[i], shape.mesh.positions));
    searchedTriangles += shape.mesh.triangles.size();
    const std::optional<std::vector<Pair>> close = findClosePairs(shape.mesh, most);
    const std::vector<std::uint32_t> ids = positionIds(shape.mesh);
    for (const std::size_t i : pieces) {
      if (!close || !keepsPositions(mesh_.pieces[i], ids)) {
        searchAll({i});
      } else if (!close->empty()) {
        const MeshPiece& piece = mesh_.pieces[i];
        const Intersections found = testPairs(rounded_.subspan(piece.firstVertex), shape.mesh.triangles, *close);
        for (const Pair& pair : found.crossing) crossing.push_back(shifted(pair, piece.firstTriangle));
        for (const Pair& pair : found.coincident) coincident.push_back(shifted(pair, piece.firstTriangle));
      }
    }
  }

  static Pair shifted(const Pair& pair, std::uint32_t first) { return {pair.first + first, pair.second + first}; }

  // Returns true if vertices at one position of the original piece are at one position here, too.
  bool keepsPositions(const MeshPiece& piece, const std::vector<std::uint32_t>& ids) const {
    for (std::size_t v = 0; v < ids.size(); ++v)
      if (rounded_[piece.firstVertex + v] != rounded_[piece.firstVertex + ids[v]]) return false;
    return true;
  }

  const Mesh& mesh_;
  std::span<const glm::dvec3> rounded_;
};

}  // namespace

std::vector<Pair> RoundedContacts::find(std::span<const glm::dvec3> rounded) {
  Intersections found;
  if (mesh_.pieces.size() < 2) {
    Mesh delivered;
    delivered.positions.assign(rounded.begin(), rounded.end());
    delivered.triangles = mesh_.triangles;
    searchedTriangles_ += delivered.triangles.size();
    found = findIntersections(delivered);
  } else {
    Search search(mesh_, rounded);
    search.run();
    searchedTriangles_ += search.searchedTriangles;
    found.crossing = std::move(search.crossing);
    found.coincident = std::move(search.coincident);
  }
  std::vector<Pair> pairs = std::move(found.crossing);
  std::sort(pairs.begin(), pairs.end());
  std::sort(found.coincident.begin(), found.coincident.end());
  pairs.insert(pairs.end(), found.coincident.begin(), found.coincident.end());
  return pairs;
}

}  // namespace malus::prep

#include "meshprep/clean/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/base/parallel_blocks.h"
#include "meshprep/clean/convex_polygon.h"
#include "meshprep/clean/ears.h"
#include "meshprep/clean/flat_polygon.h"
#include "meshprep/clean/repeated_polygons.h"
#include "meshprep/clean/shared_diagonals.h"

namespace malus::prep {

namespace {

// Corners of a face without those at the position of the previous one.
struct SimplePolygon {
  std::vector<std::uint32_t> corners;  // of the face, from 0
  std::vector<glm::dvec3> positions;

  void read(const Polygons& polygons, std::size_t face) {
    const std::span<const std::uint32_t> all = polygons.face(face);
    corners.clear();
    positions.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const glm::dvec3& position = polygons.positions[all[i]];
      if (!positions.empty() && position == positions.back()) continue;
      corners.push_back(static_cast<std::uint32_t>(i));
      positions.push_back(position);
    }
    while (positions.size() > 1 && positions.back() == positions.front()) {
      corners.pop_back();
      positions.pop_back();
    }
  }
};

// Face of more than three corners. Most are convex and no copies of another one; they are cut by all threads.
struct Polygon {
  std::uint64_t hash = 0;       // of its positions
  std::uint32_t triangles = 0;  // 0: it is not convex, or has repeated corners
  bool isNonPlanar = false;
};

// Faces of more than three corners of a block of faces, and the triangles of those that are cut, of corners of a face.
struct PolygonBlock {
  std::vector<Polygon> polygons;
  std::vector<glm::uvec3> triangles;

  void add(const Polygons& all, std::size_t face, SimplePolygon& simple) {
    simple.read(all, face);
    Polygon& polygon = polygons.emplace_back();
    polygon.hash = hashCorners(simple.positions);
    if (simple.corners.size() < all.face(face).size()) return;
    const FlatPolygon flat = flatten(simple.positions);
    const std::size_t before = triangles.size();
    if (!isConvex(flat) || !addConvex(flat, triangles)) return;
    polygon.triangles = static_cast<std::uint32_t>(triangles.size() - before);
    polygon.isNonPlanar = !flat.planar;
  }
};

std::vector<PolygonBlock> cutConvex(const Polygons& polygons) {
  std::vector<PolygonBlock> blocks(countBlocks(polygons.faceCount()));
  forBlocks(polygons.faceCount(), [&](std::size_t block, std::size_t first, std::size_t last) {
    SimplePolygon simple;
    for (std::size_t face = first; face < last; ++face)
      if (polygons.face(face).size() > 3) blocks[block].add(polygons, face, simple);
  });
  return blocks;
}

RepeatedHashes repeatedHashes(const std::vector<PolygonBlock>& blocks) {
  std::size_t polygons = 0;
  for (const PolygonBlock& block : blocks) polygons += block.polygons.size();
  RepeatedHashes hashes(polygons);
  for (const PolygonBlock& block : blocks)
    for (const Polygon& polygon : block.polygons) hashes.add(polygon.hash);
  return hashes;
}

class Triangulation {
 public:
  Triangulation(const Polygons& polygons, TriangulateCounts& counts)
      : polygons_(polygons), counts_(counts), tests_(kEarTests + kEarTestsPerCorner * polygons.corners.size()) {}

  Mesh run() {
    mesh_.positions = polygons_.positions;
    mesh_.sourceVertices.resize(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) mesh_.sourceVertices[i] = static_cast<std::uint32_t>(i);
    reserve();
    std::vector<std::size_t> firstTriangle;
    firstTriangle.reserve(polygons_.faceCount() + 1);
    const std::vector<PolygonBlock> blocks = cutConvex(polygons_);
    const RepeatedHashes repeated = repeatedHashes(blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      addBlock(b * kParallelBlock, std::min(polygons_.faceCount(), (b + 1) * kParallelBlock), blocks[b], repeated,
               firstTriangle);
    firstTriangle.push_back(mesh_.triangles.size());
    counts_.recut = recutSharedDiagonals(polygons_, firstTriangle, mesh_);
    return std::move(mesh_);
  }

 private:
  // Properties of a polygon that are counted.
  struct Shape {
    bool isConcave = false, isNonPlanar = false, isCrossing = false;
  };

  void reserve();
  void addBlock(std::size_t first, std::size_t last, const PolygonBlock& block, const RepeatedHashes& repeated,
                std::vector<std::size_t>& firstTriangle);
  void addSmall(std::size_t face);
  void addPolygon(std::size_t face);
  Shape cut(std::size_t face, const FlatPolygon& flat);
  void copyCut(const RepeatedPolygons::Match& match);
  void add(std::size_t face, const glm::uvec3& corners);
  [[noreturn]] void failTooComplex(std::size_t face) const;

  const Polygons& polygons_;
  TriangulateCounts& counts_;
  Mesh mesh_;
  EarCutter ears_;
  std::uint64_t tests_;

  // Polygons that may be repeated or are not convex, with the range of their triangles in cuts_, which have corners of
  // the polygon.
  RepeatedPolygons repeated_;
  std::vector<glm::uvec3> cuts_;
  std::vector<std::size_t> firstCut_ = {0};
  std::vector<Shape> shapes_;

  // Current polygon, and triangles of indices into its corners.
  SimplePolygon simple_;
  std::vector<glm::uvec3> triangles_;
};

// Reserves memory for all triangles: at most corners - 2 per face.
void Triangulation::reserve() {
  std::size_t most = 0;
  for (std::size_t f = 0; f < polygons_.faceCount(); ++f)
    most += std::max(polygons_.face(f).size(), std::size_t{2}) - 2;
  mesh_.triangles.reserve(most);
  mesh_.sourceFaces.reserve(most);
  if (!polygons_.cornerNormals.empty() || !polygons_.normals.empty()) mesh_.cornerNormals.reserve(3 * most);
  if (!polygons_.smoothingGroups.empty()) mesh_.smoothingGroups.reserve(most);
  if (polygons_.hasTextureAttributes()) mesh_.cornerTextures.reserve(3 * most);
  for (std::size_t set = 0; set < mesh_.hasCoordinates.size(); ++set)
    mesh_.hasCoordinates[set] = !polygons_.textureCoordinates[set].empty();
  mesh_.hasTangents = !polygons_.tangents.empty();
}

// Appends a triangle of three corners of a face, with their attributes.
void Triangulation::add(std::size_t face, const glm::uvec3& corners) {
  const std::size_t first = polygons_.firstCorner[face];
  glm::uvec3 triangle(0);
  for (int k = 0; k < 3; ++k) {
    const std::size_t corner = first + corners[k];
    triangle[k] = polygons_.corners[corner];
    if (!polygons_.cornerNormals.empty()) {
      mesh_.cornerNormals.push_back(polygons_.cornerNormals[corner]);
    } else if (!polygons_.normals.empty()) {
      mesh_.cornerNormals.push_back(polygons_.normals[triangle[k]]);
    }
  }
  if (polygons_.hasTextureAttributes())
    for (int k = 0; k < 3; ++k) mesh_.cornerTextures.push_back(cornerTexture(polygons_, first + corners[k]));
  mesh_.triangles.push_back(triangle);
  mesh_.sourceFaces.push_back(static_cast<std::uint32_t>(face));
  if (!polygons_.smoothingGroups.empty()) mesh_.smoothingGroups.push_back(polygons_.smoothingGroups[face]);
}

// Appends the triangles of the faces of a block.
void Triangulation::addBlock(std::size_t first, std::size_t last, const PolygonBlock& block,
                             const RepeatedHashes& repeated, std::vector<std::size_t>& firstTriangle) {
  auto polygon = block.polygons.begin();
  auto cut = block.triangles.begin();
  for (std::size_t face = first; face < last; ++face) {
    firstTriangle.push_back(mesh_.triangles.size());
    if (polygons_.face(face).size() <= 3) {
      addSmall(face);
      continue;
    }
    const auto end = cut + polygon->triangles;
    if (cut == end || repeated.mayContain(polygon->hash)) {
      addPolygon(face);
    } else {
      std::for_each(cut, end, [&](const glm::uvec3& corners) { add(face, corners); });
      counts_.nonPlanar += polygon->isNonPlanar ? 1 : 0;
    }
    ++counts_.polygons;
    cut = end;
    ++polygon;
  }
}

void Triangulation::addSmall(std::size_t face) {
  if (polygons_.face(face).size() == 3)
    add(face, {0, 1, 2});
  else
    ++counts_.fewCorners;
}

void Triangulation::addPolygon(std::size_t face) {
  simple_.read(polygons_, face);
  const std::vector<std::uint32_t>& kept = simple_.corners;
  counts_.repeatedCorners += polygons_.face(face).size() - kept.size();

  // Append the triangles. A face without area becomes one degenerate triangle, which cleaning counts.
  if (kept.size() < 3) return add(face, {0, 1, 2});
  if (kept.size() == 3) return add(face, {kept[0], kept[1], kept[2]});
  const auto match = repeated_.add(simple_.positions);
  if (match) copyCut(*match);
  shapes_.push_back(match ? shapes_[match->polygon] : cut(face, flatten(simple_.positions)));
  cuts_.insert(cuts_.end(), triangles_.begin(), triangles_.end());
  firstCut_.push_back(cuts_.size());
  counts_.concave += shapes_.back().isConcave ? 1 : 0;
  counts_.nonPlanar += shapes_.back().isNonPlanar ? 1 : 0;
  counts_.crossing += shapes_.back().isCrossing ? 1 : 0;
  for (const glm::uvec3& t : triangles_) add(face, {kept[t.x], kept[t.y], kept[t.z]});
}

// Triangulates as a convex polygon, by ears, or, if both fail, as a fan.
Triangulation::Shape Triangulation::cut(std::size_t face, const FlatPolygon& flat) {
  triangles_.clear();
  Shape shape{.isConcave = !isConvex(flat), .isNonPlanar = !flat.planar};
  if (!shape.isConcave) {
    if (addConvex(flat, triangles_)) return shape;
  } else {
    const EarCutter::Outcome outcome = ears_.cut(flat, tests_, triangles_);
    if (outcome == EarCutter::Outcome::kTooMuchWork) failTooComplex(face);
    if (outcome == EarCutter::Outcome::kDone) return shape;
  }
  shape.isCrossing = true;
  for (std::uint32_t i = 1; i + 1 < flat.points.size(); ++i) triangles_.emplace_back(0, i, i + 1);
  return shape;
}

// Triangulates as an earlier polygon with the same corners.
void Triangulation::copyCut(const RepeatedPolygons::Match& match) {
  triangles_.clear();
  for (std::size_t i = firstCut_[match.polygon]; i < firstCut_[match.polygon + 1]; ++i) {
    const glm::uvec3 t(match.corners[cuts_[i].x], match.corners[cuts_[i].y], match.corners[cuts_[i].z]);
    triangles_.push_back(match.reversed ? glm::uvec3(t.x, t.z, t.y) : t);
  }
}

void Triangulation::failTooComplex(std::size_t face) const {
  std::string where = fmt::format("face {}", face);
  if (!polygons_.faceLocations.empty())
    where += fmt::format(", {} {}", polygons_.locationsAreBytes ? "byte" : "line", polygons_.faceLocations[face]);
  throw Error(where, "face is too complex to triangulate", "faces with fewer corners",
              fmt::format("{} corners", polygons_.face(face).size()));
}

}  // namespace

CornerTexture cornerTexture(const Polygons& polygons, std::size_t corner) {
  CornerTexture result;
  for (std::size_t set = 0; set < result.coordinates.size(); ++set)
    if (!polygons.textureCoordinates[set].empty()) result.coordinates[set] = polygons.textureCoordinates[set][corner];
  if (!polygons.tangents.empty()) result.tangent = polygons.tangents[corner];
  return result;
}

Mesh triangulate(const Polygons& polygons, TriangulateCounts& counts) { return Triangulation(polygons, counts).run(); }

}  // namespace malus::prep

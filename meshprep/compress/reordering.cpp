#include "meshprep/compress/reordering.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <tuple>

#include <draco/compression/attributes/normal_compression_utils.h>

namespace malus::compress {

namespace {

// A triangle with the numbers of its corners, from the smallest one on, in their cyclic order.
struct Corners {
  std::uint32_t first, second, third;
};

Corners canonical(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (b < a && b <= c) return {b, c, a};
  if (c < a && c < b) return {c, a, b};
  return {a, b, c};
}

Corners canonical(const draco::Mesh::Face& face) {
  return canonical(face[0].value(), face[1].value(), face[2].value());
}

// Triangles sorted by their canonical corners, then by number.
class SortedTriangles {
 public:
  SortedTriangles(std::span<const draco::Mesh::Face> triangles, std::size_t vertices)
      : first_(vertices + 1), entries_(triangles.size()) {
    // Sort by the first corner: count, then place.
    for (const draco::Mesh::Face& face : triangles) ++first_[canonical(face).first + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Corners corners = canonical(triangles[i]);
      entries_[next[corners.first]++] = {corners.second, corners.third, static_cast<std::uint32_t>(i)};
    }

    // Sort the triangles of each first corner.
    for (std::size_t v = 0; v < vertices; ++v)
      std::sort(entries_.begin() + first_[v], entries_.begin() + first_[v + 1], [](const Entry& a, const Entry& b) {
        return std::tie(a.second, a.third, a.number) < std::tie(b.second, b.third, b.number);
      });
  }

  // Returns the position of the first triangle with these corners in the sorted list, or its size.
  std::size_t find(const Corners& corners) const {
    const auto end = entries_.begin() + first_[corners.first + 1];
    const auto found = std::lower_bound(
        entries_.begin() + first_[corners.first], end, corners,
        [](const Entry& a, const Corners& b) { return std::tie(a.second, a.third) < std::tie(b.second, b.third); });
    return found == end ? entries_.size() : static_cast<std::size_t>(found - entries_.begin());
  }

  bool hasAt(std::size_t position, const Corners& corners) const {
    return position < first_[corners.first + 1] && entries_[position].second == corners.second &&
           entries_[position].third == corners.third;
  }
  std::uint32_t numberAt(std::size_t position) const { return entries_[position].number; }

 private:
  struct Entry {
    std::uint32_t second, third;  // corners
    std::uint32_t number;
  };
  std::vector<std::uint32_t> first_;  // position of the triangles of each first corner
  std::vector<Entry> entries_;
};

// Compares the integers of an attribute.
bool haveEqualIntegers(const draco::PointAttribute& source, const draco::PointAttribute& decoded,
                       std::span<const std::uint32_t> vertices) {
  const auto bytes = static_cast<std::size_t>(source.byte_stride());
  if (decoded.byte_stride() != source.byte_stride()) return false;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const draco::AttributeValueIndex value = decoded.mapped_index(draco::PointIndex(i));
    if (value.value() >= decoded.size() ||
        std::memcmp(source.GetAddress(draco::AttributeValueIndex(vertices[i])), decoded.GetAddress(value), bytes) != 0)
      return false;
  }
  return true;
}

// Compares decoded normals with those of the source as Draco rounds them.
bool haveEqualNormals(const draco::PointAttribute& source, const draco::PointAttribute& decoded,
                      std::span<const std::uint32_t> vertices, int bits) {
  draco::OctahedronToolBox octahedron;
  octahedron.SetQuantizationBits(bits);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const draco::AttributeValueIndex value = decoded.mapped_index(draco::PointIndex(i));
    if (value.value() >= decoded.size()) return false;
    std::array<float, 3> normal{}, expected{}, found{};
    source.GetValue(draco::AttributeValueIndex(vertices[i]), &normal);
    decoded.GetValue(value, &found);
    std::int32_t s = 0, t = 0;
    octahedron.FloatVectorToQuantizedOctahedralCoords(normal.data(), &s, &t);
    octahedron.QuantizedOctahedralCoordsToUnitVector(s, t, expected.data());
    if (found != expected) return false;
  }
  return true;
}

}  // namespace

std::span<const draco::Mesh::Face> faces(const draco::Mesh& mesh) {
  if (mesh.num_faces() == 0) return {};
  return {&mesh.face(draco::FaceIndex(0)), mesh.num_faces()};
}

bool isPermutation(std::span<const std::uint32_t> numbers) {
  std::vector<bool> used(numbers.size());
  for (const std::uint32_t i : numbers) {
    if (i >= used.size() || used[i]) return false;
    used[i] = true;
  }
  return true;
}

std::optional<std::vector<std::uint32_t>> matchTriangles(std::span<const draco::Mesh::Face> source,
                                                         std::span<const draco::Mesh::Face> decoded,
                                                         std::span<const std::uint32_t> vertices) {
  if (source.size() != decoded.size()) return std::nullopt;
  const SortedTriangles sorted(source, vertices.size());
  std::vector<std::uint32_t> taken(source.size(), 0);  // of equal triangles, at the position of the first
  std::vector<std::uint32_t> triangles(source.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const draco::Mesh::Face& face = decoded[i];
    const Corners corners = canonical(vertices[face[0].value()], vertices[face[1].value()], vertices[face[2].value()]);
    const std::size_t first = sorted.find(corners);
    if (!sorted.hasAt(first, corners)) return std::nullopt;
    const std::size_t position = first + taken[first]++;  // the k-th of equal ones is the k-th of the source
    if (!sorted.hasAt(position, corners)) return std::nullopt;
    triangles[i] = sorted.numberAt(position);
  }
  return triangles;
}

bool haveEqualValues(const draco::Mesh& source, const draco::Mesh& decoded, std::span<const std::uint32_t> vertices,
                     int normalBits) {
  if (source.num_points() != vertices.size() || decoded.num_points() != vertices.size() ||
      source.num_attributes() != decoded.num_attributes())
    return false;
  for (int i = 0; i < source.num_attributes(); ++i) {
    const draco::PointAttribute &before = *source.attribute(i), &after = *decoded.attribute(i);
    if (before.attribute_type() != after.attribute_type() || before.num_components() != after.num_components() ||
        before.data_type() != after.data_type())
      return false;
    const bool isEqual = before.attribute_type() == draco::GeometryAttribute::NORMAL
                             ? haveEqualNormals(before, after, vertices, normalBits)
                             : haveEqualIntegers(before, after, vertices);
    if (!isEqual) return false;
  }
  return true;
}

}  // namespace malus::compress

#include "meshprep/compress/reordering.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <tuple>

#include <draco/compression/attributes/normal_compression_utils.h>

#include "meshprep/base/bucket_sort.h"

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
  SortedTriangles(std::span<const draco::Mesh::Face> triangles, std::size_t vertices) {
    const auto forEach = [&](auto visit) {
      for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Corners corners = canonical(triangles[i]);
        visit(corners.first, Entry{corners.second, corners.third, i});
      }
    };
    sorted_ = sortInBuckets<Entry>(vertices, forEach, [](const Entry& a, const Entry& b) {
      return std::tie(a.second, a.third, a.number) < std::tie(b.second, b.third, b.number);
    });
  }

  // Returns the position of the first triangle with these corners in the sorted list, or its size.
  std::size_t find(const Corners& corners) const {
    const auto end = sorted_.items.begin() + sorted_.first[corners.first + 1];
    const auto found = std::lower_bound(
        sorted_.items.begin() + sorted_.first[corners.first], end, corners,
        [](const Entry& a, const Corners& b) { return std::tie(a.second, a.third) < std::tie(b.second, b.third); });
    return found == end ? sorted_.items.size() : static_cast<std::size_t>(found - sorted_.items.begin());
  }

  bool hasAt(std::size_t position, const Corners& corners) const {
    return position < sorted_.first[corners.first + 1] && sorted_.items[position].second == corners.second &&
           sorted_.items[position].third == corners.third;
  }
  std::uint32_t numberAt(std::size_t position) const { return sorted_.items[position].number; }

 private:
  struct Entry {
    std::uint32_t second, third;  // corners
    std::uint32_t number;
  };
  Buckets<Entry> sorted_;  // by first corner
};

// Compares the integers of an attribute.
bool haveEqualIntegers(const draco::PointAttribute& source, const draco::PointAttribute& decoded,
                       std::span<const std::uint32_t> vertices) {
  const auto bytes = static_cast<std::size_t>(source.byte_stride());
  if (decoded.byte_stride() != source.byte_stride()) return false;
  return allNumbers(vertices.size(), [&](std::size_t i) {
    const draco::AttributeValueIndex value = decoded.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    return value.value() < decoded.size() && std::memcmp(source.GetAddress(draco::AttributeValueIndex(vertices[i])),
                                                         decoded.GetAddress(value), bytes) == 0;
  });
}

// Compares decoded normals with those of the source as Draco rounds them.
bool haveEqualNormals(const draco::PointAttribute& source, const draco::PointAttribute& decoded,
                      std::span<const std::uint32_t> vertices, int bits) {
  draco::OctahedronToolBox octahedron;
  octahedron.SetQuantizationBits(bits);
  return allNumbers(vertices.size(), [&](std::size_t i) {
    const draco::AttributeValueIndex value = decoded.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    if (value.value() >= decoded.size()) return false;
    std::array<float, 3> normal{}, expected{}, found{};
    source.GetValue(draco::AttributeValueIndex(vertices[i]), &normal);
    decoded.GetValue(value, &found);
    std::int32_t s = 0, t = 0;
    octahedron.FloatVectorToQuantizedOctahedralCoords(normal.data(), &s, &t);
    octahedron.QuantizedOctahedralCoordsToUnitVector(s, t, expected.data());
    return found == expected;
  });
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

#include "meshprep/compress/reordering.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace malus::compress {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Rotates the triangle cyclically to its smallest corner, so that the orientation is kept.
glm::uvec3 canonical(const glm::uvec3& t) {
  if (t.y < t.x && t.y <= t.z) return {t.y, t.z, t.x};
  if (t.z < t.x && t.z < t.y) return {t.z, t.x, t.y};
  return t;
}

bool isLess(const glm::uvec3& a, const glm::uvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

// Numbers of triangles, sorted by their canonical corners, then by number.
class SortedTriangles {
 public:
  SortedTriangles(std::span<const glm::uvec3> triangles, std::size_t vertices)
      : triangles_(triangles), first_(vertices + 1), numbers_(triangles.size()) {
    // Sort by the first corner: count, then place.
    for (const glm::uvec3& t : triangles) ++first_[canonical(t).x + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      numbers_[next[canonical(triangles[i]).x]++] = static_cast<std::uint32_t>(i);

    // Sort the triangles of each first corner.
    for (std::size_t v = 0; v < vertices; ++v)
      std::sort(numbers_.begin() + first_[v], numbers_.begin() + first_[v + 1], [&](std::uint32_t a, std::uint32_t b) {
        const glm::uvec3 cornersA = canonical(triangles[a]), cornersB = canonical(triangles[b]);
        return isLess(cornersA, cornersB) || (cornersA == cornersB && a < b);
      });
  }

  // Returns the position of the first triangle with these canonical corners in the sorted list, or its size.
  std::size_t find(const glm::uvec3& corners) const {
    const auto end = numbers_.begin() + first_[corners.x + 1];
    const auto found =
        std::lower_bound(numbers_.begin() + first_[corners.x], end, corners,
                         [&](std::uint32_t a, const glm::uvec3& b) { return isLess(canonical(triangles_[a]), b); });
    return found == end ? numbers_.size() : static_cast<std::size_t>(found - numbers_.begin());
  }
  bool hasAt(std::size_t position, const glm::uvec3& corners) const {
    return position < numbers_.size() && canonical(triangles_[numbers_[position]]) == corners;
  }
  std::uint32_t numberAt(std::size_t position) const { return numbers_[position]; }

 private:
  std::span<const glm::uvec3> triangles_;
  std::vector<std::uint32_t> first_;  // of each first corner in numbers_
  std::vector<std::uint32_t> numbers_;
};

// Mixes 64 bits into a hash. Source: the finalizer of MurmurHash3, A. Appleby, public domain.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t bits) {
  hash ^= bits;
  hash = (hash ^ hash >> 33u) * 0xff51afd7ed558ccdu;
  hash = (hash ^ hash >> 33u) * 0xc4ceb9fe1a85ec53u;
  return hash ^ hash >> 33u;
}

// Mixes the attributes of textures of a vertex into a hash.
std::uint64_t mixedTextures(std::uint64_t hash, const TriangleMesh& mesh, std::size_t v) {
  const auto add = [&](float value) { hash = mixed(hash, std::bit_cast<std::uint32_t>(value + 0.0f)); };
  for (const std::vector<glm::vec2>& set : mesh.textureCoordinates)
    if (!set.empty()) add(set[v].x), add(set[v].y);
  if (!mesh.tangents.empty())
    for (int i = 0; i < 4; ++i) add(mesh.tangents[v][i]);
  return hash;
}

// Compares all values of two vertices of meshes with the same attributes.
bool areEqual(const TriangleMesh& a, std::size_t i, const TriangleMesh& b, std::size_t j) {
  if (a.positions[i] != b.positions[j] || (!a.normals.empty() && a.normals[i] != b.normals[j])) return false;
  for (std::size_t set = 0; set < a.textureCoordinates.size(); ++set)
    if (!a.textureCoordinates[set].empty() && a.textureCoordinates[set][i] != b.textureCoordinates[set][j])
      return false;
  return a.tangents.empty() || a.tangents[i] == b.tangents[j];
}

bool haveEqualSizes(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions.size() == b.positions.size() && a.normals.size() == b.normals.size() &&
         a.textureCoordinates[0].size() == b.textureCoordinates[0].size() &&
         a.textureCoordinates[1].size() == b.textureCoordinates[1].size() && a.tangents.size() == b.tangents.size();
}

// Hash table of the vertices of a mesh by their values.
class VertexTable {
 public:
  explicit VertexTable(const TriangleMesh& mesh)
      : mesh_(mesh), slots_(std::bit_ceil(2 * mesh.positions.size() + 1), kNone) {}

  // Returns the slot of the vertex of the table with the values of vertex v of a mesh, or the free slot for it.
  std::uint32_t& find(const TriangleMesh& mesh, std::size_t v) {
    const glm::dvec3& p = mesh.positions[v];
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = mixed(hash, std::bit_cast<std::uint64_t>(p[axis] + 0.0));  // -0 is 0
    if (!mesh.normals.empty())
      for (int axis = 0; axis < 3; ++axis)
        hash = mixed(hash, std::bit_cast<std::uint32_t>(mesh.normals[v][axis] + 0.0f));
    for (std::size_t slot = mixedTextures(hash, mesh, v);; ++slot) {
      std::uint32_t& number = slots_[slot & (slots_.size() - 1)];
      if (number == kNone || areEqual(mesh_, number, mesh, v)) return number;
    }
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> slots_;  // numbers of vertices; kNone: free
};

}  // namespace

std::optional<std::vector<std::uint32_t>> matchVertices(const TriangleMesh& source, const TriangleMesh& decoded) {
  if (!haveEqualSizes(source, decoded)) return std::nullopt;
  VertexTable table(source);
  for (std::size_t v = 0; v < source.positions.size(); ++v) {
    std::uint32_t& number = table.find(source, v);
    if (number != kNone) return std::nullopt;
    number = static_cast<std::uint32_t>(v);
  }
  std::vector<std::uint32_t> vertices(decoded.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = table.find(decoded, i);
    if (vertices[i] == kNone) return std::nullopt;
  }
  return vertices;
}

std::optional<std::vector<std::uint32_t>> sourceTriangles(const TriangleMesh& source, const TriangleMesh& decoded,
                                                          std::span<const std::uint32_t> vertices) {
  // Compare counts.
  const std::size_t count = source.positions.size();
  if (!haveEqualSizes(source, decoded) || vertices.size() != count ||
      decoded.triangles.size() != source.triangles.size())
    return std::nullopt;

  // Require each vertex once, with equal values.
  std::vector<bool> used(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = vertices[i];
    if (v >= count || used[v] || !areEqual(source, v, decoded, i)) return std::nullopt;
    used[v] = true;
  }

  // Require each triangle once, with equal orientation; the k-th of equal ones is the k-th of the source.
  const SortedTriangles sorted(source.triangles, count);
  std::vector<std::uint32_t> taken(source.triangles.size(), 0);  // of equal triangles, at the position of the first
  std::vector<std::uint32_t> triangles(source.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const glm::uvec3& t = decoded.triangles[i];
    const glm::uvec3 corners = canonical({vertices[t.x], vertices[t.y], vertices[t.z]});
    const std::size_t first = sorted.find(corners);
    if (!sorted.hasAt(first, corners)) return std::nullopt;
    const std::size_t position = first + taken[first]++;
    if (!sorted.hasAt(position, corners)) return std::nullopt;
    triangles[i] = sorted.numberAt(position);
  }
  return triangles;
}

}  // namespace malus::compress

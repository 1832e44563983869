#include "meshprep/read/gltf_nodes.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "meshprep/base/error.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

namespace {

std::string nodeLocation(const std::string& where, std::size_t node) {
  return fmt::format("{}: nodes[{}]", where, node);
}

// Returns translation * rotation * scale, or the matrix, which is stored by columns.
// Source: glTF 2.0 Specification, section 3.5.3, "Transformations".
glm::dmat4 localTransform(const gltf::Node& node, const std::string& location) {
  glm::dmat4 m(1.0);
  if (node.matrix) {
    for (std::size_t i = 0; i < 16; ++i) m[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = (*node.matrix)[i];
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
      throw Error(location + ".matrix", "matrix is not affine", "a last row of 0, 0, 0, 1",
                  fmt::format("{}, {}, {}, {}", m[0][3], m[1][3], m[2][3], m[3][3]));
    return m;
  }
  if (node.rotation) {
    const std::array<double, 4>& q = *node.rotation;
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length))
      throw Error(location + ".rotation", "quaternion has no length", "a unit quaternion");
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    m[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    m[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
  }
  if (node.scale)
    for (int i = 0; i < 3; ++i) m[i] *= (*node.scale)[static_cast<std::size_t>(i)];
  if (node.translation) m[3] = {(*node.translation)[0], (*node.translation)[1], (*node.translation)[2], 1};
  return m;
}

constexpr double kMaxElement = 1e12;  // of a transform: metres and scale factors

// Requires finite elements within the limit, and a determinant above rounding error.
void requireInvertible(const glm::dmat4& m, const std::string& location) {
  for (int i = 0; i < 16; ++i)
    if (!(std::abs(m[i / 4][i % 4]) <= kMaxElement))
      throw Error(location, "transform is out of range", fmt::format("finite elements of at most {}", kMaxElement),
                  fmt::to_string(m[i / 4][i % 4]));
  const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
  const double determinant = glm::dot(x, glm::cross(y, z)), lengths = glm::length(x) * glm::length(y) * glm::length(z);
  if (!(std::abs(determinant) > 1e-12 * lengths))
    throw Error(location, "transform is singular", "three independent axes",
                fmt::format("determinant {}", determinant));
}

constexpr std::size_t kNoParent = std::numeric_limits<std::size_t>::max();

// Graph of the nodes: a forest, and cycles without a root.
class NodeGraph {
 public:
  NodeGraph(const gltf::Document& document, const std::string& where, GltfLeftOut& leftOut)
      : document_(document), where_(where), leftOut_(leftOut), parents_(document.nodes.size(), kNoParent) {
    findParents();
    reportCycles();
    findRoots();
  }

  const std::vector<std::size_t>& roots() const { return roots_; }
  bool isChild(std::size_t node, std::size_t parent) const {
    return node < parents_.size() && parents_[node] == parent;
  }

 private:
  std::size_t size() const { return document_.nodes.size(); }

  Error missingNode(const std::string& location, std::size_t node) const {
    return {location, "refers to a missing node", fmt::format("an index below {}", size()), fmt::to_string(node)};
  }

  // Sets the parents: the first one of each node.
  void findParents() {
    for (std::size_t i = 0; i < size(); ++i)
      for (const std::size_t c : document_.nodes[i].children) {
        if (c >= size())
          leftOut_.addPart(missingNode(nodeLocation(where_, i) + ".children", c));
        else if (parents_[c] != kNoParent)
          leftOut_.addPart(Error(nodeLocation(where_, c), "node has two parents", "at most one",
                                 fmt::format("nodes[{}] and nodes[{}]", parents_[c], i)));
        else
          parents_[c] = i;
      }
  }

  // Reports a node of each cycle. Since nodes have at most one parent, the nodes of a cycle are not below a root.
  void reportCycles() {
    std::vector<std::size_t> visitedFrom(size(), kNoParent);
    for (std::size_t i = 0; i < size(); ++i) {
      std::size_t node = i;
      for (; node != kNoParent && visitedFrom[node] == kNoParent; node = parents_[node]) visitedFrom[node] = i;
      if (node != kNoParent && visitedFrom[node] == i)
        leftOut_.addPart(Error(nodeLocation(where_, node), "node is its own ancestor", "a graph without cycles"));
    }
  }

  void findRoots() {
    if (document_.sceneNodes.empty()) {
      for (std::size_t i = 0; i < size(); ++i) {
        if (document_.nodes[i].hasInvalidChildren)
          throw Error(nodeLocation(where_, i) + ".children", "the root nodes are unknown",
                      "a list of integers, or a scene that names the root nodes");
        if (parents_[i] == kNoParent) roots_.push_back(i);
      }
      return;
    }
    const std::size_t index = defaultScene();
    std::vector<bool> named(size(), false);
    for (const std::size_t n : document_.sceneNodes[index]) {
      const std::string location = fmt::format("{}: scenes[{}].nodes", where_, index);
      if (n >= size()) {
        leftOut_.addPart(missingNode(location, n));
      } else if (parents_[n] != kNoParent || named[n]) {
        leftOut_.addPart(
            Error(location, fmt::format("node {} has a parent or is a duplicate", n), "root nodes, once each"));
      } else {
        named[n] = true;
        roots_.push_back(n);
      }
    }
  }

  std::size_t defaultScene() {
    const std::size_t count = document_.sceneNodes.size();
    std::size_t index = document_.defaultScene.value_or(0);
    if (index >= count) {
      leftOut_.addValue(Error(where_ + ": scene", "refers to a missing scene", fmt::format("an index below {}", count),
                              fmt::to_string(index)));
      index = 0;
    }
    if (count > 1) addNote(leftOut_.notes(), fmt::format("scenes other than number {} of {}", index, count));
    return index;
  }

  const gltf::Document& document_;
  const std::string& where_;
  GltfLeftOut& leftOut_;
  std::vector<std::size_t> parents_;
  std::vector<std::size_t> roots_;
};

// Throws Error unless the mesh of a node can be placed.
void requirePlaceable(const gltf::Document& document, std::size_t mesh, const glm::dmat4& worldFromObject,
                      const std::string& location) {
  if (mesh >= document.meshes.size())
    throw Error(location + ".mesh", "refers to a missing mesh",
                fmt::format("an index below {}", document.meshes.size()), fmt::to_string(mesh));
  if (document.meshes[mesh].isInvalid)
    throw Error(location + ".mesh", "refers to an invalid mesh", "a valid mesh", fmt::to_string(mesh));
  requireInvertible(worldFromObject, location);
}

}  // namespace

GltfPlacements gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                              GltfLeftOut& leftOut) {
  const NodeGraph graph(document, where, leftOut);

  // Traverse the graph depth-first with a stack; children in their order.
  GltfPlacements placements;
  std::vector<bool> visited(document.nodes.size(), false);
  std::vector<std::pair<std::size_t, glm::dmat4>> stack;
  for (auto root = graph.roots().rbegin(); root != graph.roots().rend(); ++root)
    stack.emplace_back(*root, glm::dmat4(1.0));
  while (!stack.empty()) {
    const auto [index, worldFromParent] = stack.back();
    stack.pop_back();
    const gltf::Node& node = document.nodes[index];
    if (visited[index] || node.hasInvalidTransform) continue;
    visited[index] = true;
    const std::string location = nodeLocation(where, index);
    try {
      const glm::dmat4 worldFromObject = worldFromParent * localTransform(node, location);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        if (graph.isChild(*child, index)) stack.emplace_back(*child, worldFromObject);
      const std::string name = node.name.empty() ? fmt::format("node {}", index) : node.name;
      if (node.camera) placements.cameras.push_back({*node.camera, name, worldFromObject});
      if (node.light) placements.lights.push_back({*node.light, name, worldFromObject});
      if (!node.mesh) continue;
      requirePlaceable(document, *node.mesh, worldFromObject, location);
      placements.meshes.push_back({*node.mesh, name, worldFromObject});
    } catch (const Error& error) {
      leftOut.addPart(error);
    }
    if (placements.meshes.size() > most)
      throw Error(where, "too many nodes with meshes", fmt::format("at most {}", most));
  }
  return placements;
}

}  // namespace malus::prep

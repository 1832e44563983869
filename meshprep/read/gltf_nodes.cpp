#include "meshprep/read/gltf_nodes.h"

#include <array>
#include <cmath>
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

// Returns which nodes have a parent. Throws Error if one has two.
std::vector<bool> findParents(const gltf::Document& document, const std::string& where) {
  std::vector<bool> hasParent(document.nodes.size(), false);
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    for (const std::size_t c : document.nodes[i].children) {
      if (c >= document.nodes.size())
        throw Error(nodeLocation(where, i) + ".children", "refers to a missing node",
                    fmt::format("an index below {}", document.nodes.size()), fmt::to_string(c));
      if (hasParent[c])
        throw Error(nodeLocation(where, c), "node has two parents", "at most one", nodeLocation("another", i));
      hasParent[c] = true;
    }
  return hasParent;
}

// Returns the root nodes of the scene.
std::vector<std::size_t> findRoots(const gltf::Document& document, const std::vector<bool>& hasParent,
                                   const std::string& where, std::vector<std::string>& notes) {
  std::vector<std::size_t> roots;
  if (document.sceneNodes.empty()) {
    for (std::size_t i = 0; i < document.nodes.size(); ++i)
      if (!hasParent[i]) roots.push_back(i);
    return roots;
  }
  const std::size_t index = document.defaultScene.value_or(0);
  if (index >= document.sceneNodes.size())
    throw Error(where + ": scene", "refers to a missing scene",
                fmt::format("an index below {}", document.sceneNodes.size()), fmt::to_string(index));
  if (document.sceneNodes.size() > 1)
    addNote(notes, fmt::format("scenes other than number {} of {}", index, document.sceneNodes.size()));
  std::vector<bool> named(document.nodes.size(), false);
  for (const std::size_t n : document.sceneNodes[index]) {
    const std::string location = fmt::format("{}: scenes[{}].nodes", where, index);
    if (n >= document.nodes.size())
      throw Error(location, "refers to a missing node", fmt::format("an index below {}", document.nodes.size()),
                  fmt::to_string(n));
    if (hasParent[n] || named[n])
      throw Error(location, fmt::format("node {} has a parent or is a duplicate", n), "root nodes, once each");
    named[n] = true;
    roots.push_back(n);
  }
  return roots;
}

// Throws Error for a cycle. Since nodes have at most one parent, only those of a cycle are not below a root.
void requireNoCycle(const gltf::Document& document, const std::vector<bool>& hasParent, const std::string& where) {
  std::vector<bool> reached(document.nodes.size(), false);
  std::vector<std::size_t> stack;
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    if (!hasParent[i]) stack.push_back(i);
  while (!stack.empty()) {
    const std::size_t node = stack.back();
    stack.pop_back();
    reached[node] = true;
    stack.insert(stack.end(), document.nodes[node].children.begin(), document.nodes[node].children.end());
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (!reached[i]) throw Error(nodeLocation(where, i), "node is its own ancestor", "a graph without cycles");
}

}  // namespace

GltfPlacements gltfPlacements(const gltf::Document& document, std::size_t most, const std::string& where,
                              std::vector<std::string>& notes, const std::function<void(const Error&)>& leaveOut) {
  // Check that the graph is a forest.
  const std::vector<bool> hasParent = findParents(document, where);
  requireNoCycle(document, hasParent, where);
  const std::vector<std::size_t> roots = findRoots(document, hasParent, where, notes);

  // Traverse it depth-first with a stack; children in their order.
  GltfPlacements placements;
  std::vector<std::pair<std::size_t, glm::dmat4>> stack;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.emplace_back(*root, glm::dmat4(1.0));
  while (!stack.empty()) {
    const auto [index, worldFromParent] = stack.back();
    stack.pop_back();
    const gltf::Node& node = document.nodes[index];
    glm::dmat4 worldFromObject(1.0);
    try {
      worldFromObject = worldFromParent * localTransform(node, nodeLocation(where, index));
    } catch (const Error& error) {
      leaveOut(error);
      continue;
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      stack.emplace_back(*child, worldFromObject);
    const std::string name = node.name.empty() ? fmt::format("node {}", index) : node.name;
    if (node.camera) placements.cameras.push_back({*node.camera, name, worldFromObject});
    if (node.light) placements.lights.push_back({*node.light, name, worldFromObject});
    if (!node.mesh) continue;
    try {
      if (*node.mesh >= document.meshes.size())
        throw Error(nodeLocation(where, index) + ".mesh", "refers to a missing mesh",
                    fmt::format("an index below {}", document.meshes.size()), fmt::to_string(*node.mesh));
      requireInvertible(worldFromObject, nodeLocation(where, index));
    } catch (const Error& error) {
      leaveOut(error);
      continue;
    }
    if (placements.meshes.size() == most)
      throw Error(where, "too many nodes with meshes", fmt::format("at most {}", most));
    placements.meshes.push_back({*node.mesh, name, worldFromObject});
  }
  return placements;
}

}  // namespace malus::prep

#include "meshprep/read/gltf_nodes.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "meshprep/base/error.h"
#include "meshprep/read/counted_note.h"
#include "meshprep/read/gltf_accessor.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

namespace {

std::string nodeLocation(const std::string& where, std::size_t node) {
  return fmt::format("{}: nodes[{}]", where, node);
}

// Returns translation * rotation * scale; each may be absent. rotation: a quaternion (x, y, z, w) of any length.
// Source: glTF 2.0 Specification, section 3.5.3, "Transformations".
glm::dmat4 composeTransform(const std::optional<std::array<double, 3>>& translation,
                            const std::optional<std::array<double, 4>>& rotation,
                            const std::optional<std::array<double, 3>>& scale, const std::string& location) {
  glm::dmat4 m(1.0);
  if (rotation) {
    const std::array<double, 4>& q = *rotation;
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length)) throw Error(location, "quaternion has no length", "a unit quaternion");
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
    m[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
    m[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
  }
  if (scale)
    for (int i = 0; i < 3; ++i) m[i] *= (*scale)[static_cast<std::size_t>(i)];
  if (translation) m[3] = {(*translation)[0], (*translation)[1], (*translation)[2], 1};
  return m;
}

// Returns the transform of a node: its matrix, which is stored by columns, or the composed one.
glm::dmat4 localTransform(const gltf::Node& node, const std::string& location) {
  glm::dmat4 m(1.0);
  if (node.matrix) {
    for (std::size_t i = 0; i < 16; ++i) m[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = (*node.matrix)[i];
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
      throw Error(location + ".matrix", "matrix is not affine", "a last row of 0, 0, 0, 1",
                  fmt::format("{}, {}, {}, {}", m[0][3], m[1][3], m[2][3], m[3][3]));
    return m;
  }
  return composeTransform(node.translation, node.rotation, node.scale, location + ".rotation");
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

// Whether an axis has length 0: the node and what is below it are not drawn.
bool isHidden(const glm::dmat4& m) {
  return m[0] == glm::dvec4(0.0) || m[1] == glm::dvec4(0.0) || m[2] == glm::dvec4(0.0);
}

// Reads the instances of EXT_mesh_gpu_instancing.
class InstanceTransforms {
 public:
  InstanceTransforms(const gltf::Document& document, GltfBuffers& buffers, const gltf::GpuInstancing& instancing,
                     const std::string& where, std::string location)
      : location_(std::move(location)) {
    using enum gltf::ComponentType;
    const auto open = [&](std::optional<std::size_t> index, std::optional<GltfAccessor>& accessor) {
      if (!index) return;
      accessor.emplace(document, buffers, *index, where);
      if (count_ > 0 && accessor->count() != count_)
        throw Error(location_, "numbers of values of the instances differ", fmt::to_string(count_),
                    fmt::to_string(accessor->count()));
      count_ = accessor->count();
    };
    open(instancing.translation, translation_);
    open(instancing.rotation, rotation_);
    open(instancing.scale, scale_);
    if (count_ == 0) throw Error(location_, "no instances", "TRANSLATION, ROTATION or SCALE");
    if (translation_) translation_->requireElements(3, {float32});
    if (rotation_) rotation_->requireElements(4, {float32, int8, int16}, true);
    if (scale_) scale_->requireElements(3, {float32});
  }

  std::size_t count() const { return count_; }
  glm::dmat4 operator[](std::size_t i) const {
    return composeTransform(values<3>(translation_, i), values<4>(rotation_, i), values<3>(scale_, i),
                            fmt::format("{}, instance {}", location_, i));
  }

 private:
  template <std::size_t n>
  static std::optional<std::array<double, n>> values(const std::optional<GltfAccessor>& accessor, std::size_t i) {
    if (!accessor) return {};
    std::array<double, n> result;
    for (std::size_t c = 0; c < n; ++c) result[c] = accessor->number(i, c);
    return result;
  }

  std::string location_;
  std::size_t count_ = 0;
  std::optional<GltfAccessor> translation_, rotation_, scale_;
};

// Places what the nodes of the graph have.
class Placing {
 public:
  Placing(const gltf::Document& document, GltfBuffers& buffers, std::size_t most, const std::string& where,
          GltfLeftOut& leftOut)
      : document_(document), buffers_(buffers), most_(most), where_(where), leftOut_(leftOut) {}

  GltfPlacements run() {
    const NodeGraph graph(document_, where_, leftOut_);
    placements_.worldFromNode.resize(document_.nodes.size());

    // Traverse the graph depth-first with a stack; children in their order.
    std::vector<std::pair<std::size_t, glm::dmat4>> stack;
    for (auto root = graph.roots().rbegin(); root != graph.roots().rend(); ++root)
      stack.emplace_back(*root, glm::dmat4(1.0));
    while (!stack.empty()) {
      const auto [index, worldFromParent] = stack.back();
      stack.pop_back();
      const gltf::Node& node = document_.nodes[index];
      if (placements_.worldFromNode[index] || node.hasInvalidTransform) continue;
      try {
        const glm::dmat4 worldFromNode = worldFromParent * localTransform(node, nodeLocation(where_, index));
        placements_.worldFromNode[index] = worldFromNode;
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
          if (graph.isChild(*child, index)) stack.emplace_back(*child, worldFromNode);
        placeNode(node, index, worldFromNode);
      } catch (const GltfLimitError&) {
        throw;
      } catch (const Error& error) {
        leftOut_.addPart(error);
      }
    }
    if (hidden_ > 0) addNote(leftOut_.notes(), countedNote("meshes hidden by a scale of 0", hidden_, hiddenNames_));
    return std::move(placements_);
  }

 private:
  void placeNode(const gltf::Node& node, std::size_t index, const glm::dmat4& worldFromNode) {
    const std::string name = node.name.empty() ? fmt::format("node {}", index) : node.name;
    if (node.camera) placements_.cameras.push_back({*node.camera, name, worldFromNode});
    if (node.light) placements_.lights.push_back({*node.light, name, worldFromNode});
    if (!node.mesh || node.hasInvalidInstancing || node.hasInvalidSkin) return;
    const std::string location = nodeLocation(where_, index);
    requireMesh(*node.mesh, location);
    GltfPlacement placement{*node.mesh, name, worldFromNode, morphWeights(node, location), {}};
    if (node.skin) {
      requireSkin(*node.skin, location);
      placement.skin = node.skin;
      placement.worldFromObject = glm::dmat4(1.0);  // section 3.7.3.3: only the joints' transforms apply
    }
    if (!node.instancing) {
      add(std::move(placement), location);
      return;
    }
    const InstanceTransforms instances(document_, buffers_, *node.instancing, where_, location);
    if (instances.count() > most_) throw tooMany();
    for (std::size_t i = 0; i < instances.count(); ++i) {
      GltfPlacement instance = placement;
      instance.name = fmt::format("{}.{}", name, i + 1);
      instance.worldFromObject *= instances[i];
      add(std::move(instance), location);
    }
  }

  void add(GltfPlacement placement, const std::string& location) {
    if (isHidden(placement.worldFromObject)) {
      ++hidden_;
      if (hiddenNames_.size() <= kListedNames) hiddenNames_.push_back(placement.name);
      return;
    }
    requireInvertible(placement.worldFromObject, location);
    if (placements_.meshes.size() >= most_) throw tooMany();
    placements_.meshes.push_back(std::move(placement));
  }

  GltfLimitError tooMany() const { return {where_, "too many nodes with meshes", fmt::format("at most {}", most_)}; }

  void requireMesh(std::size_t mesh, const std::string& location) const {
    if (mesh >= document_.meshes.size())
      throw Error(location + ".mesh", "refers to a missing mesh",
                  fmt::format("an index below {}", document_.meshes.size()), fmt::to_string(mesh));
    if (document_.meshes[mesh].isInvalid)
      throw Error(location + ".mesh", "refers to an invalid mesh", "a valid mesh", fmt::to_string(mesh));
  }

  void requireSkin(std::size_t skin, const std::string& location) const {
    if (skin >= document_.skins.size())
      throw Error(location + ".skin", "refers to a missing skin",
                  fmt::format("an index below {}", document_.skins.size()), fmt::to_string(skin));
  }

  // Returns the weights of the node, else those of its mesh; empty if all are 0.
  std::vector<double> morphWeights(const gltf::Node& node, const std::string& location) const {
    std::vector<double> weights = node.weights.empty() ? document_.meshes[*node.mesh].weights : node.weights;
    for (const double weight : weights)
      if (!(std::abs(weight) <= kMaxElement))
        throw Error(location + ".weights", "weight is out of range", fmt::format("+-{}", kMaxElement),
                    fmt::to_string(weight));
    while (!weights.empty() && weights.back() == 0) weights.pop_back();
    return weights;
  }

  const gltf::Document& document_;
  GltfBuffers& buffers_;
  std::size_t most_;
  const std::string& where_;
  GltfLeftOut& leftOut_;
  GltfPlacements placements_;
  std::size_t hidden_ = 0;
  std::vector<std::string> hiddenNames_;
};

}  // namespace

GltfPlacements gltfPlacements(const gltf::Document& document, GltfBuffers& buffers, std::size_t most,
                              const std::string& where, GltfLeftOut& leftOut) {
  return Placing(document, buffers, most, where, leftOut).run();
}

}  // namespace malus::prep

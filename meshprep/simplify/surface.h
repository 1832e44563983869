// A triangle mesh as a point set, with a bounding volume hierarchy for exact distances of points to it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/mesh.h"

namespace malus::prep {

using TriangleCorners = std::array<glm::dvec3, 3>;

// Distance of a point to a triangle. Source: C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
double distanceToTriangle(const glm::dvec3& point, const TriangleCorners& triangle);

class Surface {
 public:
  struct Nearest {
    double distance = 0;
    std::uint32_t triangle = 0;
  };

  // Positions in metres; at least one triangle. The mesh is not referenced later.
  explicit Surface(const Mesh& mesh);

  std::size_t triangleCount() const { return corners_.size(); }
  const TriangleCorners& triangle(std::uint32_t i) const { return corners_[i]; }

  // The nearest triangle; of several at the same distance, the same one in every call.
  Nearest nearest(const glm::dvec3& point) const;

  // Calls visit(triangle) for every triangle not farther from the point than `radius`.
  void forEachWithin(const glm::dvec3& point, double radius, const std::function<void(std::uint32_t)>& visit) const;

 private:
  struct Node {
    glm::dvec3 low{}, high{};
    std::uint32_t begin = 0, end = 0;  // of order_
    std::uint32_t left = 0;            // the right child follows the left; 0: a leaf
  };
  double boxDistance2(const Node& node, const glm::dvec3& point) const;
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<TriangleCorners> corners_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace malus::prep

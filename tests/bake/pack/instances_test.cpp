#include "bake/pack/instances.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/bake/fixtures.h"

namespace malus::pack {
namespace {

glm::dmat3 rotation(const glm::dvec3& axis, double angle) {
  const glm::dvec3 n = glm::normalize(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat3 result;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0.0);
    e[i] = 1;
    result[i] = e * c + glm::cross(n, e) * s + n * (glm::dot(n, e) * (1 - c));
  }
  return result;
}

TEST(Instances, StretchIsTheRangeOfSingularValues) {
  const glm::dmat3 a = rotation({1, 2, 3}, 0.7), b = rotation({-2, 1, 0.5}, 2.1);
  const auto range = [&](const glm::dvec3& scale) {
    glm::dmat3 diagonal(1.0);
    for (int i = 0; i < 3; ++i) diagonal[i][i] = scale[i];
    return measureStretch(a * diagonal * b);
  };
  for (const glm::dvec3& scale : {glm::dvec3(1), glm::dvec3(-1, 1, 1), glm::dvec3(2e-6), glm::dvec3(3, 3, 5),
                                  glm::dvec3(1, 10, 0.1), glm::dvec3(1e5, 3e5, 1e5), glm::dvec3(1e-3, -1, 0.5)}) {
    const glm::dvec3 size = glm::abs(scale);
    const double smallest = std::min({size.x, size.y, size.z}), largest = std::max({size.x, size.y, size.z});
    EXPECT_NEAR(range(scale).smallest / smallest, 1, 1e-2) << smallest;
    EXPECT_NEAR(range(scale).largest / largest, 1, 1e-7) << largest;
  }
  EXPECT_NEAR(range({7, 7, 7}).condition(), 1, 1e-7);
  EXPECT_TRUE(std::isinf(measureStretch(glm::dmat3(0.0)).condition()));
  EXPECT_GT(range({1, 1, 0}).condition(), 1e5);
}

TEST(Instances, PlacedMeshesKeepTheirOutside) {
  const Scene scene = bake::test::unusualScene();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const Mesh placed = placedMesh(scene, instance);
    ASSERT_EQ(placed.positions.size(), mesh.positions.size());
    EXPECT_EQ(placed.name, instance.name);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_LT(glm::distance(placed.positions[i], placedPoint(instance, mesh.positions[i])), 1e-6);
      const glm::dvec3 local = placed.positions[i] - placed.origin;
      EXPECT_EQ(local, glm::dvec3(glm::vec3(local)));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      // A point on the outer side of the plane stays there.
      const auto normal = [&](const Mesh& m) {
        const glm::uvec3& c = m.triangles[t];
        return glm::cross(m.positions[c.y] - m.positions[c.x], m.positions[c.z] - m.positions[c.x]);
      };
      const glm::dvec3 corner = mesh.positions[mesh.triangles[t].x],
                       outside = placedPoint(instance, corner + normal(mesh));
      EXPECT_GT(glm::dot(outside - placedPoint(instance, corner), normal(placed)), 0);
    }
  }
}

TEST(Instances, NormalsAreThoseOfTheImage) {
  Scene scene = bake::test::smallScene();
  scene.instances = {{"sheared", 0, {{1, 0.5, 0}, {0, -2, 0}, {0.25, 0, 3}}, {4, 0, 0}}};
  const Instance& instance = scene.instances[0];
  const Mesh placed = placedMesh(scene, instance);
  for (std::size_t i = 0; i < placed.normals.size(); ++i) {
    const glm::dvec3 n(scene.meshes[0].normals[i]), image(placed.normals[i]);
    EXPECT_NEAR(glm::length(image), 1, 1e-6);
    // Perpendicular to the image of every tangent, and on the same side.
    const glm::dvec3 tangent = glm::cross(n, glm::dvec3(0.3, -0.5, 0.8));
    EXPECT_NEAR(glm::dot(image, instance.linear * tangent), 0, 1e-6);
    EXPECT_GT(glm::dot(image, instance.linear * n), 0);
  }
}

TEST(Instances, CountsAndBoxes) {
  const Scene scene = bake::test::unusualScene();
  const InstanceCounts counts = countInstances(scene);
  EXPECT_EQ(counts.meshes, 1u);
  EXPECT_EQ(counts.placements, 3u);
  EXPECT_EQ(counts.placedTriangles, 4u + 3 * 2);
  EXPECT_EQ(scene.triangleCount(), 6u);
  const Scene expanded = withoutInstances(scene);
  EXPECT_EQ(expanded.meshes.size(), 4u);
  EXPECT_EQ(expanded.triangleCount(), counts.placedTriangles);
  const std::vector<Box> boxes = placementBoxes(scene);
  const std::vector<Placement> all = placements(scene);
  ASSERT_EQ(boxes.size(), 4u);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(all[i].name(), expanded.meshes[i].name);
    for (std::uint32_t v = 0; v < all[i].mesh->positions.size(); ++v)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(all[i].point(v)[axis], boxes[i].low[axis]);
        EXPECT_LE(all[i].point(v)[axis], boxes[i].high[axis]);
      }
  }
  EXPECT_EQ(farthestCoordinate(sceneBox(scene)), 1e5 + 1.5);
}

}  // namespace
}  // namespace malus::pack

// Instances: further places of a mesh, which is stored once.
//
// A mesh is at its first place by itself: without the instances a scene is the same scene with fewer things in it. Code
// that is about materials or about the stored triangles reads Scene::meshes and needs no more; code that is about
// places asks here for the placements, or for boxes and factors, which take no time per triangle.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "bake/pack/scene.h"

namespace malus::pack {

// Axis-aligned, in metres relative to the scene's origin; empty: low > high.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  bool isEmpty() const { return low.x > high.x; }
  void add(const glm::dvec3& p);
  void add(const Box& box);
};
Box findBox(std::span<const glm::dvec3> positions);
double farthestCoordinate(const Box& box);  // largest absolute coordinate of its corners; 0 of an empty box

// Smallest and largest factor by which a linear map scales lengths: its singular values.
struct Stretch {
  double smallest = 1, largest = 1;
  double condition() const;  // infinite for a map without an inverse
};
Stretch measureStretch(const glm::dmat3& linear);

inline glm::dvec3 placedPoint(const Instance& instance, const glm::dvec3& p) {
  return instance.linear * p + instance.translation;
}
// Whether outside and inside, as seen from the order of the corners of triangles, change places.
bool isMirrored(const glm::dmat3& linear);
// Times a normal, and times -1 if the map is mirrored, a vector along the normal of the image. The matrix of cofactors:
// the determinant times the transposed inverse.
glm::dmat3 cofactors(const glm::dmat3& linear);

// A box around the image of a box: of its corners, so that it may be larger than that of the mesh's points.
Box placedBox(const Box& box, const Instance& instance);

// The mesh of an instance at its place. Its origin is that of the mesh, placed and rounded to floats; its positions are
// floats relative to it. Mirrored triangles have their second and third corner exchanged.
Mesh placedMesh(const Scene& scene, const Instance& instance);

// The scene with each instance as a separate mesh, behind the others.
Scene withoutInstances(const Scene& scene);

// A place of a mesh. instance: null at its first place.
struct Placement {
  const Mesh* mesh;
  const Instance* instance;
  const std::string& name() const { return instance ? instance->name : mesh->name; }
  // A vertex of the mesh, there.
  glm::dvec3 point(std::uint32_t vertex) const {
    const glm::dvec3& p = mesh->positions[vertex];
    return instance ? placedPoint(*instance, p) : p;
  }
  bool isMirrored() const { return instance && pack::isMirrored(instance->linear); }
};
std::vector<Placement> placements(const Scene& scene);  // meshes, then instances

// A box around each placement, in their order.
std::vector<Box> placementBoxes(const Scene& scene);
// Around all of them.
Box sceneBox(const Scene& scene);

// Counts of a scene with instances: of its meshes that have instances, of all places of these, and of the triangles in
// all places of the scene.
struct InstanceCounts {
  std::uint64_t meshes = 0, placements = 0, placedTriangles = 0;
};
InstanceCounts countInstances(const Scene& scene);
// "20000 triangles stored, 4000000 placed in 200 instances", or "20000 triangles" without instances.
std::string triangleText(const Scene& scene);

}  // namespace malus::pack

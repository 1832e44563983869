// Which places of a mesh are stored as instances of one mesh, and which as separate meshes.
//
// A mesh that a scene places several times is stored once if that saves at least kLeastSavedTriangles triangles; copies
// of smaller ones are traced faster. A place is left out, with the reason, and becomes a separate mesh
// - if its transform, relative to the first place, scales lengths by factors beyond 1:1000 (pack/format.h),
// - if it shares positions with another place of any mesh: a shared position must be rounded to one grid, or a crack
//   appears (meshprep/compress/rounding.h),
// - if it is a body of glass whose box, with a margin for rounding, touches that of another body of glass: contacts and
//   nesting of bodies are inspected on the rounded meshes (glass_bodies.h). Bodies whose boxes are apart have neither.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "bake/meshes/meshes.h"
#include "bake/pack/instances.h"
#include "bake/pack/scene.h"

namespace malus::bake {

inline constexpr std::size_t kLeastSavedTriangles = 1000;

struct InstanceChoice {
  std::vector<std::size_t> first;    // per place: the place whose mesh is stored: itself, or an earlier one
  std::vector<std::string> reasons;  // a line for each mesh that has instances, or places that are left out
  pack::Box box;                     // of all places, in world space
};

InstanceChoice chooseInstances(const std::vector<PlacedMesh>& placed, const std::vector<pack::Material>& materials);

// Sets the transform of an instance: from the mesh at its first place to another one. Both are affine, from the mesh's
// own space to world space; origin: the scene's.
void setPlace(const glm::dmat4& first, const glm::dmat4& other, const glm::dvec3& origin, pack::Instance& instance);

}  // namespace malus::bake

// Contacts of bodies of glass: pairs of faces that cross, touch or coincide.
//
// Faces of different bodies are compared only where the boxes of the bodies overlap. The faces of one body are compared
// once for all of its copies: the result depends on the positions relative to the first vertex, which are exact for
// points of a grid, and is kept from call to call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"
#include "meshprep/clean/box_pairs.h"

namespace malus::bake {

// Bodies of glass: indices of certified, closed meshes of scene.meshes.
using GlassBodies = std::vector<std::size_t>;

struct Contact {
  std::array<std::size_t, 2> mesh{};  // equal, or the smaller first
  std::array<std::uint32_t, 2> face{};
  glm::dvec3 at{0};  // in the scene's coordinates, metres
  bool isCoincident = false;
};

struct Contacts {
  std::vector<Contact> found;
  bool isComplete = true;  // false: too many pairs of faces to test, and none are listed
};

// Positions of a mesh, relative to the scene's origin.
using PositionsOf = std::function<const std::vector<glm::dvec3>&(std::size_t)>;

// Returns the boxes of meshes, and the pairs of them that overlap or touch: first < second, in ascending order.
std::vector<prep::Box> meshBoxes(const GlassBodies& bodies, const PositionsOf& positions);
std::vector<std::pair<std::size_t, std::size_t>> overlappingPairs(const std::vector<prep::Box>& boxes);

// Finds the contacts of faces of different bodies.
Contacts findContactsBetween(const pack::Scene& scene, const GlassBodies& bodies, const PositionsOf& positions);

// Finds the contacts of faces of the same body.
class ContactsWithin {
 public:
  ContactsWithin();
  ~ContactsWithin();
  ContactsWithin(const ContactsWithin&) = delete;
  ContactsWithin& operator=(const ContactsWithin&) = delete;
  std::vector<Contact> find(const pack::Scene& scene, const GlassBodies& bodies, const PositionsOf& positions);
  std::size_t inspectedShapes() const;  // number of different shapes so far

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace malus::bake

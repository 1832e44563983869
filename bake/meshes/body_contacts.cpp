#include "bake/meshes/body_contacts.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "bake/pack/format.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/select.h"

namespace malus::bake {

namespace {

constexpr std::size_t kMostRegions = 16;  // with more overlapping bodies, all faces of a body are compared

prep::Box triangleBox(const glm::uvec3& t, const std::vector<glm::dvec3>& positions) {
  const glm::dvec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

// Appends the faces of a mesh that reach into one of the regions, and their numbers.
void appendFaces(const pack::Mesh& mesh, const std::vector<glm::dvec3>& positions,
                 const std::vector<prep::Box>& regions, prep::Mesh& all, std::vector<std::uint32_t>& faces) {
  const auto firstVertex = static_cast<std::uint32_t>(all.positions.size());
  all.positions.insert(all.positions.end(), positions.begin(), positions.end());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const prep::Box box = triangleBox(mesh.triangles[f], positions);
    if (regions.size() <= kMostRegions &&
        std::none_of(regions.begin(), regions.end(), [&](const prep::Box& region) { return overlap(box, region); }))
      continue;
    all.triangles.push_back(mesh.triangles[f] + firstVertex);
    faces.push_back(f);
  }
}

}  // namespace

std::vector<prep::Box> meshBoxes(const GlassBodies& bodies, const PositionsOf& positions) {
  std::vector<prep::Box> boxes;
  boxes.reserve(bodies.size());
  for (const std::size_t i : bodies) {
    const std::vector<glm::dvec3>& all = positions(i);
    prep::Box box{all.front(), all.front()};
    for (const glm::dvec3& p : all) box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<std::pair<std::size_t, std::size_t>> overlappingPairs(const std::vector<prep::Box>& boxes) {
  // Sweep along x.
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return boxes[a].low.x < boxes[b].low.x; });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].low.x <= boxes[order[i]].high.x; ++j)
      if (overlap(boxes[order[i]], boxes[order[j]])) pairs.emplace_back(std::minmax(order[i], order[j]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Contacts findContactsBetween(const pack::Scene& scene, const GlassBodies& bodies, const PositionsOf& positions) {
  // Find the regions of other bodies that each body reaches.
  const std::vector<prep::Box> boxes = meshBoxes(bodies, positions);
  std::vector<std::vector<prep::Box>> regions(bodies.size());
  for (const auto& [a, b] : overlappingPairs(boxes)) {
    regions[a].push_back(boxes[b]);
    regions[b].push_back(boxes[a]);
  }

  // Compare the faces in them.
  prep::Mesh all;
  std::vector<std::uint32_t> faces;
  std::vector<std::size_t> firstFace;  // of each body, in faces
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    firstFace.push_back(faces.size());
    if (!regions[k].empty()) appendFaces(scene.meshes[bodies[k]], positions(bodies[k]), regions[k], all, faces);
  }
  Contacts contacts;
  if (faces.empty()) return contacts;
  const prep::Intersections found = prep::findIntersections(all);
  contacts.isComplete = found.complete;
  const auto add = [&](const prep::Intersections::Pair& pair, bool isCoincident) {
    Contact contact;
    std::size_t side = 0;
    for (const std::uint32_t face : {pair.first, pair.second}) {
      const auto body = std::upper_bound(firstFace.begin(), firstFace.end(), std::size_t{face}) - firstFace.begin() - 1;
      contact.mesh[side] = bodies[static_cast<std::size_t>(body)];
      contact.face[side++] = faces[face];
    }
    if (contact.mesh[0] == contact.mesh[1]) return;
    contact.at = (prep::centroid(all, pair.first) + prep::centroid(all, pair.second)) * 0.5 + scene.origin;
    contact.isCoincident = isCoincident;
    contacts.found.push_back(contact);
  };
  for (const auto& pair : found.crossing) add(pair, false);
  for (const auto& pair : found.coincident) add(pair, true);
  return contacts;
}

// Contacts of the shapes, relative to the first vertex, by the hash of triangles and relative positions.
struct ContactsWithin::Cache {
  std::unordered_map<std::uint64_t, std::vector<Contact>> byShape;
};

ContactsWithin::ContactsWithin() : cache_(std::make_unique<Cache>()) {}
ContactsWithin::~ContactsWithin() = default;

std::size_t ContactsWithin::inspectedShapes() const { return cache_->byShape.size(); }

std::vector<Contact> ContactsWithin::find(const pack::Scene& scene, const GlassBodies& bodies,
                                          const PositionsOf& positions) {
  std::vector<Contact> contacts;
  for (const std::size_t i : bodies) {
    prep::Mesh shape;
    shape.triangles = scene.meshes[i].triangles;
    shape.positions = positions(i);
    const glm::dvec3 first = shape.positions.front();
    for (glm::dvec3& p : shape.positions) p = p - first + 0.0;  // + 0.0: no negative zeros
    const std::uint64_t key = pack::hashBytes(std::as_bytes(std::span(shape.positions))) * 31 +
                              pack::hashBytes(std::as_bytes(std::span(shape.triangles)));
    const auto emplaced = cache_->byShape.try_emplace(key);
    std::vector<Contact>& known = emplaced.first->second;
    if (emplaced.second) {
      const prep::Intersections found = prep::findIntersections(shape);
      const auto add = [&](const prep::Intersections::Pair& pair, bool isCoincident) {
        known.push_back({{},
                         {pair.first, pair.second},
                         (prep::centroid(shape, pair.first) + prep::centroid(shape, pair.second)) * 0.5,
                         isCoincident});
      };
      for (const auto& pair : found.crossing) add(pair, false);
      for (const auto& pair : found.coincident) add(pair, true);
    }
    for (Contact contact : known) {
      contact.mesh = {i, i};
      contact.at += first + scene.origin;
      contacts.push_back(contact);
    }
  }
  return contacts;
}

}  // namespace malus::bake

#include "bake/meshes/glass_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/shell_nesting.h"

namespace malus::bake {

namespace {

constexpr std::size_t kSamples = 64;  // vertices of a body that are tested for being inside another one
constexpr double kInside = 0.75;      // winding number above which they are

// A pair of faces of bodies that cross, touch or coincide.
struct Contact {
  std::array<std::size_t, 2> mesh{};  // the smaller first
  std::array<std::uint32_t, 2> face{};
  glm::dvec3 at{0};
  bool coincident = false;
};

// positions(i): those of mesh i.
template <class Positions>
std::vector<Contact> findContacts(const pack::Scene& scene, const GlassBodies& bodies, Positions positions) {
  prep::Mesh all;
  std::vector<std::uint32_t> firstFace;
  for (const std::size_t i : bodies) {
    const auto firstVertex = static_cast<std::uint32_t>(all.positions.size());
    firstFace.push_back(static_cast<std::uint32_t>(all.triangles.size()));
    const std::vector<glm::dvec3>& p = positions(i);
    all.positions.insert(all.positions.end(), p.begin(), p.end());
    for (const glm::uvec3& t : scene.meshes[i].triangles) all.triangles.push_back(t + firstVertex);
  }
  const prep::Intersections found = prep::findIntersections(all);
  std::vector<Contact> contacts;
  const auto add = [&](const prep::Intersections::Pair& pair, bool coincident) {
    Contact contact;
    const std::array<std::uint32_t, 2> faces = {pair.first, pair.second};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto body = static_cast<std::size_t>(std::upper_bound(firstFace.begin(), firstFace.end(), faces[k]) -
                                                 firstFace.begin() - 1);
      contact.mesh[k] = bodies[body];
      contact.face[k] = faces[k] - firstFace[body];
    }
    contact.at = (prep::centroid(all, faces[0]) + prep::centroid(all, faces[1])) * 0.5 + scene.origin;
    contact.coincident = coincident;
    contacts.push_back(contact);
  };
  for (const auto& pair : found.crossing) add(pair, false);
  for (const auto& pair : found.coincident) add(pair, true);
  return contacts;
}

std::string describe(const pack::Scene& scene, const Contact& contact) {
  const std::string at = fmt::format("({:.6g}, {:.6g}, {:.6g})", contact.at.x, contact.at.y, contact.at.z);
  if (contact.mesh[0] == contact.mesh[1])
    return fmt::format("faces {} and {} of mesh '{}' near {}", contact.face[0], contact.face[1],
                       scene.meshes[contact.mesh[0]].name, at);
  return fmt::format("face {} of mesh '{}' and face {} of mesh '{}' near {}", contact.face[0],
                     scene.meshes[contact.mesh[0]].name, contact.face[1], scene.meshes[contact.mesh[1]].name, at);
}

// The number of contacts of each pair of different meshes, and the first one.
struct PairContacts {
  Contact first;
  std::size_t count = 0, coincident = 0;
};

std::map<std::array<std::size_t, 2>, PairContacts> groupByPair(const std::vector<Contact>& contacts) {
  std::map<std::array<std::size_t, 2>, PairContacts> pairs;
  for (const Contact& contact : contacts) {
    PairContacts& pair = pairs[contact.mesh];
    if (pair.count++ == 0) pair.first = contact;
    pair.coincident += contact.coincident ? 1u : 0u;
  }
  return pairs;
}

// Returns true if a sampled vertex of `inner` is inside the glass of `outer`.
bool isInside(const pack::Mesh& inner, const pack::Mesh& outer) {
  glm::dvec3 low = outer.positions.front(), high = low;
  for (const glm::dvec3& p : outer.positions) low = glm::min(low, p), high = glm::max(high, p);
  prep::Shell shell;
  const std::size_t count = std::min(kSamples, inner.positions.size());
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3& p = inner.positions[k * inner.positions.size() / count];
    if (!glm::all(glm::lessThan(low, p)) || !glm::all(glm::lessThan(p, high))) continue;
    if (shell.triangles.empty()) shell.triangles = outer.triangles;
    if (prep::windingNumber(shell, outer.positions, p) > kInside) return true;
  }
  return false;
}

// Reports bodies inside others with an index that does not fit. touching: pairs that are reported otherwise.
template <class Report>
void inspectNesting(const pack::Scene& scene, const GlassBodies& bodies,
                    const std::map<std::array<std::size_t, 2>, PairContacts>& touching, Report report) {
  for (const std::size_t i : bodies)
    for (const std::size_t j : bodies) {
      if (i == j || touching.contains({std::min(i, j), std::max(i, j)})) continue;
      const pack::Mesh &inner = scene.meshes[i], &outer = scene.meshes[j];
      const double expected = scene.materials[outer.material].eta.y, found = scene.materials[inner.material].outsideEta;
      if (std::abs(expected - found) <= 1e-9 * expected || !isInside(inner, outer)) continue;
      report(fmt::format("mesh '{}' is inside mesh '{}'", inner.name, outer.name),
             fmt::format("an outsideEta of {:g} in material '{}', or one mesh for a cavity", expected,
                         scene.materials[inner.material].name),
             fmt::format("{:g}", found));
    }
}

}  // namespace

std::vector<std::string> inspectBodies(const pack::Scene& scene, const GlassBodies& bodies, bool allowed) {
  std::vector<std::string> warnings;
  if (bodies.size() < 2) return warnings;
  const auto report = [&](const std::string& problem, const std::string& expected, const std::string& found) {
    const Error error("glass", problem, expected + "; --allow-open-glass bakes it", found);
    if (!allowed) throw error;
    warnings.emplace_back(error.what());
  };
  const auto pairs = groupByPair(findContacts(
      scene, bodies, [&](std::size_t i) -> const std::vector<glm::dvec3>& { return scene.meshes[i].positions; }));
  for (const auto& [meshes, pair] : pairs) {
    if (meshes[0] == meshes[1]) continue;  // certified alone
    const pack::Mesh &a = scene.meshes[meshes[0]], &b = scene.meshes[meshes[1]];
    if (pair.coincident == a.triangles.size() && pair.coincident == b.triangles.size())
      report(fmt::format("mesh '{}' is the same body as mesh '{}'", b.name, a.name), "each body once",
             fmt::format("{} coincident faces", pair.coincident));
    else
      warnings.push_back(
          fmt::format("glass: meshes '{}' and '{}' touch or cross in {} {}, first {}; light there is undefined: move "
                      "them apart, or "
                      "join them into one body",
                      a.name, b.name, pair.count, pair.count == 1 ? "pair of faces" : "pairs of faces",
                      describe(scene, pair.first)));
  }
  inspectNesting(scene, bodies, pairs, report);
  return warnings;
}

compress::Inspection glassInspection(const pack::Scene& scene, GlassBodies bodies) {
  if (bodies.empty()) return {};
  // Contacts as placed are reported by inspectBodies.
  const std::vector<Contact> placed = findContacts(
      scene, bodies, [&](std::size_t i) -> const std::vector<glm::dvec3>& { return scene.meshes[i].positions; });
  std::set<std::array<std::size_t, 2>> touching;
  for (const Contact& contact : placed) touching.insert(contact.mesh);

  const auto newContacts = [&scene, bodies, touching](std::span<const compress::RoundedMesh> rounded) {
    std::vector<Contact> contacts = findContacts(
        scene, bodies, [&](std::size_t i) -> const std::vector<glm::dvec3>& { return rounded[i].positions; });
    std::erase_if(contacts, [&](const Contact& contact) { return touching.contains(contact.mesh); });
    return contacts;
  };
  compress::Inspection inspection;
  inspection.find = [newContacts](std::span<const compress::RoundedMesh> rounded) {
    std::set<std::size_t> meshes;
    for (const Contact& contact : newContacts(rounded)) meshes.insert(contact.mesh.begin(), contact.mesh.end());
    return std::vector<std::size_t>(meshes.begin(), meshes.end());
  };
  inspection.refuse = [&scene, newContacts](std::span<const compress::RoundedMesh> rounded) {
    const std::vector<Contact> contacts = newContacts(rounded);
    if (contacts.empty()) return;
    const Contact& first = contacts.front();
    double moved = 0;
    for (const std::size_t i : first.mesh)
      for (std::size_t v = 0; v < rounded[i].positions.size(); ++v)
        moved = std::max(moved, glm::distance(rounded[i].positions[v], scene.meshes[i].positions[v]));
    throw Error(
        "glass",
        fmt::format("rounding makes {} touch, with {} position bits", describe(scene, first),
                    std::max(rounded[first.mesh[0]].grid.positionBits, rounded[first.mesh[1]].grid.positionBits)),
        fmt::format("faces that are at least {:.2g} m apart, a smaller mesh, or more bits (--position-bits)",
                    2 * moved));
  };
  return inspection;
}

}  // namespace malus::bake

#include "bake/meshes/glass_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/shell_nesting.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::bake {

namespace {

constexpr std::size_t kSamples = 64;  // vertices of a body that are tested for being inside another one
constexpr double kInside = 0.75;      // winding number above which they are

// Positions as placed.
PositionsOf placedPositions(const pack::Scene& scene) {
  return [&scene](std::size_t i) -> const std::vector<glm::dvec3>& { return scene.meshes[i].positions; };
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
    pair.coincident += contact.isCoincident ? 1u : 0u;
  }
  return pairs;
}

// Returns true if a sampled vertex of `inner` is inside the glass of `outer`, which has this box.
bool isInside(const pack::Mesh& inner, const pack::Mesh& outer, const prep::Box& box) {
  prep::Shell shell;
  const std::size_t count = std::min(kSamples, inner.positions.size());
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec3& p = inner.positions[k * inner.positions.size() / count];
    if (!glm::all(glm::lessThan(box.low, p)) || !glm::all(glm::lessThan(p, box.high))) continue;
    if (shell.triangles.empty()) shell.triangles = outer.triangles;
    if (prep::windingNumber(shell, outer.positions, p) > kInside) return true;
  }
  return false;
}

// Reports bodies inside others with an index that does not fit. touching: pairs that are reported otherwise.
template <class Report>
void inspectNesting(const pack::Scene& scene, const GlassBodies& bodies,
                    const std::map<std::array<std::size_t, 2>, PairContacts>& touching, Report report) {
  const std::vector<prep::Box> boxes = meshBoxes(bodies, placedPositions(scene));
  const auto inspect = [&](std::size_t i, std::size_t j) {
    const pack::Mesh &inner = scene.meshes[bodies[i]], &outer = scene.meshes[bodies[j]];
    const double expected = scene.materials[outer.material].eta.y, found = scene.materials[inner.material].outsideEta;
    if (std::abs(expected - found) <= 1e-9 * expected || !isInside(inner, outer, boxes[j])) return;
    report(fmt::format("mesh '{}' is inside mesh '{}'", inner.name, outer.name),
           fmt::format("an outsideEta of {:g} in material '{}', or one mesh for a cavity", expected,
                       scene.materials[inner.material].name),
           fmt::format("{:g}", found));
  };
  for (const auto& [i, j] : overlappingPairs(boxes)) {
    if (touching.contains({bodies[i], bodies[j]})) continue;
    inspect(i, j);
    inspect(j, i);
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
  const Contacts contacts = findContactsBetween(scene, bodies, placedPositions(scene));
  if (!contacts.isComplete)
    warnings.emplace_back("glass: too many overlapping faces to find where bodies touch; cut long thin faces");
  const auto pairs = groupByPair(contacts.found);
  for (const auto& [meshes, pair] : pairs) {
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
  std::set<std::array<std::size_t, 2>> touching;
  for (const Contact& contact : findContactsBetween(scene, bodies, placedPositions(scene)).found)
    touching.insert(contact.mesh);

  const auto within = std::make_shared<ContactsWithin>();
  const auto newContacts = [&scene, bodies = std::move(bodies), touching,
                            within](std::span<const compress::RoundedMesh> rounded) {
    const PositionsOf positions = [&](std::size_t i) -> const std::vector<glm::dvec3>& { return rounded[i].positions; };
    std::vector<Contact> contacts = within->find(scene, bodies, positions);
    for (const Contact& contact : findContactsBetween(scene, bodies, positions).found)
      if (!touching.contains(contact.mesh)) contacts.push_back(contact);
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
    const compress::Grid &a = rounded[first.mesh[0]].grid, &b = rounded[first.mesh[1]].grid;
    const int bits = std::max(a.positionBits, b.positionBits);
    throw Error("glass", fmt::format("rounding makes {} touch, with {} position bits", describe(scene, first), bits),
                fmt::format("faces that are at least {:.2g} m apart, or a smaller mesh{}", 2 * std::max(a.step, b.step),
                            bits < compress::kMaxPositionBits ? ", or more bits (--position-bits)" : ""));
  };
  return inspection;
}

}  // namespace malus::bake

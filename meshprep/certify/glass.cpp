#include "meshprep/certify/glass.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/select.h"

namespace malus::prep {

namespace {

constexpr std::size_t kSamples = 256;           // tested triangles of an open surface, evenly chosen
constexpr std::uint64_t kMaxTests = 1u << 27u;  // budget of ray-triangle tests, which limits the samples

// Problems of one kind in one component: their number, and the location of the first.
struct Problems {
  std::uint64_t count = 0;
  std::string where;
  void add(std::string location) {
    if (count++ == 0) where = std::move(location);
  }
};
using ProblemsByComponent = std::map<std::uint32_t, Problems>;  // keys: components

std::string pointText(const glm::dvec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

void addProblems(const ProblemsByComponent& found, std::string_view one, std::string_view many, std::string_view repair,
                 Certificate& certificate) {
  for (const auto& [component, problem] : found)
    certificate.problems.push_back({component, fmt::format("{} {}", problem.count, problem.count == 1 ? one : many),
                                    problem.where, std::string(repair)});
}

ProblemsByComponent openEdges(const Mesh& mesh, const GlassEvidence& evidence) {
  ProblemsByComponent found;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    found[evidence.orientation.componentOf[edge[0].triangle]].add(
        fmt::format("first between {} and {}, face {}", pointText(mesh.positions[edge[0].low]),
                    pointText(mesh.positions[edge[0].high]), sourceFace(mesh, edge[0].triangle)));
  });
  return found;
}

ProblemsByComponent nonManifoldEdges(const Mesh& mesh, const GlassEvidence& evidence) {
  ProblemsByComponent found;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() < 3) return;
    found[evidence.orientation.componentOf[edge[0].triangle]].add(
        fmt::format("first between {} and {}, faces {}, {}, {}", pointText(mesh.positions[edge[0].low]),
                    pointText(mesh.positions[edge[0].high]), sourceFace(mesh, edge[0].triangle),
                    sourceFace(mesh, edge[1].triangle), sourceFace(mesh, edge[2].triangle)));
  });
  return found;
}

ProblemsByComponent pairsIn(const Mesh& mesh, const GlassEvidence& evidence,
                            const std::vector<Intersections::Pair>& pairs) {
  ProblemsByComponent found;
  for (const auto& [a, b] : pairs)
    found[evidence.orientation.componentOf[a]].add(fmt::format(
        "first near {}, faces {} and {}", pointText(centroid(mesh, a)), sourceFace(mesh, a), sourceFace(mesh, b)));
  return found;
}

// Returns true if the ray from p along d leaves through the front of triangle t.
bool leavesThrough(const Mesh& mesh, const glm::uvec3& t, const glm::dvec3& p, const glm::dvec3& d) {
  const glm::dvec3 a = mesh.positions[t.x] - p, b = mesh.positions[t.y] - p, c = mesh.positions[t.z] - p;
  // Signed volumes of the ray and the edges (Pluecker coordinates): equal signs inside.
  const double u = glm::dot(d, glm::cross(a, b)), v = glm::dot(d, glm::cross(b, c)), w = glm::dot(d, glm::cross(c, a));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, d);
  if (!(facing > 0) || u < 0 || v < 0 || w < 0) return false;
  return glm::dot(normal, a) > 0;
}

ProblemsByComponent withoutPartner(const Mesh& mesh, const GlassEvidence& evidence) {
  ProblemsByComponent found;
  const std::size_t count = mesh.triangles.size();
  const std::size_t samples =
      std::clamp<std::size_t>(static_cast<std::size_t>(kMaxTests / count), 1, std::min(kSamples, count));
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t at = i * count / samples;
    const glm::uvec3& t = mesh.triangles[at];
    const glm::dvec3 p = centroid(mesh, at);
    const glm::dvec3 inward = -glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    bool leaves = false;
    for (std::size_t j = 0; j < count && !leaves; ++j)
      leaves = j != at && leavesThrough(mesh, mesh.triangles[j], p, inward);
    if (!leaves)
      found[evidence.orientation.componentOf[at]].add(
          fmt::format("first behind {}, face {}", pointText(p), sourceFace(mesh, at)));
  }
  return found;
}

}  // namespace

Certificate certifyGlass(const Mesh& mesh, bool openSurface, const GlassEvidence& evidence) {
  Certificate certificate;
  certificate.checked = true;

  // Check orientation, of solids and open surfaces.
  ProblemsByComponent notOrientable, withoutVolume, nestedOutward;
  for (std::uint32_t i = 0; i < evidence.orientation.components.size(); ++i) {
    const Component& c = evidence.orientation.components[i];
    const std::string where = fmt::format("from face {} at {} on", c.firstFace, pointText(c.at));
    if (!c.orientable) notOrientable[i].add(where);
    if (c.closed && c.orientable && !c.hasVolume) withoutVolume[i].add(where);
    if (c.isNestedOutward) nestedOutward[i].add(where);
  }
  if (const std::uint64_t wrong = evidence.orientation.applied ? 0 : evidence.orientation.flipped.count; wrong > 0)
    certificate.problems.push_back(
        {0,
         wrong == 1 ? "1 face with the wrong orientation" : fmt::format("{} faces with the wrong orientation", wrong),
         "first: " + describe(evidence.orientation.flipped.first.front()), "do not skip the step orient"});
  addProblems(notOrientable, "surface that is not orientable", "surfaces that are not orientable",
              "cut the band where it twists", certificate);
  if (openSurface) {
    addProblems(withoutPartner(mesh, evidence), "sampled face without an opposite face",
                "sampled faces without an opposite face",
                "flip the faces so that both fronts point away from the glass, or add the opposite surface",
                certificate);
    return certificate;
  }

  // Check that components are closed, manifold, and have a volume.
  addProblems(openEdges(mesh, evidence), "open edge", "open edges",
              "fill the hole (--fill-holes), weld the seam (--weld), or declare an open surface (--open-surface)",
              certificate);
  addProblems(nonManifoldEdges(mesh, evidence), "edge of three or more faces", "edges of three or more faces",
              "do not skip the step fans", certificate);
  addProblems(withoutVolume, "closed surface without volume", "closed surfaces without volume",
              "remove the folded faces, or model the thickness", certificate);

  addProblems(nestedOutward, "solid inside a solid", "solids inside a solid",
              "flip its faces if it is a cavity; else make it a mesh with an outsideEta", certificate);

  // Check intersections and nesting.
  addProblems(pairsIn(mesh, evidence, evidence.intersections.crossing), "pair of faces that cross or touch",
              "pairs of faces that cross or touch", "move the parts apart, or join them into one surface", certificate);
  addProblems(pairsIn(mesh, evidence, evidence.intersections.coincident), "pair of coincident faces",
              "pairs of coincident faces", "remove the wall that two solids share", certificate);
  if (!evidence.intersections.complete)
    certificate.problems.push_back({0, "too many overlapping faces to test", "in the whole mesh",
                                    "cut long thin faces, or certify parts of the mesh"});
  if (evidence.orientation.nestingUnchecked > 0)
    certificate.problems.push_back({0, "too many closed components to find their nesting", "in the whole mesh",
                                    "split the mesh into files of fewer components"});
  return certificate;
}

}  // namespace malus::prep

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

constexpr std::size_t kSamples = 256;       // triangles of a sheet that are looked behind, evenly chosen
constexpr std::uint64_t kWork = 1u << 27u;  // ray and triangle tests, after which fewer samples are taken

// One kind of problem in one component: how often, and the first.
struct Found {
  std::uint64_t count = 0;
  std::string where;
  void add(std::string place) {
    if (count++ == 0) where = std::move(place);
  }
};
using FoundIn = std::map<std::uint32_t, Found>;  // by component

std::string pointText(const glm::dvec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

void report(const FoundIn& found, std::string_view one, std::string_view many, std::string_view repair,
            Certificate& certificate) {
  for (const auto& [component, problem] : found)
    certificate.problems.push_back({component, fmt::format("{} {}", problem.count, problem.count == 1 ? one : many),
                                    problem.where, std::string(repair)});
}

FoundIn openEdges(const Mesh& mesh, const GlassEvidence& evidence) {
  FoundIn found;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    found[evidence.sides.componentOf[edge[0].triangle]].add(
        fmt::format("first between {} and {}, face {}", pointText(mesh.positions[edge[0].low]),
                    pointText(mesh.positions[edge[0].high]), sourceFace(mesh, edge[0].triangle)));
  });
  return found;
}

FoundIn crowdedEdges(const Mesh& mesh, const GlassEvidence& evidence) {
  FoundIn found;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    if (edge.size() < 3) return;
    found[evidence.sides.componentOf[edge[0].triangle]].add(
        fmt::format("first between {} and {}, faces {}, {}, {}", pointText(mesh.positions[edge[0].low]),
                    pointText(mesh.positions[edge[0].high]), sourceFace(mesh, edge[0].triangle),
                    sourceFace(mesh, edge[1].triangle), sourceFace(mesh, edge[2].triangle)));
  });
  return found;
}

FoundIn pairsIn(const Mesh& mesh, const GlassEvidence& evidence, const std::vector<Intersections::Pair>& pairs) {
  FoundIn found;
  for (const auto& [a, b] : pairs)
    found[evidence.sides.componentOf[a]].add(fmt::format("first near {}, faces {} and {}", pointText(centroid(mesh, a)),
                                                         sourceFace(mesh, a), sourceFace(mesh, b)));
  return found;
}

// Where a ray from p along d meets triangle t, from behind: in front of p, leaving by the triangle's front.
bool leavesBy(const Mesh& mesh, const glm::uvec3& t, const glm::dvec3& p, const glm::dvec3& d) {
  const glm::dvec3 a = mesh.positions[t.x] - p, b = mesh.positions[t.y] - p, c = mesh.positions[t.z] - p;
  // Signed volumes of the ray with the three edges (Pluecker): all of one sign inside.
  const double u = glm::dot(d, glm::cross(a, b)), v = glm::dot(d, glm::cross(b, c)), w = glm::dot(d, glm::cross(c, a));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, d);
  if (!(facing > 0) || u < 0 || v < 0 || w < 0) return false;
  return glm::dot(normal, a) > 0;
}

FoundIn withoutPartner(const Mesh& mesh, const GlassEvidence& evidence) {
  FoundIn found;
  const std::size_t count = mesh.triangles.size();
  const std::size_t samples =
      std::clamp<std::size_t>(static_cast<std::size_t>(kWork / count), 1, std::min(kSamples, count));
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t at = i * count / samples;
    const glm::uvec3& t = mesh.triangles[at];
    const glm::dvec3 p = centroid(mesh, at);
    const glm::dvec3 inward = -glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    bool leaves = false;
    for (std::size_t j = 0; j < count && !leaves; ++j) leaves = j != at && leavesBy(mesh, mesh.triangles[j], p, inward);
    if (!leaves)
      found[evidence.sides.componentOf[at]].add(
          fmt::format("first behind {}, face {}", pointText(p), sourceFace(mesh, at)));
  }
  return found;
}

}  // namespace

Certificate certifyGlass(const Mesh& mesh, bool sheet, const GlassEvidence& evidence) {
  Certificate certificate;
  certificate.checked = true;

  // Step 1: sides, of bodies and sheets alike.
  FoundIn oneSided, hollow;
  for (std::uint32_t i = 0; i < evidence.sides.components.size(); ++i) {
    const Component& c = evidence.sides.components[i];
    const std::string where = fmt::format("from face {} at {} on", c.firstFace, pointText(c.at));
    if (!c.orientable) oneSided[i].add(where);
    if (c.closed && c.orientable && !c.hasVolume) hollow[i].add(where);
  }
  if (const std::uint64_t wrong = evidence.sides.applied ? 0 : evidence.sides.flipped.count; wrong > 0)
    certificate.problems.push_back(
        {0, wrong == 1 ? "1 face that looks the wrong way" : fmt::format("{} faces that look the wrong way", wrong),
         "first: " + describe(evidence.sides.flipped.first.front()), "let the cleaning turn them (orient)"});
  report(oneSided, "surface with one side alone", "surfaces with one side alone", "cut the band where it twists",
         certificate);
  if (sheet) {
    report(withoutPartner(mesh, evidence), "sampled face with nothing to leave by behind it",
           "sampled faces with nothing to leave by behind them",
           "turn the faces so that both fronts look away from the glass, or give the sheet its other side",
           certificate);
    return certificate;
  }

  // Step 2: closed, manifold, with an inside.
  report(openEdges(mesh, evidence), "open edge", "open edges",
         "close the hole (--fill-holes), weld the seam (--weld), or mark the mesh as a sheet", certificate);
  report(crowdedEdges(mesh, evidence), "edge of three or more faces", "edges of three or more faces",
         "let the cleaning split them (fans)", certificate);
  report(hollow, "closed surface without an inside", "closed surfaces without an inside",
         "take out the folded faces, or model the thickness", certificate);

  // Step 3: nothing in the way of anything.
  report(pairsIn(mesh, evidence, evidence.intersections.crossing), "pair of faces that cross or touch",
         "pairs of faces that cross or touch", "move the parts apart, or join them into one surface", certificate);
  report(pairsIn(mesh, evidence, evidence.intersections.coincident), "pair of faces in the same place",
         "pairs of faces in the same place", "take out the wall that two bodies share", certificate);
  if (!evidence.intersections.complete)
    certificate.problems.push_back({0, "too many overlapping faces to test them all", "in the whole mesh",
                                    "cut long thin faces, or test parts of the mesh"});
  if (evidence.sides.nestingUnchecked > 0)
    certificate.problems.push_back({0, "too many bodies to tell which lie in which", "in the whole mesh",
                                    "split the mesh into files of fewer bodies"});
  return certificate;
}

}  // namespace malus::prep

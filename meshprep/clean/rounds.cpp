#include "meshprep/clean/rounds.h"

#include <numeric>
#include <utility>
#include <vector>

#include "meshprep/clean/unreferenced_vertices.h"

namespace malus::prep {

namespace {

constexpr int kRounds = 12;  // two or three are enough for all but the strangest heaps of faces

Cleaned cleanOnce(Mesh& mesh, const Cleaning& steps) {
  Cleaned done;

  // Step 1: one vertex a place, then triangles that cover something, once.
  if (steps.weld) done.welded = weld(mesh, steps.weldTolerance);
  if (steps.duplicates) done.duplicates = dropDuplicateFaces(mesh, steps.dropOpposite);
  if (steps.degenerate) done.degenerate = dropDegenerateFaces(mesh);
  if (steps.duplicates && done.degenerate.changed()) {
    DuplicateFaces more = dropDuplicateFaces(mesh, steps.dropOpposite);
    done.duplicates.same.append(std::move(more.same));
    if (steps.dropOpposite) done.duplicates.opposite.append(std::move(more.opposite));
  }
  if (steps.unreferenced) done.unreferenced = dropUnreferencedVertices(mesh);
  if (mesh.triangles.empty()) return done;

  // Step 2: sides, fans, lids, and sides again where those joined what was apart.
  if (steps.orient) done.sides = orient(mesh, steps.sheet);
  if (steps.fans && steps.degenerate) done.fans = splitFans(mesh, steps.where);
  const std::vector<Loop> loops = findHoles(mesh);
  done.holes = describeHoles(mesh, loops);
  if (steps.fillHoles > 0) done.filled = fillHoles(mesh, loops, steps.fillHoles);
  if (steps.orient && (done.fans.changed() || done.filled.filled.count > 0)) done.sides = orient(mesh, steps.sheet);
  if (!steps.orient) {
    Mesh looked = mesh;
    done.sides = orient(looked, steps.sheet);
    done.sides.applied = false;
  }
  return done;
}

// The same as a reader would find it: every vertex and face is its own source. Names are given back afterwards.
Cleaned cleanAgain(Mesh& mesh, const Cleaning& steps) {
  const std::vector<std::uint32_t> vertices = mesh.sourceVertices, faces = mesh.sourceFaces;
  const std::vector<glm::uvec3> corners = mesh.sourceCorners;
  std::iota(mesh.sourceVertices.begin(), mesh.sourceVertices.end(), 0u);
  std::iota(mesh.sourceFaces.begin(), mesh.sourceFaces.end(), 0u);
  mesh.sourceCorners = mesh.triangles;
  Cleaned done = cleanOnce(mesh, steps);

  const auto vertexName = [&](std::uint32_t v) { return v == kNoSource ? v : vertices[v]; };
  for (std::uint32_t& v : mesh.sourceVertices) v = vertexName(v);
  for (std::uint32_t& f : mesh.sourceFaces) f = faces[f];
  for (glm::uvec3& t : mesh.sourceCorners) t = {vertexName(t.x), vertexName(t.y), vertexName(t.z)};
  for (Findings* findings : {&done.degenerate.repeatedCorner, &done.degenerate.zeroArea, &done.degenerate.neighboursCut,
                             &done.degenerate.edgesCollapsed, &done.duplicates.opposite, &done.duplicates.same,
                             &done.unreferenced, &done.filled.filled, &done.filled.left})
    for (Finding& finding : findings->first) {
      for (std::uint32_t& v : finding.vertices) v = vertexName(v);
      for (std::uint32_t& f : finding.faces) f = faces[f];
      std::erase(finding.vertices, kNoSource);
    }
  for (Component& component : done.sides.components) component.firstFace = faces[component.firstFace];
  return done;
}

}  // namespace

std::string cleaningStepNames() {
  std::string names;
  for (const auto& [name, step] : kCleaningSteps) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

Cleaned cleanInRounds(Mesh& mesh, const Cleaning& steps) {
  Cleaned first = cleanOnce(mesh, steps);
  // Without one of the steps, what it would take away comes back in every round.
  const bool all = steps.weld && steps.degenerate && steps.duplicates && steps.orient && steps.fans;
  first.settled = !all || !(first.fans.changed() || first.filled.filled.count > 0 || first.welded.refused.count > 0 ||
                            first.degenerate.edgesCollapsed.count > 0);
  for (int round = 0; round < kRounds && !first.settled && !mesh.triangles.empty(); ++round) {
    const std::vector<glm::dvec3> positions = mesh.positions;
    const std::vector<glm::uvec3> triangles = mesh.triangles;
    Cleaned again = cleanAgain(mesh, steps);
    first.settled = mesh.positions == positions && mesh.triangles == triangles;
    first.degenerate.repeatedCorner.append(std::move(again.degenerate.repeatedCorner));
    first.degenerate.zeroArea.append(std::move(again.degenerate.zeroArea));
    first.degenerate.edgesCollapsed.append(std::move(again.degenerate.edgesCollapsed));
    first.degenerate.neighboursCut.append(std::move(again.degenerate.neighboursCut));
    if (steps.dropOpposite) first.duplicates.opposite.append(std::move(again.duplicates.opposite));
    first.duplicates.same.append(std::move(again.duplicates.same));
    first.unreferenced.append(std::move(again.unreferenced));
    first.fans.cutEdges += again.fans.cutEdges;
    first.filled.filled.append(std::move(again.filled.filled));
    first.filled.left = std::move(again.filled.left);
    first.sides = std::move(again.sides);
  }
  return first;
}

}  // namespace malus::prep

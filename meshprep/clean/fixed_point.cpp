#include "meshprep/clean/fixed_point.h"

#include <numeric>
#include <utility>
#include <vector>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/unreferenced_vertices.h"

namespace malus::prep {

namespace {

constexpr int kMaxPasses = 12;  // two or three suffice except for random triangles

Cleaned cleanOnce(Mesh& mesh, const Cleaning& steps) {
  Cleaned done;

  // Weld vertices, then drop duplicate and degenerate faces.
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

  // Orient, split fans, fill holes, and orient again if these changed connectivity.
  std::vector<EdgeUse> edges = edgeUses(mesh.triangles);
  if (steps.orient) done.orientation = orient(mesh, steps.openSurface, edges);
  if (done.orientation.flipped.count > 0) edges = edgeUses(mesh.triangles);
  if (steps.fans && steps.degenerate) done.fans = splitFans(mesh, edges, steps.where);
  if (done.fans.changed()) edges = edgeUses(mesh.triangles);
  const std::vector<Loop> loops = findHoles(edges);
  done.holes = describeHoles(mesh, loops);
  if (steps.fillHoles > 0) done.filled = fillHoles(mesh, loops, steps.fillHoles);
  if (steps.orient && (done.fans.changed() || done.filled.filled.count > 0))
    done.orientation = orient(mesh, steps.openSurface);
  if (!steps.orient) {
    Mesh copy = mesh;
    done.orientation = orient(copy, steps.openSurface);
    done.orientation.applied = false;
  }
  return done;
}

// Cleans a mesh as if it was read from a file, in which every vertex and face is its own source. Restores the sources.
Cleaned cleanAgain(Mesh& mesh, const Cleaning& steps) {
  const std::vector<std::uint32_t> vertices = mesh.sourceVertices, faces = mesh.sourceFaces;
  const std::vector<glm::uvec3> corners = mesh.sourceCorners;
  std::iota(mesh.sourceVertices.begin(), mesh.sourceVertices.end(), 0u);
  std::iota(mesh.sourceFaces.begin(), mesh.sourceFaces.end(), 0u);
  mesh.sourceCorners = mesh.triangles;
  Cleaned done = cleanOnce(mesh, steps);

  const auto sourceName = [&](std::uint32_t v) { return v == kNoSource ? v : vertices[v]; };
  for (std::uint32_t& v : mesh.sourceVertices) v = sourceName(v);
  for (std::uint32_t& f : mesh.sourceFaces) f = faces[f];
  for (glm::uvec3& t : mesh.sourceCorners) t = {sourceName(t.x), sourceName(t.y), sourceName(t.z)};
  for (Findings* findings : {&done.degenerate.repeatedCorner, &done.degenerate.zeroArea, &done.degenerate.neighboursCut,
                             &done.degenerate.edgesCollapsed, &done.duplicates.opposite, &done.duplicates.same,
                             &done.unreferenced, &done.filled.filled, &done.filled.left})
    for (Finding& finding : findings->first) {
      for (std::uint32_t& v : finding.vertices) v = sourceName(v);
      for (std::uint32_t& f : finding.faces) f = faces[f];
      std::erase(finding.vertices, kNoSource);
    }
  for (Component& component : done.orientation.components) component.firstFace = faces[component.firstFace];
  return done;
}

}  // namespace

std::string cleaningStepNames() {
  std::string names;
  for (const auto& [name, step] : kCleaningSteps) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

Cleaned cleanToFixedPoint(Mesh& mesh, const Cleaning& steps) {
  Cleaned first = cleanOnce(mesh, steps);
  // If a step is skipped, its defects remain in every pass.
  const bool all = steps.weld && steps.degenerate && steps.duplicates && steps.orient && steps.fans;
  const bool nearWelds = steps.weldTolerance > 0 && first.welded.joined.count > 0;
  const bool flippedDoubled = first.duplicates.opposite.count > 0 && first.orientation.flipped.count > 0;
  first.converged = !all || !(first.fans.changed() || first.filled.filled.count > 0 || first.welded.refused.count > 0 ||
                              first.degenerate.changed() || nearWelds || flippedDoubled);
  for (int pass = 0; pass < kMaxPasses && !first.converged && !mesh.triangles.empty(); ++pass) {
    const std::vector<glm::dvec3> positions = mesh.positions;
    const std::vector<glm::uvec3> triangles = mesh.triangles;
    Cleaned again = cleanAgain(mesh, steps);
    first.converged = mesh.positions == positions && mesh.triangles == triangles;
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
    first.orientation = std::move(again.orientation);
  }
  return first;
}

}  // namespace malus::prep

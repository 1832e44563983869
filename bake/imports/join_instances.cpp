#include "bake/imports/join_instances.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "bake/imports/open_edges.h"
#include "meshprep/clean/disjoint_sets.h"

namespace malus::bake {

namespace {

using prep::Polygons;
using prep::SourceInstance;
using prep::SourceScene;

// Of the largest coordinate: four times the rounding error of floats.
constexpr double kPlacementTolerance = 0x1p-22;

// Indices of the instances that are glass bodies with open edges, by material of the scene.
std::map<std::uint32_t, std::vector<std::size_t>> findOpenInstances(const SourceScene& source,
                                                                    const std::vector<PartUse>& uses,
                                                                    const prep::Options& preparation) {
  std::vector<char> isOpen(source.parts.size(), 0);
  for (std::size_t i = 0; i < source.parts.size(); ++i) {
    if (!uses[i].isGlassBody) continue;
    const Polygons* const polygons = &source.parts[i].polygons;
    isOpen[i] = findOpenEdges({&polygons, 1}, preparation).counts[0] > 0 ? 1 : 0;
  }
  std::map<std::uint32_t, std::vector<std::size_t>> instances;
  for (std::size_t i = 0; i < source.instances.size(); ++i) {
    const std::size_t part = source.instances[i].part;
    if (isOpen[part] != 0) instances[uses[part].material].push_back(i);
  }
  return instances;
}

// Sets the positions of vertices at shared open edges to those of the welded mesh. polygons: the pieces, one after the
// other. firstVertex: of each piece of `edges`, for those that are in the polygons.
void snapVertices(const OpenEdges& edges, const std::map<std::size_t, std::size_t>& firstVertex, Polygons& polygons) {
  for (std::size_t i = 0; i < edges.mesh.triangles.size(); ++i) {
    const auto first = firstVertex.find(edges.pieceOf[i]);
    if (first == firstVertex.end()) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = edges.mesh.triangles[i][k];
      if (edges.isShared[v] != 0) polygons.positions[first->second + edges.corners[i][k]] = edges.mesh.positions[v];
    }
  }
}

std::string describeJoined(const SourceScene& source, const std::vector<std::size_t>& instances,
                           const std::string& material) {
  std::vector<std::string> names;
  names.reserve(instances.size());
  for (const std::size_t i : instances) names.push_back(fmt::format("'{}'", source.instances[i].name));
  return fmt::format("joined parts {}: one body of material '{}'", listNames(names), material);
}

}  // namespace

std::vector<std::string> joinInstances(SourceScene& source, std::vector<PartUse>& uses,
                                       const prep::Options& preparation) {
  std::vector<std::string> notes;
  if (!preparation.steps.weld) return notes;
  std::vector<char> isJoined(source.instances.size(), 0);
  for (const auto& [material, instances] : findOpenInstances(source, uses, preparation)) {
    // Connect the pieces.
    std::vector<Polygons> placed;
    std::vector<const Polygons*> pieces;
    placed.reserve(instances.size());
    for (const std::size_t i : instances) {
      placed.push_back(mergeInstances(source, {&i, 1}));
      pieces.push_back(&placed.back());
    }
    const OpenEdges edges = findOpenEdges(pieces, preparation, kPlacementTolerance);
    prep::DisjointSets sets(pieces.size());
    for (const Neighbours& pair : edges.neighbours)
      sets.merge(static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b));
    std::map<std::uint32_t, std::vector<std::size_t>> bodies;  // pieces
    for (std::uint32_t i = 0; i < pieces.size(); ++i) bodies[sets.find(i)].push_back(i);

    // Make a part of each body.
    for (const auto& [first, body] : bodies) {
      if (body.size() == 1) continue;
      std::vector<std::size_t> members;
      std::map<std::size_t, std::size_t> firstVertex;
      std::size_t vertices = 0;
      for (const std::size_t piece : body) {
        members.push_back(instances[piece]);
        firstVertex[piece] = std::exchange(vertices, vertices + pieces[piece]->positions.size());
      }
      notes.push_back(describeJoined(source, members, uses[source.instances[members[0]].part].materialName));
      prep::SourcePart joined;
      SourceInstance& instance = source.instances[members[0]];
      joined.name = instance.name;
      joined.material = source.parts[instance.part].material;
      joined.polygons = mergeInstances(source, members);
      joined.polygons.notes.clear();
      joined.polygons.partOf.clear();
      joined.polygons.parts.clear();
      snapVertices(edges, firstVertex, joined.polygons);
      uses.push_back(uses[instance.part]);
      instance.part = source.parts.size();
      instance.worldFromObject = glm::dmat4(1.0);
      source.parts.push_back(std::move(joined));
      for (std::size_t i = 1; i < members.size(); ++i) isJoined[members[i]] = 1;
    }
  }
  std::size_t index = 0;
  std::erase_if(source.instances, [&](const SourceInstance&) { return isJoined[index++] != 0; });
  return notes;
}

}  // namespace malus::bake

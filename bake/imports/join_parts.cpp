#include "bake/imports/join_parts.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "bake/imports/open_edges.h"
#include "meshprep/clean/disjoint_sets.h"

namespace malus::bake {

namespace {

using prep::Polygons;
using prep::SourcePart;
using prep::SourceScene;

constexpr std::size_t kNamed = 8;  // parts named in a note

// Transforms of the instances of each part, in their order.
std::vector<std::vector<double>> placements(const SourceScene& source) {
  std::vector<std::vector<double>> result(source.parts.size());
  for (const prep::SourceInstance& instance : source.instances)
    for (int i = 0; i < 16; ++i) result[instance.part].push_back(instance.worldFromObject[i / 4][i % 4]);
  return result;
}

// Returns the pairs of these parts, by their indices, that share open edges.
std::vector<Neighbours> findNeighbours(const SourceScene& source, const std::vector<std::size_t>& parts,
                                       const prep::Options& preparation) {
  std::vector<const Polygons*> pieces;
  pieces.reserve(parts.size());
  for (const std::size_t part : parts) pieces.push_back(&source.parts[part].polygons);
  std::vector<Neighbours> neighbours = findOpenEdges(pieces, preparation).neighbours;
  for (Neighbours& pair : neighbours) pair.a = parts[pair.a], pair.b = parts[pair.b];
  return neighbours;
}

// Appends one value per element: those of the source, or `none` if only one of the two has the attribute.
template <class T>
void appendAttribute(std::vector<T>& to, std::size_t before, const std::vector<T>& from, std::size_t added,
                     const T& none) {
  if (to.empty() && from.empty()) return;
  to.resize(before, none);
  to.insert(to.end(), from.begin(), from.end());
  to.resize(before + added, none);
}

// Moves the faces of a part to another one.
void moveFaces(SourcePart& to, SourcePart& from) {
  Polygons& a = to.polygons;
  const Polygons& b = from.polygons;
  const std::size_t vertices = a.positions.size(), corners = a.corners.size(), faces = a.faceCount();
  appendAttribute(a.normals, vertices, b.normals, b.positions.size(), glm::vec3(0));
  appendAttribute(a.cornerNormals, corners, b.cornerNormals, b.corners.size(), glm::vec3(0));
  for (std::size_t set = 0; set < a.textureCoordinates.size(); ++set)
    appendAttribute(a.textureCoordinates[set], corners, b.textureCoordinates[set], b.corners.size(), glm::vec2(0));
  appendAttribute(a.tangents, corners, b.tangents, b.corners.size(), glm::vec4(0, 0, 0, 1));
  appendAttribute(a.smoothingGroups, faces, b.smoothingGroups, b.faceCount(), 0u);
  if (a.vertexLocations.size() == vertices && b.vertexLocations.size() == b.positions.size())
    a.vertexLocations.insert(a.vertexLocations.end(), b.vertexLocations.begin(), b.vertexLocations.end());
  if (a.faceLocations.size() == faces && b.faceLocations.size() == b.faceCount())
    a.faceLocations.insert(a.faceLocations.end(), b.faceLocations.begin(), b.faceLocations.end());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (std::size_t f = 0; f < b.faceCount(); ++f) {
    for (const std::uint32_t corner : b.face(f)) a.corners.push_back(static_cast<std::uint32_t>(vertices + corner));
    a.closeFace();
  }
  a.partOf.clear();
  a.parts.clear();
  to.fileVertices.insert(to.fileVertices.end(), from.fileVertices.begin(), from.fileVertices.end());
  to.fileFaces.insert(to.fileFaces.end(), from.fileFaces.begin(), from.fileFaces.end());
  from.polygons = {};
  from.fileVertices.clear();
  from.fileFaces.clear();
}

// Joins the parts into the first one. Returns the note.
std::string join(SourceScene& source, const std::vector<std::size_t>& parts, const std::string& material) {
  // Describe the parts.
  SourcePart& first = source.parts[parts.front()];
  const bool oneMesh = first.mesh && std::all_of(parts.begin(), parts.end(),
                                                 [&](std::size_t p) { return source.parts[p].mesh == first.mesh; });
  std::vector<std::string> names;
  names.reserve(parts.size());
  for (const std::size_t p : parts)
    names.push_back(oneMesh ? fmt::to_string(source.parts[p].primitive) : fmt::format("'{}'", source.parts[p].name));
  const std::string which = oneMesh ? fmt::format("primitives {} of mesh '{}'", listNames(names), first.meshName)
                                    : fmt::format("parts {}", listNames(names));
  std::string note = fmt::format("joined {}: one body of material '{}'", which, material);

  // Name the body after its mesh and nodes if it is the whole mesh.
  const std::size_t ofMesh =
      first.mesh
          ? static_cast<std::size_t>(std::count_if(source.parts.begin(), source.parts.end(),
                                                   [&](const SourcePart& part) { return part.mesh == first.mesh; }))
          : 0;
  if (oneMesh && ofMesh == parts.size()) {
    first.name = first.meshName;
    for (prep::SourceInstance& instance : source.instances)
      if (instance.part == parts.front()) instance.name = instance.node;
  }

  for (std::size_t i = 1; i < parts.size(); ++i) moveFaces(first, source.parts[parts[i]]);
  return note;
}

}  // namespace

std::string listNames(const std::vector<std::string>& names) {
  std::string result;
  const std::size_t count = std::min(names.size(), kNamed);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) result += i + 1 == names.size() ? " and " : ", ";
    result += names[i];
  }
  return count == names.size() ? result : fmt::format("{} and {} more", result, names.size() - count);
}

std::vector<std::string> joinParts(SourceScene& source, const std::vector<PartUse>& uses,
                                   const prep::Options& preparation) {
  std::vector<std::string> notes;
  if (!preparation.steps.weld) return notes;

  // Group the candidates by material and placements.
  std::map<std::pair<std::uint32_t, std::vector<double>>, std::vector<std::size_t>> groups;
  const std::vector<std::vector<double>> placed = placements(source);
  for (std::size_t i = 0; i < source.parts.size(); ++i)
    if (uses[i].isGlassBody && !placed[i].empty()) groups[{uses[i].material, placed[i]}].push_back(i);

  // Join the connected parts of each group.
  std::vector<char> isJoined(source.parts.size(), 0);
  prep::DisjointSets bodies(source.parts.size());
  for (const auto& [key, parts] : groups)
    if (parts.size() > 1)
      for (const Neighbours& pair : findNeighbours(source, parts, preparation))
        bodies.merge(static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b));
  std::map<std::size_t, std::vector<std::size_t>> partsOfBody;
  for (std::size_t i = 0; i < source.parts.size(); ++i)
    partsOfBody[bodies.find(static_cast<std::uint32_t>(i))].push_back(i);
  for (const auto& [body, parts] : partsOfBody) {
    if (parts.size() == 1) continue;
    notes.push_back(join(source, parts, uses[body].materialName));
    for (std::size_t i = 1; i < parts.size(); ++i) isJoined[parts[i]] = 1;
  }
  std::erase_if(source.instances, [&](const prep::SourceInstance& instance) { return isJoined[instance.part] != 0; });
  return notes;
}

std::optional<prep::Problem> findSpreadBody(const SourceScene& source, const std::vector<PartUse>& uses,
                                            std::size_t part, const prep::Options& preparation) {
  const std::vector<std::vector<double>> placed = placements(source);
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < source.parts.size(); ++i)
    if (placed[i] == placed[part]) parts.push_back(i);
  for (const Neighbours& pair : findNeighbours(source, parts, preparation)) {
    if (pair.a != part && pair.b != part) continue;
    const std::size_t other = pair.a == part ? pair.b : pair.a;
    if (uses[other].material == uses[part].material) continue;
    const auto pointText = [](const glm::dvec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); };
    return prep::Problem{
        0,
        fmt::format("the body is spread over parts of different materials: part '{}' of material '{}' shares {} open "
                    "{} with part '{}' of material '{}'",
                    source.parts[part].name, uses[part].materialName, pair.edges, pair.edges == 1 ? "edge" : "edges",
                    source.parts[other].name, uses[other].materialName),
        fmt::format("first between {} and {}", pointText(pair.low), pointText(pair.high)),
        "give the parts one material (key 'materials' of the import)"};
  }
  return std::nullopt;
}

}  // namespace malus::bake

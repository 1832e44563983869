#include "bake/diff.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/pack/format.h"
#include "bake/scene_json.h"
#include "meshprep/base/text.h"
#include "meshprep/json_text.h"

namespace malus::bake {
using nlohmann::json;

namespace {

// Turns a list of elements with unique names into an object, so that an added element does not shift the others.
json keyed(const json& value) {
  if (value.is_object()) {
    json result = json::object();
    for (const auto& [key, item] : value.items()) result[key] = keyed(item);
    return result;
  }
  if (!value.is_array()) return value;
  std::set<std::string> names;
  for (const json& item : value)
    if (item.is_object() && item.contains("name") && item["name"].is_string()) names.insert(item["name"]);
  const bool named = !value.empty() && names.size() == value.size();
  json result = json::object();
  for (std::size_t i = 0; i < value.size(); ++i) {
    json item = keyed(value[i]);
    if (named) item.erase("name");
    result[named ? value[i]["name"].get<std::string>() : fmt::format("{}", i)] = std::move(item);
  }
  return result;
}

// Collects the leaves by their path.
void flatten(const json& value, const std::string& where, std::map<std::string, json>& leaves) {
  if (value.is_object() && !value.empty()) {
    for (const auto& [key, item] : value.items())
      flatten(item, where.empty() ? key : fmt::format("{}.{}", where, key), leaves);
  } else {
    leaves[where] = value;
  }
}

std::map<std::string, json> collectLeaves(const pack::Pack& pack) {
  json document = sceneJson(pack);
  document.erase("packHash");
  document["meshes"] = keyed(document["meshes"]);
  if (document.contains("instances")) document["instances"] = keyed(document["instances"]);
  for (json& mesh : document["meshes"]) mesh.erase("file"), mesh.erase("map");
  document["effects"] = effectsJson(pack.scene.effects);
  document["provenance"] = provenanceJson(pack.scene);
  for (std::size_t i = 0; i < pack.compression.size(); ++i)
    document["encoding"][pack.scene.meshes[i].name] = pack.compression[i];
  std::map<std::string, json> leaves;
  flatten(keyed(document), "", leaves);
  return leaves;
}

std::uint64_t hashMesh(const pack::Mesh& mesh) {
  pack::Scene alone;
  alone.meshes = {mesh};
  return pack::canonicalGeometryHash(alone);
}

// Describes how the attributes of two meshes with the same positions and triangles differ.
std::string describeAttributes(const pack::Mesh& a, const pack::Mesh& b) {
  if (a.normals != b.normals) return "other normals";
  if (a.tangents != b.tangents) return "other tangents";
  double farthest = 0;
  for (std::size_t set = 0; set < a.textureCoordinates.size(); ++set) {
    const std::vector<glm::vec2>&from = a.textureCoordinates[set], &to = b.textureCoordinates[set];
    if (from.size() != to.size()) return "other sets of texture coordinates";
    for (std::size_t i = 0; i < from.size(); ++i)
      farthest = std::max(farthest, glm::distance(glm::dvec2(from[i]), glm::dvec2(to[i])));
  }
  return fmt::format("texture coordinates moved by up to {:.3g}", farthest);
}

// Adds the meshes whose geometry differs.
void compareGeometry(const pack::Scene& a, const pack::Scene& b, json& changes) {
  for (const pack::Mesh& mesh : a.meshes) {
    const auto other =
        std::find_if(b.meshes.begin(), b.meshes.end(), [&](const pack::Mesh& m) { return m.name == mesh.name; });
    if (other == b.meshes.end() || hashMesh(mesh) == hashMesh(*other)) continue;
    const std::string where = fmt::format("geometry.{}", mesh.name);
    if (mesh.triangles != other->triangles || mesh.positions.size() != other->positions.size()) {
      changes.push_back({{"where", where},
                         {"a", fmt::format("{:016x}", hashMesh(mesh))},
                         {"b", fmt::format("{:016x}", hashMesh(*other))}});
      continue;
    }
    double farthest = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      farthest = std::max(farthest, glm::distance(mesh.positions[i], other->positions[i]));
    changes.push_back({{"where", where},
                       {"a", "the same triangles"},
                       {"b", farthest > 0 ? fmt::format("corners moved by up to {:.3g} m", farthest)
                                          : describeAttributes(mesh, *other)}});
  }
}

// Adds the meshes whose map to the source differs.
void compareMaps(const pack::Scene& a, const pack::Scene& b, json& changes) {
  const auto kept = [](const pack::Mesh& mesh) { return mesh.sourceVertices.empty() ? "not kept" : "kept"; };
  for (const pack::Mesh& mesh : a.meshes) {
    const auto other =
        std::find_if(b.meshes.begin(), b.meshes.end(), [&](const pack::Mesh& m) { return m.name == mesh.name; });
    if (other == b.meshes.end() ||
        (mesh.sourceVertices == other->sourceVertices && mesh.sourceFaces == other->sourceFaces))
      continue;
    const bool both = !mesh.sourceVertices.empty() && !other->sourceVertices.empty();
    changes.push_back({{"where", fmt::format("sourceMap.{}", mesh.name)},
                       {"a", kept(mesh)},
                       {"b", both ? "other vertices or faces" : kept(*other)}});
  }
}

}  // namespace

json diffJson(const pack::Pack& a, const pack::Pack& b) {
  json sections = json::array(), changes = json::array();
  const auto find = [](const pack::Pack& pack, const std::string& id) -> const pack::Section* {
    for (const pack::Section& s : pack.sections)
      if (s.id == id) return &s;
    return nullptr;
  };
  for (const pack::Section& s : a.sections) {
    const pack::Section* other = find(b, s.id);
    if (!other)
      sections.push_back({{"id", s.id}, {"change", "only in the first"}, {"sizeBytes", {s.sizeBytes, nullptr}}});
    else if (s.hash != other->hash || s.sizeBytes != other->sizeBytes || s.version != other->version)
      sections.push_back({{"id", s.id}, {"change", "changed"}, {"sizeBytes", {s.sizeBytes, other->sizeBytes}}});
  }
  for (const pack::Section& s : b.sections)
    if (!find(a, s.id))
      sections.push_back({{"id", s.id}, {"change", "only in the second"}, {"sizeBytes", {nullptr, s.sizeBytes}}});

  const std::map<std::string, json> before = collectLeaves(a), after = collectLeaves(b);
  for (const auto& [where, value] : before) {
    const auto found = after.find(where);
    if (found == after.end())
      changes.push_back({{"where", where}, {"a", value}, {"b", nullptr}});
    else if (found->second != value)
      changes.push_back({{"where", where}, {"a", value}, {"b", found->second}});
  }
  for (const auto& [where, value] : after)
    if (!before.contains(where)) changes.push_back({{"where", where}, {"a", nullptr}, {"b", value}});
  if (a.scene.environment.texels != b.scene.environment.texels)
    changes.push_back({{"where", "environment.texels"},
                       {"a", a.scene.environment.texels.size()},
                       {"b", b.scene.environment.texels.size()}});
  for (std::size_t i = 0; i < std::min(a.scene.textures.size(), b.scene.textures.size()); ++i)
    if (a.scene.textures[i].texels != b.scene.textures[i].texels)
      changes.push_back({{"where", fmt::format("textures.{}.texels", a.scene.textures[i].name)},
                         {"a", a.scene.textures[i].texels.size()},
                         {"b", b.scene.textures[i].texels.size()}});
  compareGeometry(a.scene, b.scene, changes);
  compareMaps(a.scene, b.scene, changes);
  return {{"equal", a.hash == b.hash && sections.empty()}, {"sections", sections}, {"changes", changes}};
}

std::string diffText(const json& difference) {
  if (difference.at("equal")) return "the packs are equal\n";
  const auto text = [](const json& value) { return value.is_null() ? std::string("-") : jsonText(value, -1); };
  std::string result = "sections\n";
  for (const json& s : difference.at("sections"))
    result += fmt::format("  {}  {:<20} {} -> {} bytes\n", s.at("id").get<std::string>(),
                          s.at("change").get<std::string>(), text(s.at("sizeBytes")[0]), text(s.at("sizeBytes")[1]));
  result += "changes\n";
  for (const json& c : difference.at("changes"))
    result +=
        fmt::format("  {}: {} -> {}\n", printable(c.at("where").get<std::string>()), text(c.at("a")), text(c.at("b")));
  return result;
}

}  // namespace malus::bake

#include "bake/imports/import.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/imports/join_instances.h"
#include "bake/imports/join_parts.h"
#include "bake/materials/material_maps.h"
#include "bake/materials/source_material.h"
#include "bake/materials/texture_means.h"
#include "bake/pack/format.h"
#include "bake/pack/mesh_maps.h"
#include "bake/placement/placement.h"
#include "bake/scene_file/strict_object.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "meshprep/prepare.h"
#include "meshprep/read/counted_note.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

namespace {

constexpr std::size_t kMaxNameBytes = 200;

// Shortens a name to kMaxNameBytes at most, at a boundary of UTF-8 characters.
std::string shortened(std::string name) {
  if (name.size() <= kMaxNameBytes) return name;
  std::size_t end = kMaxNameBytes;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0u) == 0x80u) --end;
  name.resize(end);
  return name;
}

[[noreturn]] void failUnknown(const ImportDescription& description, std::string_view what, std::string_view key,
                              const std::string& name, const std::vector<std::string>& names) {
  const std::string near = nearestName(name, names);
  throw Error(description.file.string(), fmt::format("has no {} '{}', which '{}' of the import names", what, name, key),
              near.empty() ? fmt::format("one of its {}", names.size()) : fmt::format("'{}'", near));
}

// Indices of the file's materials in the scene, which are made at their first use.
class MaterialIndices {
 public:
  // factors: the materials of the source before the means of their images were applied.
  MaterialIndices(const ImportDescription& description, const prep::SourceScene& source,
                  const std::vector<prep::SourceMaterial>& factors, std::vector<pack::Material>& materials,
                  UniqueNames& names, MaterialMaps& maps)
      : description_(description),
        source_(source),
        factors_(factors),
        materials_(materials),
        names_(names),
        maps_(maps) {
    std::vector<std::string> known = {""};
    for (const prep::SourceMaterial& material : source.materials) known.push_back(material.name);
    for (const auto& [name, ignored] : description.materials)
      if (std::find(known.begin(), known.end(), name) == known.end())
        failUnknown(description, "material", "materials", name, known);
  }

  std::uint32_t of(const std::optional<std::size_t>& material) {
    const std::size_t key = material ? *material : source_.materials.size();
    const auto found = made_.find(key);
    if (found != made_.end()) return found->second;
    return made_[key] = find(material);
  }

  // The material of the opaque texels of a material of the scene that the rules made two of (MaterialMaps::split()).
  std::optional<std::uint32_t> opaqueTexels(std::uint32_t material) const {
    const auto found = opaque_.find(material);
    return found == opaque_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::uint32_t find(const std::optional<std::size_t>& material) {
    // Use the material that the scene names.
    const std::string name = material ? source_.materials[*material].name : std::string();
    if (const auto mapped = description_.materials.find(name); mapped != description_.materials.end()) {
      std::uint32_t index = 0;
      while (materials_[index].name != mapped->second) ++index;  // present: checked by the reader of the scene file
      return index;
    }

    // Convert it by the rules.
    if (!material) return add(defaultMaterial(), material);
    const prep::SourceMaterial factors = readableFactors(*material);
    const prep::SourceMaterial& means = source_.materials[*material];
    if (auto split = maps_.split(factors, means)) {
      const std::uint32_t clear = add(std::move(split->clear), material);
      split->opaque.name = fmt::format("{} (opaque)", materials_[clear].name);
      opaque_[clear] = add(std::move(split->opaque), material);
      return clear;
    }
    return add(maps_.convert(factors, means), material);
  }

  // Without the images that cannot be read.
  prep::SourceMaterial readableFactors(std::size_t index) const {
    const prep::SourceMaterial& means = source_.materials[index];
    prep::SourceMaterial factors = factors_[index];
    factors.baseColourImage = means.baseColourImage;
    factors.metallicRoughnessImage = means.metallicRoughnessImage;
    factors.emissiveImage = means.emissiveImage;
    factors.normalImage = means.normalImage;
    factors.coverageImage = means.coverageImage;
    factors.specularGlossinessImage = means.specularGlossinessImage;
    factors.transmissionImage = means.transmissionImage;
    return factors;
  }

  std::uint32_t add(pack::Material made, const std::optional<std::size_t>& material) {
    if (materials_.size() >= pack::kMaxMaterials)
      throw Error(description_.file.string(), "has too many materials",
                  fmt::format("at most {} in a scene", pack::kMaxMaterials));
    if (made.name.empty()) made.name = fmt::format("material {}", *material);
    made.name = names_.take(made.name);
    materials_.push_back(std::move(made));
    return static_cast<std::uint32_t>(materials_.size() - 1);
  }

  const ImportDescription& description_;
  const prep::SourceScene& source_;
  const std::vector<prep::SourceMaterial>& factors_;
  std::vector<pack::Material>& materials_;
  UniqueNames& names_;
  MaterialMaps& maps_;
  std::map<std::size_t, std::uint32_t> made_;
  std::map<std::uint32_t, std::uint32_t> opaque_;
};

// Removes the instances of parts whose material is not drawn, unless the scene replaces it. Throws Error if none is
// left.
void removeInvisible(const ImportDescription& description, prep::SourceScene& source) {
  const auto isHidden = [&](const prep::SourceInstance& instance) {
    const std::optional<std::size_t> material = source.parts[instance.part].material;
    return material && isInvisible(source.materials[*material]) &&
           !description.materials.contains(source.materials[*material].name);
  };
  const std::size_t removed = std::erase_if(source.instances, isHidden);
  if (removed == 0) return;
  if (source.instances.empty())
    throw Error(description.file.string(), "every surface is invisible by the alpha of its material",
                "a material with more alpha, or one of the scene in 'materials'");
  prep::addNote(source.notes, fmt::format("surfaces that are invisible by the alpha of their material ({})", removed));
}

// Drops the texture coordinates and tangents of parts whose material has no images, or is replaced by one of the scene.
void dropUnusedTextures(const ImportDescription& description, prep::SourceScene& source) {
  bool anyDropped = false;
  for (prep::SourcePart& part : source.parts) {
    prep::Polygons& polygons = part.polygons;
    if (!polygons.hasTextureAttributes()) continue;
    prep::TextureNeeds needs;
    if (part.material && !description.materials.contains(source.materials[*part.material].name))
      needs = prep::textureNeeds(source.materials[*part.material]);
    for (std::size_t set = 0; set < needs.coordinates.size(); ++set) {
      anyDropped = anyDropped || (!needs.coordinates[set] && !polygons.textureCoordinates[set].empty());
      if (!needs.coordinates[set]) polygons.textureCoordinates[set].clear();
    }
    if (!needs.tangents) polygons.tangents.clear();
  }
  if (anyDropped) prep::addNote(source.notes, std::string(prep::kUnusedCoordinatesNote));
}

// factors: the materials before the means of their images are applied.
prep::SourceScene readSource(const ImportDescription& description, bool strict,
                             std::vector<prep::SourceMaterial>& factors) {
  prep::SourceScene source = prep::readSourceScene(description.file, strict, true);
  factors = source.materials;
  applyTextureMeans(source, strict);
  dropUnusedTextures(description, source);
  removeInvisible(description, source);
  return source;
}

// Notes the parts without the coordinates or tangents that the maps of their materials are read by.
void noteMissingAttributes(prep::SourceScene& source, const std::vector<PartUse>& uses,
                           const std::vector<pack::Material>& materials) {
  std::set<std::size_t> parts;
  for (const prep::SourceInstance& instance : source.instances) parts.insert(instance.part);
  std::vector<std::string> withoutCoordinates;
  std::size_t withoutTangents = 0;
  for (const std::size_t part : parts) {
    const pack::MeshMaps& maps = materials[uses[part].material].meshMaps;
    const prep::Polygons& polygons = source.parts[part].polygons;
    bool isMissing = false;
    pack::visitMeshMaps(
        [&](const pack::MapRule&, const pack::MeshMap& map) {
          isMissing = isMissing || (map.isUsed() && polygons.textureCoordinates[map.set].empty());
        },
        maps);
    if (isMissing) withoutCoordinates.push_back(source.parts[part].name);
    if (maps.normal.isUsed() && polygons.tangents.empty()) ++withoutTangents;
  }
  if (!withoutCoordinates.empty())
    prep::addNote(source.notes, fmt::format("{}{}, read at (0, 0)", prep::kAcceptedNote,
                                            prep::countedNote("textured parts without texture coordinates",
                                                              withoutCoordinates.size(), withoutCoordinates)));
  if (withoutTangents > 0)
    prep::addNote(source.notes, fmt::format("{}{}", prep::kAcceptedNote,
                                            prep::countedNote("tangents from the derivatives of texture coordinates",
                                                              withoutTangents, {})));
}

// Returns the uses of the parts. Makes the materials in the order of the instances.
std::vector<PartUse> findUses(prep::SourceScene& source, const std::set<std::string>& openSurfaces,
                              MaterialIndices& indices, const std::vector<pack::Material>& materials) {
  std::vector<PartUse> uses(source.parts.size());
  std::vector<char> isBody(uses.size(), 1);
  for (const prep::SourceInstance& instance : source.instances) {
    const prep::SourcePart& part = source.parts[instance.part];
    uses[instance.part].material = indices.of(part.material);
    if (openSurfaces.contains(part.name) || openSurfaces.contains(instance.name)) isBody[instance.part] = 0;
  }
  for (const prep::SourceInstance& instance : source.instances) {
    const pack::Material& material = materials[uses[instance.part].material];
    uses[instance.part].materialName = material.name;
    uses[instance.part].isGlassBody = isBody[instance.part] != 0 && pack::hasInside(material.kind);
  }
  noteMissingAttributes(source, uses, materials);
  return uses;
}

}  // namespace

std::string UniqueNames::take(std::string name) {
  name = shortened(std::move(name));
  const auto [found, isNew] = used_.emplace(name, 1);
  if (isNew) return name;
  for (;;) {
    std::string next = fmt::format("{}.{}", name, ++found->second);
    if (used_.emplace(next, 1).second) return next;
  }
}

std::vector<std::string> fileNotes(const std::filesystem::path& file, const std::vector<std::string>& notes) {
  std::vector<std::string> content, others;
  for (const std::string& note : notes) {
    const bool isAccepted = note.starts_with(prep::kAcceptedNote);
    // An invalid part has the text of its error, which states what was expected.
    const bool isContent = !isAccepted && note.find("; expected ") == std::string::npos;
    if (isContent)
      content.push_back(note);
    else
      others.push_back(fmt::format("{}: {}{}", file.string(), isAccepted ? "" : "left out: ", note));
  }
  if (!content.empty())
    others.insert(others.begin(), fmt::format("{}: left out: {}", file.string(), fmt::join(content, "; ")));
  return others;
}

namespace {

// Adds a mesh and, if its material has opaque texels, another one at the same place.
void place(ImportedMesh mesh, const std::optional<std::uint32_t>& opaqueTexels, UniqueNames& meshNames,
           Imported& result) {
  result.meshes.push_back(mesh);
  if (!opaqueTexels) return;
  mesh.name = meshNames.take(fmt::format("{} (opaque)", mesh.name));
  mesh.material = *opaqueTexels;
  result.meshes.push_back(std::move(mesh));
}

// Keeps or notes the cameras and lights, and makes sentences of all notes. joined: those about joined parts.
void finish(const ImportDescription& description, prep::SourceScene source, const std::vector<std::string>& joined,
            Imported& result) {
  if (description.usesViews) {
    result.cameras = std::move(source.cameras);
    result.lights = std::move(source.lights);
  } else {
    for (std::string& note : prep::viewNotes(source.cameras, source.lights))
      prep::addNote(source.notes, std::move(note));
  }
  result.notes = fileNotes(description.file, source.notes);
  for (const std::string& note : joined) result.notes.push_back(fmt::format("{}: {}", description.file.string(), note));
}

}  // namespace

Imported importScene(const ImportDescription& description, std::vector<pack::Material>& materials,
                     std::vector<pack::Texture>& textures, UniqueNames& materialNames, UniqueNames& meshNames,
                     bool strict) {
  Imported result;
  std::vector<prep::SourceMaterial> factors;
  prep::SourceScene source = readSource(description, strict, factors);
  std::vector<std::string>& notes = source.notes;

  std::vector<std::string> known;  // names of open surfaces: those of a part or an instance
  for (const prep::SourcePart& part : source.parts) known.push_back(part.name);
  for (const prep::SourceInstance& instance : source.instances) known.push_back(instance.name);
  for (const std::string& name : description.openSurfaces)
    if (std::find(known.begin(), known.end(), name) == known.end())
      failUnknown(description, "part or instance", "openSurfaces", name, known);
  const std::set<std::string> openSurfaces(description.openSurfaces.begin(), description.openSurfaces.end());

  // Find the materials of the parts, in the order of the instances, and join the parts of glass bodies.
  MaterialMaps maps(source.images, textures, notes, strict);
  MaterialIndices indices(description, source, factors, materials, materialNames, maps);
  std::vector<PartUse> uses = findUses(source, openSurfaces, indices, materials);
  std::vector<std::string> joined = joinParts(source, uses, description.preparation);
  for (std::string& note : joinInstances(source, uses, description.preparation)) joined.push_back(std::move(note));

  // Prepare every part in its own space, as a body or as an open surface, if an instance needs it. A part that cannot
  // be prepared is left out.
  std::map<std::pair<std::size_t, bool>, std::optional<std::size_t>> prepared;
  std::optional<Error> firstError;
  const auto preparePart = [&](std::size_t index, bool openSurface, bool glass) {
    const auto [found, isNew] = prepared.emplace(std::pair(index, openSurface), std::nullopt);
    if (!isNew) return found->second;
    const prep::SourcePart& part = source.parts[index];
    const bool authored = !part.polygons.normals.empty() || !part.polygons.cornerNormals.empty();
    prep::Options options = description.preparation;
    options.openSurface = openSurface;
    options.certifyGlass = glass;
    options.normals = description.normals.value_or(authored ? prep::Normals::authored : prep::Normals::crease);
    ImportedPart made;
    const std::string name = fmt::format("part '{}'", part.name);
    try {
      made.mesh =
          prep::prepare(part.polygons, fmt::format("{}: {}", description.file.string(), name), options, made.report);
    } catch (const Error& error) {
      if (strict) throw;
      if (!firstError) firstError = error;
      const std::string_view what = error.what();
      prep::addNote(notes, std::string(what.substr(std::min(what.find(name), what.size()))));
      return found->second;
    }
    if (made.report.certificate.checked && !made.report.certificate.isGranted() && uses[index].isGlassBody) {
      std::vector<prep::Problem>& problems = made.report.certificate.problems;
      if (auto spread = findSpreadBody(source, uses, index, options)) problems.insert(problems.begin(), *spread);
    }
    for (std::uint32_t& v : made.mesh.sourceVertices)
      if (v != prep::kNoSource && !part.fileVertices.empty()) v = part.fileVertices[v];
    for (std::uint32_t& f : made.mesh.sourceFaces)
      if (!part.fileFaces.empty()) f = part.fileFaces[f];
    found->second = result.parts.size();
    result.parts.push_back(std::move(made));
    return found->second;
  };

  // Place the instances.
  const glm::dmat4 worldFromFile = transformMatrix(description.transform);
  for (const prep::SourceInstance& instance : source.instances) {
    const prep::SourcePart& part = source.parts[instance.part];
    ImportedMesh mesh;
    mesh.openSurface = openSurfaces.contains(part.name) || openSurfaces.contains(instance.name);
    mesh.material = uses[instance.part].material;
    const std::optional<std::size_t> preparedPart =
        preparePart(instance.part, mesh.openSurface, pack::hasInside(materials[mesh.material].kind));
    if (!preparedPart) continue;
    mesh.part = *preparedPart;
    mesh.name = meshNames.take(instance.name);
    mesh.worldFromObject = worldFromFile * instance.worldFromObject;
    place(mesh, indices.opaqueTexels(mesh.material), meshNames, result);
  }
  if (result.meshes.empty() && firstError) throw Error(*firstError);
  finish(description, std::move(source), joined, result);
  return result;
}

}  // namespace malus::bake

#include "bake/meshes/meshes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "bake/imports/import.h"
#include "bake/pack/format.h"
#include "bake/placement/placement.h"
#include "meshprep/base/console.h"
#include "meshprep/base/error.h"
#include "meshprep/prepare.h"

namespace malus::bake {

namespace {

constexpr std::size_t kReportedProblems = 3;

// The first reasons why a mesh is not a body of glass, by component.
std::string listProblems(const prep::Certificate& certificate) {
  std::vector<std::string> reported;
  for (const prep::Problem& p : certificate.problems)
    if (reported.size() < kReportedProblems)
      reported.push_back(fmt::format("component {}: {}, {}; {}", p.component, p.what, p.where, p.repair));
  if (certificate.problems.size() > reported.size())
    reported.push_back(
        fmt::format("and {} more, see malus prep --certify glass", certificate.problems.size() - reported.size()));
  return fmt::format("{}", fmt::join(reported, "; "));
}

class Placer {
 public:
  Placer(const SceneDescription& description, const MeshSettings& settings, std::vector<pack::Material>& materials,
         std::vector<pack::Texture>& textures)
      : description_(description), settings_(settings), materials_(materials), textures_(textures) {
    for (const pack::Material& material : materials) materialNames_.take(material.name);
  }

  void add(const MeshDescription& mesh) {
    // Prepare the mesh, and certify glass.
    const auto material =
        static_cast<std::uint32_t>(std::find_if(materials_.begin(), materials_.end(),
                                                [&](const pack::Material& m) { return m.name == mesh.material; }) -
                                   materials_.begin());
    const bool glass = pack::hasInside(materials_[material].kind);
    prep::Options options = mesh.preparation;
    options.certifyGlass = glass && !options.asIs;
    if (glass && options.asIs && !options.openSurface)
      throw Error(mesh.file.string(), fmt::format("mesh '{}' is a glass body with \"asIs\"", mesh.name),
                  "\"openSurface\": true beside \"asIs\": true, because it is not checked that the mesh is closed");
    options.strict = settings_.strict;
    options.keepTextures = materials_[material].meshMaps.any();
    prep::Report report;
    const auto prepared = std::make_shared<const prep::Mesh>(prepare(mesh.file, options, report));
    requireCertificate(mesh.file, mesh.name, report);
    const prep::Certificate certificate = report.certificate;
    addReport(mesh.file, std::move(report));

    // Place the instances.
    for (std::size_t i = 0; i < mesh.instances.size(); ++i) {
      std::string name = mesh.instances.size() == 1 ? mesh.name : fmt::format("{}.{}", mesh.name, i + 1);
      name = meshNames_.take(name);
      place(prepared, transformMatrix(mesh.instances[i]), std::move(name), material, options.openSurface, certificate);
    }
  }

  void add(const ImportDescription& import) {
    Imported imported = importScene(import, materials_, textures_, materialNames_, meshNames_, settings_.strict);
    result_.notes.insert(result_.notes.end(), imported.notes.begin(), imported.notes.end());
    result_.cameras.insert(result_.cameras.end(), imported.cameras.begin(), imported.cameras.end());
    result_.lights.insert(result_.lights.end(), imported.lights.begin(), imported.lights.end());
    std::vector<char> reported(imported.parts.size(), 0);
    std::vector<std::shared_ptr<const prep::Mesh>> prepared(imported.parts.size());
    for (ImportedMesh& mesh : imported.meshes) {
      ImportedPart& part = imported.parts[mesh.part];
      if (std::exchange(reported[mesh.part], 1) == 0) requireCertificate(import.file, mesh.name, part.report);
      if (!prepared[mesh.part]) prepared[mesh.part] = std::make_shared<const prep::Mesh>(std::move(part.mesh));
      place(prepared[mesh.part], mesh.worldFromObject, std::move(mesh.name), mesh.material, mesh.openSurface,
            part.report.certificate);
    }
    for (ImportedPart& part : imported.parts) addReport(import.file, std::move(part.report));
  }

  const std::vector<std::string>& notes() const { return result_.notes; }
  PlacedMeshes take() { return std::move(result_); }

 private:
  // Prepares a file, and adds the notes of the reader, also if that is refused.
  prep::Mesh prepare(const std::filesystem::path& file, const prep::Options& options, prep::Report& report) {
    const auto addNotes = [&] {
      for (std::string& note : fileNotes(file, report.notes)) result_.notes.push_back(std::move(note));
    };
    try {
      prep::Mesh mesh = prep::prepare(file, options, report);
      addNotes();
      return mesh;
    } catch (const Error&) {
      addNotes();
      throw;
    }
  }

  void addReport(const std::filesystem::path& file, prep::Report report) {
    for (const std::string& warning : report.simplification.warnings)
      result_.notes.push_back(fmt::format("{}: {}", report.source.empty() ? file.string() : report.source, warning));
    result_.reports.push_back(std::move(report));
  }

  void requireCertificate(const std::filesystem::path& file, const std::string& name, const prep::Report& report) {
    if (!report.certificate.checked || report.certificate.isGranted()) return;
    const std::string what =
        fmt::format("mesh '{}' is not certified as glass: {}", name, listProblems(report.certificate));
    if (!settings_.allowOpenGlass)
      throw Error(file.string(), what, "a body without these problems, \"openSurface\": true, or --allow-open-glass");
    result_.notes.push_back(fmt::format("{}: {}", file.string(), what));
  }

  void place(std::shared_ptr<const prep::Mesh> mesh, const glm::dmat4& worldFromObject, std::string name,
             std::uint32_t material, bool openSurface, const prep::Certificate& certificate) {
    if (result_.meshes.size() == pack::kMaxInstances)
      throw Error(description_.file.string(), "has too many meshes", fmt::format("at most {}", pack::kMaxInstances));
    PlacedMesh placedMesh;
    placedMesh.source = std::move(mesh);
    placedMesh.worldFromObject = worldFromObject;
    placedMesh.packed.name = std::move(name);
    placedMesh.packed.material = material;
    placedMesh.packed.openSurface = openSurface;
    placedMesh.isGlassBody = certificate.isGranted() && !openSurface;
    result_.meshes.push_back(std::move(placedMesh));
  }

  const SceneDescription& description_;
  const MeshSettings& settings_;
  std::vector<pack::Material>& materials_;
  std::vector<pack::Texture>& textures_;
  UniqueNames meshNames_, materialNames_;
  PlacedMeshes result_;
};

}  // namespace

PlacedMeshes placeMeshes(const SceneDescription& description, const MeshSettings& settings,
                         std::vector<pack::Material>& materials, std::vector<pack::Texture>& textures,
                         const std::function<void(std::string_view)>& progress) {
  Placer placer(description, settings, materials, textures);
  try {
    for (const MeshDescription& mesh : description.meshes) {
      progress(fmt::format("preparing {}", mesh.name));
      placer.add(mesh);
    }
    for (const ImportDescription& import : description.imports) {
      progress(fmt::format("preparing {}", import.file.filename().string()));
      placer.add(import);
    }
  } catch (const Error&) {
    // A note may explain the error: a material is glass because of a statement that contradicts another one.
    console::progressDone();
    for (const std::string& note : placer.notes()) console::warn(note);
    throw;
  }
  return placer.take();
}

}  // namespace malus::bake

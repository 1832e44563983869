// From a scene description to a scene: prepares every mesh, applies the instances' transforms, bakes the
// environment, finds the effects. Writing the pack is bake/pack/writer.h.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/depth_probe.h"
#include "bake/meshes/glass_bodies.h"
#include "bake/pack/scene.h"
#include "bake/pack/writer.h"
#include "bake/scene_file/scene_file.h"
#include "meshprep/report.h"

namespace malus::bake {

struct BakeOptions {
  bool allowOpenGlass = false;  // glass that is not certified (meshprep/certify/glass.h) is a note, not an Error
  bool strict = false;  // an invalid part of a file, or one without area, is an Error and not left out with a note
};

struct Baked {
  pack::Scene scene;
  std::vector<prep::Report> reports;  // per mesh of the description, then per part of an import
  std::vector<std::string> notes;     // left out contents of files, meshes not simplified, glass not certified,
                                      // thin films beyond single precision
  GlassBodies glassBodies;            // to be inspected again after rounding (bake/meshes/glass_bodies.h)
  std::optional<DepthProbe> probe;    // measured by the caller
  SceneDescription description;       // completed, if it is that of a model file
  std::vector<std::string> choices;   // of the rules for model files, a line each
};

// Completes the description of a model file (bake/model/model_scene.h). Calls progress with the current step. The
// provenance names all settings; keepMap is the only one that changes the scene. Throws Error.
Baked bake(const SceneDescription& description, const pack::WriteSettings& settings,
           const std::function<void(std::string_view)>& progress, const BakeOptions& options = {});

// Raise this number when the pack of the same sources changes (tests/bake/golden.json).
inline constexpr int kBakerRevision = 10;

// A file that a scene reads, or that a file which it reads refers to.
struct SourceFile {
  std::filesystem::path file;
  bool mayBeMissing = false;  // referred to by an imported file; reported when it is read
};

// The scene description first. A file can occur twice. Throws Error for an imported file that cannot be read.
std::vector<SourceFile> sourceFiles(const SceneDescription& description);

// JSON with the versions, the settings, the hashes of all sources and of the files that they refer to, and an empty
// list "warnings". Throws Error for a source that cannot be read.
std::string makeProvenance(const SceneDescription& description, const pack::WriteSettings& settings,
                           const BakeOptions& options = {});

// The provenance with the warnings of its bake, so that they are printed again by later commands.
std::string withWarnings(const std::string& provenance, std::vector<std::string> warnings);

}  // namespace malus::bake

// Keys of scene.json that code reads (bake/scene_file/scene_file.cpp, material.cpp, mesh.cpp), because they are files,
// lists, objects or alternatives, or belong to rules over several keys. One row per key for bake/SCENE.md; the other
// keys are the rows of scene_keys.h and bake/pack/material_fields.h. A test compares the rows with the keys that are
// read.
#pragma once

#include <string_view>

#include "bake/pack/field.h"

namespace malus::bake {

struct SpecialKey {
  std::string_view name;
  std::string_view value;                  // type and range
  std::string_view fallback;               // default, or "required"
  std::string_view text;                   // meaning
  pack::KindSet kinds = pack::kEveryKind;  // kinds of material that have the key
};

inline constexpr SpecialKey kSceneSpecialKeys[] = {
    {"malus", "`1`", "required", "version of the schema"},
    {"origin", "three numbers, +-1e+12 m", "centre of the meshes",
     "the renderers work relative to this point, which is kept in double precision"},
    {"camera", "object", "required", "see below"},
    {"resolution", "[width, height], 1 to 16384 pixels", "required", "size of the image"},
    {"environment", "object", "black", "see below"},
    {"lights", "list of at most 4096", "`[]`", "point, spot and directional lights"},
    {"materials", "object of at most 4096", "required", "name to material"},
    {"meshes", "list", "required without `imports`", "see below"},
    {"imports", "list", "`[]`", "whole files, see below"},
};

inline constexpr SpecialKey kCameraSpecialKeys[] = {
    {"intrinsics", "object", "none", "in place of `verticalFovDegrees`, see below"},
};

inline constexpr SpecialKey kImageSpecialKeys[] = {
    {"image", "file", "required", "latitude-longitude image (below, Images)"},
};

inline constexpr SpecialKey kPresetSpecialKeys[] = {
    {"preset", "`studio`", "required",
     "a neutral room with soft boxes, which malus computes: a key light to the left of a camera at +z, a fill light to "
     "the right, a rim light behind. A white diffuse surface that faces the key light has about the radiance 1"},
};

inline constexpr SpecialKey kLightSpecialKeys[] = {
    {"type", "`point`, `spot` or `directional`", "required", "kind of light"},
};

inline constexpr SpecialKey kMaterialSpecialKeys[] = {
    {"type", "text", "required", "kind of material, see above"},
    {"preset", "text", "none",
     "optical constants in place of `eta` and `k`: a name from `malus --list-materials`, or a file (below, Optical "
     "constants)",
     pack::kindsWhere(pack::hasIndex)},
    {"eta", "number or three numbers, 0 to 1000", "required; 1.5 for `paint`",
     "real part of the index eta - i k; 0.001 or more, or `k` is", pack::kindsWhere(pack::hasIndex)},
    {"k", "number or three numbers, 0 to 1000", "0", "imaginary part of the index; 0 for dielectrics",
     pack::kindsWhere(pack::hasIndex)},
    {"albedo", "number or three numbers, 0 to 1", "required; 0 for `metal`; 1 with `albedoMap`", "diffuse reflectance",
     pack::kindsWhere(pack::canBeDiffuse)},
    {"albedoMap", "map", "none", "multiplied by `albedo`", pack::kindsWhere(pack::canBeDiffuse)},
    {"etaMap", "map", "none",
     "in place of `eta`: per colour for `metal`, the green channel for others. `eta` or `preset` is then the index for "
     "the ambient irradiance",
     pack::kindsWhere(pack::canHaveIndexMap)},
    {"kMap", "map, 0.001 or more", "none", "in place of `k`; requires `etaMap`, and is required by it",
     pack::kindsWhere(pack::isConductor)},
    {"projection", "object", "required with a map", "see below", pack::kindsWhere(pack::canHaveMaps)},
    {"highlight", "object", "none", "normalized Phong lobe for point lights", pack::kindsWhere(pack::hasIndex)},
    {"coating", "object", "none", "thin film with interference at `wavelengthsNm`",
     pack::kindsWhere(pack::canBeCoated)},
    {"clearCoat", "object", "none", "thick clear layer without interference, in place of `coating`",
     pack::kindsWhere(pack::canBeCoated)},
    {"polarization", "`{\"axis\": [x, y, z], \"degree\": 1}`", "unpolarized",
     "as of a display: the field of the light that leaves along the normal is parallel to `axis`, a direction in the "
     "scene "
     "that does not rotate with the mesh; `degree` is 0 to 1",
     pack::kindsWhere(pack::isEmitter)},
    {"transmittance", "number or three numbers, 0 to 1", "1", "transmittance of power of the plate",
     pack::only(pack::MaterialKind::wavePlate)},
};

inline constexpr SpecialKey kMapSpecialKeys[] = {
    {"image", "file", "required", "image (below, Images)"},
};

inline constexpr SpecialKey kMeshSpecialKeys[] = {
    {"file", "file", "required", "OBJ, PLY, STL, OFF, or glTF (`.gltf`, `.glb`: all of its instances in one mesh)"},
    {"normals", "`crease`, `smoothing` or `authored`", "`crease`",
     "by angle, by the file's smoothing groups, or the file's"},
    {"instances", "list of transforms", "one, without a transform", "one copy of the mesh per transform"},
};

// Of a mesh, and of an import for all of its parts.
inline constexpr SpecialKey kCleaningSpecialKeys[] = {
    {"skip", "list of `weld`, `degenerate`, `duplicates`, `unreferenced`, `orient`, `fans`", "`[]`",
     "cleaning steps that are left out"},
};

inline constexpr SpecialKey kImportSpecialKeys[] = {
    {"file", "file", "required", "glTF, OBJ, PLY, STL or OFF"},
    {"materials", "object", "`{}`",
     "name of a material in the file (`\"\"`: none) to that of one in the scene; others are made by the rules below"},
    {"transform", "transform", "none", "of the whole file, applied after its own"},
    {"openSurfaces", "list of names", "`[]`", "parts or instances that are open surfaces (deprecated name: `sheets`)"},
    {"normals", "`crease`, `smoothing` or `authored`", "`authored` if a part has normals, else `crease`",
     "as for meshes"},
};

}  // namespace malus::bake

// The description of a material: sections MATL and SRFX of the pack, and the keys of a material in scene.json.
//
// A new field is a member of pack::Material and a row at the end of its section with `since` one above the newest:
// packs without it keep their bytes, and packs from before it open with its default.
//
// Rules over several fields are code beside the readers: the index (preset, or eta and k), defaults of the albedo, the
// polarization of emitters, maps (bake/scene_file/material.cpp, bake/pack/material_reader.cpp).
#pragma once

#include "bake/pack/field.h"
#include "bake/pack/format.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// The fields of MATL.
template <class Visitor, class... Materials>
void visitBaseFields(Visitor& visit, Materials&... m) {
  constexpr KindSet kIndexed = kindsWhere(hasIndex);
  visit(Field{.name = "name", .text = "name", .section = kMaterials}, m.name...);
  visit(Field{.name = "type", .high = kMaterialKindCount - 1, .text = "kind", .section = kMaterials}, m.kind...);
  visit(Field{.name = "eta",
              .high = kMaxEta,
              .text = "real part of the index eta - i k; glass uses the green one for every colour",
              .section = kMaterials,
              .kinds = kIndexed},
        m.eta...);
  visit(Field{.name = "k",
              .high = kMaxEta,
              .text = "imaginary part; eta or k at least 1e-3, k = 0 for dielectrics",
              .section = kMaterials,
              .kinds = kIndexed},
        m.k...);
  visit(Field{.name = "outsideEta",
              .low = kMinEta,
              .high = kMaxEta,
              .text = "index of the medium on the side that the normals point to",
              .section = kMaterials,
              .key = Key::optional},
        m.outsideEta...);
  visit(Field{.name = "albedo",
              .high = 1,
              .text = "diffuse reflectance",
              .section = kMaterials,
              .kinds = kindsWhere(canBeDiffuse)},
        m.albedo...);
  visit(Field{.name = "radiance",
              .high = kMaxLight,
              .unit = "W/(m^2 sr)",
              .text = "emitted from the side that the normals point to; see `twoSided`",
              .section = kMaterials,
              .kinds = kindsWhere(isEmitter),
              .key = Key::required,
              .keyHigh = 1e9},
        m.radiance...);
  visit(Field{.name = "highlight.strength",
              .high = 1e6,
              .text = "factor of the Phong lobe of point lights; 0: no highlight",
              .section = kMaterials,
              .kinds = kIndexed,
              .key = Key::optional,
              .fallback = 1},
        m.highlightStrength...);
  visit(Field{.name = "highlight.exponent",
              .high = 4095,
              .text = "exponent of the Phong lobe",
              .section = kMaterials,
              .kinds = kIndexed,
              .key = Key::required,
              .keyLow = 1,
              .keyHigh = 4095},
        m.highlightExponent...);
}

// The fields of SRFX: media, thin films and roughness.
template <class Visitor, class... Materials>
void visitInterfaceFields(Visitor& visit, Materials&... m) {
  constexpr KindSet kCoated = kindsWhere(canBeCoated);
  visit(Field{.name = "absorption",
              .high = kMaxAbsorption,
              .unit = "1/m",
              .text = "of the medium inside: power falls to e^-(absorption x length)",
              .section = kSurfaces,
              .isFeature = true,
              .kinds = kindsWhere(hasInside),
              .key = Key::optional,
              .shape = Shape::numberOrVector},
        m.absorption...);
  visit(Field{.name = "outsideAbsorption",
              .high = kMaxAbsorption,
              .unit = "1/m",
              .text = "of the medium on the side that the normals point to",
              .section = kSurfaces,
              .isFeature = true,
              .key = Key::optional,
              .shape = Shape::numberOrVector},
        m.outsideAbsorption...);
  visit(Field{.name = "coating.eta",
              .low = kMinEta,
              .high = kMaxEta,
              .text = "index of the thin film",
              .section = kSurfaces,
              .kinds = kCoated,
              .key = Key::required,
              .shape = Shape::numberOrVector},
        m.coating.eta...);
  visit(Field{.name = "coating.thicknessNm",
              .high = kMaxThicknessNm,
              .unit = "nm",
              .text = "thickness of the thin film; 0: none",
              .section = kSurfaces,
              .isFeature = true,
              .kinds = kCoated,
              .isZeroForOthers = true,
              .key = Key::required},
        m.coating.thicknessNm...);
  visit(Field{.name = "roughness",
              .high = 1,
              .text = "GGX alpha: the reflection is the mean over 16 fixed facets",
              .section = kSurfaces,
              .isFeature = true,
              .kinds = kindsWhere(canBeRough),
              .isZeroForOthers = true,
              .key = Key::optional},
        m.roughness...);
}

// The fields of SRFX: polarizing elements, polarized emitters and thin glass.
template <class Visitor, class... Materials>
void visitPolarizationFields(Visitor& visit, Materials&... m) {
  visit(Field{.name = "axis",
              .low = -kMaxUnitComponent,
              .high = kMaxUnitComponent,
              .text = "direction in the scene: transmitted field of a polarizer, fast axis of a wave plate, field of a "
                      "polarized emitter",
              .section = kSurfaces,
              .kinds = kindsWhere(isPolarizingElement),
              .key = Key::required,
              .shape = Shape::direction},
        m.axis...);
  visit(Field{.name = "polarization",
              .high = 1,
              .text = "degree of linear polarization of the emitted light",
              .section = kSurfaces,
              .isFeature = true,
              .kinds = kindsWhere(isEmitter),
              .isZeroForOthers = true},
        m.polarization...);
  visit(Field{.name = "transmittanceParallel",
              .high = 1,
              .text = "transmittance of power for a field parallel to the axis; of thin glass and glass: transmittance",
              .section = kSurfaces,
              .isFeature = true,
              .kinds = only(MaterialKind::polarizer),
              .key = Key::optional,
              .shape = Shape::numberOrVector,
              .alias = "along"},
        m.transmittanceParallel...);
  visit(
      Field{.name = "transmittance",
            .high = 1,
            .text = "of `thin-glass`: internal transmittance of a pane at normal incidence, without its interfaces; of "
                    "`glass`: of each passage through its surface, beside that of the interface",
            .kinds = only(MaterialKind::thinGlass) | only(MaterialKind::glass),
            .key = Key::optional,
            .shape = Shape::numberOrVector},
      m.transmittanceParallel...);
  visit(Field{.name = "transmittanceCrossed",
              .high = 1,
              .text = "transmittance of power for a field crossed with the axis",
              .section = kSurfaces,
              .kinds = only(MaterialKind::polarizer),
              .key = Key::optional,
              .shape = Shape::numberOrVector,
              .alias = "across",
              .fallback = 0},
        m.transmittanceCrossed...);
  visit(Field{.name = "retardanceDegrees",
              .low = -kMaxRetardanceDegrees,
              .high = kMaxRetardanceDegrees,
              .unit = "degrees",
              .text = "retardance at normal incidence",
              .section = kSurfaces,
              .kinds = only(MaterialKind::wavePlate),
              .key = Key::optional,
              .shape = Shape::numberOrVector,
              .fallback = 90},
        m.retardanceDegrees...);
}

// The fields of SRFX: textures.
template <class Visitor, class... Materials>
void visitTextureFields(Visitor& visit, Materials&... m) {
  visit(Field{.name = "maps.albedo",
              .text = "texture times the albedo: 1 + index into TEXR; 0: none",
              .section = kSurfaces,
              .isTexture = true,
              .isFeature = true,
              .kinds = kindsWhere(canBeDiffuse)},
        m.maps.albedo...);
  visit(Field{.name = "maps.eta",
              .text = "texture in place of eta",
              .section = kSurfaces,
              .isTexture = true,
              .isFeature = true,
              .kinds = kindsWhere(canHaveIndexMap)},
        m.maps.eta...);
  visit(Field{.name = "maps.k",
              .text = "texture in place of k; there exactly if a conductor has one of eta",
              .section = kSurfaces,
              .isTexture = true,
              .isFeature = true,
              .kinds = kindsWhere(isConductor)},
        m.maps.k...);
  visit(Field{.name = "maps.origin",
              .low = -kMaxLength,
              .high = kMaxLength,
              .unit = "m",
              .text = "origin of the projection of the textures",
              .section = kSurfaces},
        m.maps.origin...);
  visit(Field{.name = "maps.u",
              .low = -kMaxLength,
              .high = kMaxLength,
              .unit = "1/m",
              .text = "texture coordinate of a point p: dot(p - origin, u)",
              .section = kSurfaces},
        m.maps.u...);
  visit(Field{.name = "maps.v",
              .low = -kMaxLength,
              .high = kMaxLength,
              .unit = "1/m",
              .text = "and dot(p - origin, v), from the upper left corner, in repeats of the image",
              .section = kSurfaces},
        m.maps.v...);
}

// The fields of SRFX from version 2 on.
template <class Visitor, class... Materials>
void visitEmitterFields(Visitor& visit, Materials&... m) {
  visit(Field{.name = "twoSided",
              .text = "true: the back of the emitter radiates like its front",
              .section = kSurfaces,
              .since = 2,
              .isFeature = true,
              .kinds = kindsWhere(isEmitter),
              .key = Key::optional},
        m.twoSided...);
  visit(Field{.name = "illuminates",
              .text = "true: the emitter lights diffuse surfaces directly, by `--light-samples` shadow rays",
              .section = kSurfaces,
              .since = 3,
              .isFeature = true,
              .kinds = kindsWhere(isEmitter),
              .key = Key::optional},
        m.illuminates...);
}

// The fields of SRFX from version 4 on.
template <class Visitor, class... Materials>
void visitLayerFields(Visitor& visit, Materials&... m) {
  constexpr KindSet kCoated = kindsWhere(canBeCoated);
  visit(Field{.name = "specularFactor",
              .high = 1,
              .text = "factor of the reflection of the interface at every angle; light that is not reflected passes it",
              .section = kSurfaces,
              .since = 4,
              .isFeature = true,
              .kinds = kindsWhere(hasIndex),
              .key = Key::optional},
        m.specularFactor...);
  visit(Field{.name = "clearCoat.eta",
              .low = kMinEta,
              .high = kMaxEta,
              .text = "index of the clear coat",
              .section = kSurfaces,
              .since = 4,
              .kinds = kCoated,
              .key = Key::optional},
        m.clearCoat.eta...);
  visit(Field{.name = "clearCoat.factor",
              .high = 1,
              .text = "share of the surface that has the clear coat; 0: none",
              .section = kSurfaces,
              .since = 4,
              .isFeature = true,
              .kinds = kCoated,
              .isZeroForOthers = true,
              .key = Key::optional,
              .fallback = 1},
        m.clearCoat.factor...);
}

// Calls visit(field, value of each material...) for every field, in the order of the bytes.
template <class Visitor, class... Materials>
void visitMaterial(Visitor&& visit, Materials&... m) {
  visitBaseFields(visit, m...);
  visitInterfaceFields(visit, m...);
  visitPolarizationFields(visit, m...);
  visitTextureFields(visit, m...);
  visitEmitterFields(visit, m...);
  visitLayerFields(visit, m...);
}

// Version of SRFX that the materials need: 0 where the section is not needed.
std::uint32_t surfaceVersion(std::span<const Material> materials);

// Newest version of SRFX that is read.
std::uint32_t newestSurfaceVersion();

}  // namespace malus::pack

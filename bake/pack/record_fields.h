// The description of every record of a pack but the material (bake/pack/material_fields.h): one row per field, in the
// order of the bytes. Bulk data (texels, geometry, maps to the source) and rules over several fields are code beside
// the reader and the writer.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bake/pack/encodings.h"
#include "bake/pack/field.h"
#include "bake/pack/format.h"
#include "bake/pack/scene.h"

namespace malus::pack {

// META
template <class Visitor, class... Scenes>
void visitMeta(Visitor&& visit, Scenes&... s) {
  visit(Field{.name = "name", .text = "short name"}, s.name...);
  visit(Field{.name = "title", .text = "one line for people"}, s.title...);
  visit(Field{.name = "origin",
              .low = -kMaxLength,
              .high = kMaxLength,
              .unit = "m",
              .text = "origin of every other position, in world space"},
        s.origin...);
  visit(Field{.name = "width", .low = 1, .high = kMaxResolution, .unit = "pixels", .text = "width of the image"},
        s.width...);
  visit(Field{.name = "height", .low = 1, .high = kMaxResolution, .unit = "pixels", .text = "height of the image"},
        s.height...);
  visit(Field{.name = "depth", .high = kMaxDepth, .text = "most specular interactions along a path"}, s.depth...);
  visit(Field{.name = "exposureEv", .low = -100, .high = 100, .unit = "stops", .text = "display exposure"},
        s.exposureEv...);
}

// CAMR
template <class Visitor, class... Cameras>
void visitCamera(Visitor&& visit, Cameras&... c) {
  visit(Field{.name = "position", .low = -kMaxLength, .high = kMaxLength, .unit = "m", .text = "pinhole"},
        c.position...);
  visit(Field{.name = "right",
              .low = -kMaxUnitComponent,
              .high = kMaxUnitComponent,
              .text = "the three axes are orthonormal within 1e-9"},
        c.right...);
  visit(Field{.name = "up", .low = -kMaxUnitComponent, .high = kMaxUnitComponent, .text = "up in the image"}, c.up...);
  visit(Field{.name = "forward",
              .low = -kMaxUnitComponent,
              .high = kMaxUnitComponent,
              .text = "into the scene; right-handed: right x up = -forward"},
        c.forward...);
  visit(
      Field{
          .name = "verticalFovDegrees", .low = 1e-3, .high = 179, .unit = "degrees", .text = "vertical field of view"},
      c.verticalFovDegrees...);
  visit(
      Field{.name = "mediumEta", .low = kMinEta, .high = kMaxEta, .text = "index of the medium that the camera is in"},
      c.mediumEta...);
  visit(Field{.name = "orthographicHeight",
              .high = kMaxLength,
              .unit = "m",
              .text = "height of the image of an orthographic camera; 0: perspective",
              .since = 2},
        c.orthographicHeight...);
  visit(Field{.name = "pixelAspect", .low = 1e-3, .high = 1e3, .text = "width of a pixel over its height", .since = 2},
        c.pixelAspect...);
  visit(Field{.name = "middleX",
              .low = -kMaxImageShift,
              .high = kMaxImageShift,
              .unit = "image heights",
              .text = "middle of the image to the right of the axis",
              .since = 2},
        c.middleX...);
  visit(Field{.name = "middleY",
              .low = -kMaxImageShift,
              .high = kMaxImageShift,
              .unit = "image heights",
              .text = "middle of the image above the axis",
              .since = 2},
        c.middleY...);
}

inline constexpr std::uint32_t kNewestCamera = 2;
inline std::uint32_t cameraVersion(const Camera& camera) { return camera.isPlain() ? 1 : kNewestCamera; }

// ENVR, then the texels of the map
template <class Visitor, class... Environments>
void visitEnvironment(Visitor&& visit, Environments&... e) {
  visit(Field{.name = "radiance",
              .high = kMaxLight,
              .unit = "W/(m^2 sr)",
              .text = "constant radiance, used if the size is 0"},
        e.radiance...);
  visit(Field{.name = "ambientIrradiance",
              .high = 1e6,
              .text = "share of the environment's irradiance that reaches diffuse surfaces"},
        e.ambientIrradiance...);
  visit(
      Field{.name = "irradiance",
            .low = -kMaxIrradiance,
            .high = kMaxIrradiance,
            .unit = "W/m^2",
            .text = "coefficients of 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2, multiplied by the factors of the clamped "
                    "cosine (`irradiancePolynomial` in `shaders/optics/environment.h`)"},
      e.irradiance...);
  visit(Field{.name = "size",
              .high = kMaxEnvironmentSize,
              .unit = "texels",
              .text = "side of the octahedral map without its border; 0: none"},
        e.size...);
  visit(Field{.name = "texelFormat", .high = 1, .text = "of a component of a texel: 0 half, 1 float", .since = 2},
        e.storage.isFloat...);
  visit(Field{.name = "texelScale",
              .low = 1e-50,
              .high = 1e35,
              .text = "factor of halves, a power of two; 1 with floats",
              .since = 2},
        e.storage.scale...);
  visit(
      Field{.name = "illuminates",
            .text = "true: its light on diffuse surfaces is sampled, with shadows, in place of the ambient irradiance",
            .since = 3},
      e.illuminates...);
}

// SKYP
template <class Visitor, class... Environments>
void visitSky(Visitor&& visit, Environments&... e) {
  visit(Field{.name = "sky.sun",
              .low = -kMaxUnitComponent,
              .high = kMaxUnitComponent,
              .text = "unit vector toward the sun"},
        e.sun...);
  visit(Field{.name = "sky.maxDegree", .high = 1, .text = "degree of polarization at 90 degrees from the sun"},
        e.skyDegree...);
}

// WAVE
template <class Visitor, class... Scenes>
void visitWavelengths(Visitor&& visit, Scenes&... s) {
  visit(Field{.name = "wavelengthsNm",
              .low = kMinWavelengthNm,
              .high = kMaxWavelengthNm,
              .unit = "nm",
              .text = "wavelengths in vacuum of red, green and blue"},
        s.wavelengthsNm...);
}

// LGHT, per light
template <class Visitor, class... Lights>
void visitLight(Visitor&& visit, Lights&... l) {
  visit(Field{.name = "position", .low = -kMaxLength, .high = kMaxLength, .unit = "m", .text = "position"},
        l.position...);
  visit(Field{.name = "intensity",
              .high = kMaxLight,
              .unit = "W/sr",
              .text = "radiant intensity; of a directional light the irradiance in W/m^2"},
        l.intensity...);
  visit(Field{.name = "type", .high = 2, .text = "0 point, 1 spot, 2 directional", .since = 2}, l.kind...);
  visit(Field{.name = "direction",
              .low = -kMaxUnitComponent,
              .high = kMaxUnitComponent,
              .text = "unit vector in which the light travels; 0 of a point light",
              .since = 2},
        l.direction...);
  visit(Field{.name = "innerConeDegrees",
              .high = 90,
              .unit = "degrees",
              .text = "of a spot light: full intensity up to this angle from the direction",
              .since = 2},
        l.innerConeDegrees...);
  visit(Field{.name = "outerConeDegrees",
              .high = 90,
              .unit = "degrees",
              .text = "none from this angle on, which is larger",
              .since = 2},
        l.outerConeDegrees...);
}
inline constexpr std::uint32_t kNewestLights = 2;
inline std::uint32_t lightsVersion(const std::vector<LightSource>& lights) {
  for (const LightSource& light : lights)
    if (light.kind != LightKind::point) return kNewestLights;
  return 1;
}

// TEXR, per texture, then its texels
template <class Visitor, class... Textures>
void visitTexture(Visitor&& visit, Textures&... t) {
  visit(Field{.name = "name", .text = "file that it comes from"}, t.name...);
  visit(Field{.name = "width", .low = 1, .high = kMaxTextureSide, .unit = "texels", .text = "width"}, t.width...);
  visit(Field{.name = "height", .low = 1, .high = kMaxTextureSide, .unit = "texels", .text = "height"}, t.height...);
}

// EFCT, per effect
template <class Visitor, class... Effects>
void visitEffect(Visitor&& visit, Effects&... e) {
  visit(Field{.name = "name", .text = "name"}, e.name...);
  visit(Field{.name = "on", .high = 1, .text = "1: needed by the image"}, e.on...);
  visit(Field{.name = "reason", .text = "reason, for people"}, e.reason...);
}

// MESH, per mesh
struct MeshEntry {
  std::string name;
  std::uint32_t material = 0;
  std::uint32_t flags = 0;  // of kOpenSurfaceFlag, kNormalsFlag
  std::uint32_t vertices = 0, triangles = 0;
  std::uint32_t isEdgebreaker = 0;
  std::uint64_t offset = 0, sizeBytes = 0;  // in GEOM
  glm::dvec3 gridOrigin{0.0};               // from version 2 on
  double gridStep = 0;
  glm::dvec3 origin{0.0};
};
inline constexpr std::uint32_t kOpenSurfaceFlag = 1, kNormalsFlag = 2;

template <class Visitor, class... Entries>
void visitMeshEntry(Visitor&& visit, Entries&... m) {
  visit(Field{.name = "name", .text = "name", .section = kMeshes}, m.name...);
  visit(Field{.name = "material", .high = kMaxMaterials - 1, .text = "index into MATL", .section = kMeshes},
        m.material...);
  visit(Field{.name = "flags",
              .high = kOpenSurfaceFlag | kNormalsFlag,
              .text = "bit 0: open surface that may transmit; bit 1: has normals",
              .section = kMeshes},
        m.flags...);
  visit(Field{.name = "vertices", .high = kMaxVertices, .text = "at most 2^28 over all meshes", .section = kMeshes},
        m.vertices...);
  visit(Field{.name = "triangles", .high = kMaxTriangles, .text = "at most 2^28 over all meshes", .section = kMeshes},
        m.triangles...);
  visit(
      Field{.name = "encoding", .high = 1, .text = "for information: 0 sequential, 1 edgebreaker", .section = kMeshes},
      m.isEdgebreaker...);
  visit(Field{.name = "offset",
              .text = "of its Draco data in GEOM: a multiple of 16, past the data of the mesh before",
              .section = kMeshes},
        m.offset...);
  visit(Field{.name = "sizeBytes", .unit = "bytes", .text = "size of its Draco data", .section = kMeshes},
        m.sizeBytes...);
  visit(Field{.name = "grid.origin",
              .low = -kMaxCoordinate,
              .high = kMaxCoordinate,
              .unit = "m",
              .text = "position of the integers (0, 0, 0), a whole number of steps, relative to the scene's origin",
              .section = kMeshes,
              .since = 2},
        m.gridOrigin...);
  visit(Field{.name = "grid.step",
              .high = kMaxCoordinate,
              .unit = "m",
              .text = "distance of neighbouring integers, a power of two",
              .section = kMeshes,
              .since = 2},
        m.gridStep...);
  visit(Field{.name = "origin",
              .low = -kMaxCoordinate,
              .high = kMaxCoordinate,
              .unit = "m",
              .text = "of the positions that renderers use, relative to the scene's; its coordinates are floats",
              .section = kMeshes,
              .since = 2},
        m.origin...);
}
inline constexpr std::uint32_t kNewestMeshes = 2;

// INST, per instance
template <class Visitor, class... Instances>
void visitInstance(Visitor&& visit, Instances&... i) {
  visit(Field{.name = "name", .text = "name"}, i.name...);
  visit(Field{.name = "mesh", .high = kMaxMeshes - 1, .text = "index into MESH"}, i.mesh...);
  visit(Field{.name = "linear.x",
              .low = -kMaxInstanceScale,
              .high = kMaxInstanceScale,
              .text = "image of the x axis: the first column of the linear part of the transform"},
        i.linear[0]...);
  visit(Field{.name = "linear.y", .low = -kMaxInstanceScale, .high = kMaxInstanceScale, .text = "that of the y axis"},
        i.linear[1]...);
  visit(Field{.name = "linear.z",
              .low = -kMaxInstanceScale,
              .high = kMaxInstanceScale,
              .text = "that of the z axis; the linear part scales lengths by factors within 1:1000"},
        i.linear[2]...);
  visit(Field{.name = "translation",
              .low = -kMaxLength,
              .high = kMaxLength,
              .unit = "m",
              .text = "position of the point that the mesh has at the scene's origin"},
        i.translation...);
}

// TCRD, per mesh
struct TextureEntry : TextureEncoding {
  std::uint32_t tangentBits = 0;
};

template <class Visitor, class... Entries>
void visitTextureEntry(Visitor&& visit, Entries&... t) {
  constexpr double kMost = compress::kMaxTextureCoordinate;
  constexpr const char* kOrigin = "coordinate of the integer 0, a whole number of steps";
  constexpr const char* kStep = "distance of neighbouring integers, a power of two; 0: the mesh does not have the set";
  visit(Field{.name = "set0.u", .low = -2 * kMost, .high = 2 * kMost, .text = kOrigin}, t.grids.sets[0].origin.x...);
  visit(Field{.name = "set0.v", .low = -2 * kMost, .high = 2 * kMost, .text = kOrigin}, t.grids.sets[0].origin.y...);
  visit(Field{.name = "set0.step", .high = kMost, .unit = "repeats", .text = kStep}, t.grids.sets[0].step...);
  visit(Field{.name = "set1.u", .low = -2 * kMost, .high = 2 * kMost, .text = kOrigin}, t.grids.sets[1].origin.x...);
  visit(Field{.name = "set1.v", .low = -2 * kMost, .high = 2 * kMost, .text = kOrigin}, t.grids.sets[1].origin.y...);
  visit(Field{.name = "set1.step", .high = kMost, .unit = "repeats", .text = kStep}, t.grids.sets[1].step...);
  visit(Field{.name = "tangentBits", .high = compress::kMaxTangentBits, .text = "bits of a tangent; 0: none"},
        t.tangentBits...);
  visit(Field{.name = "texels", .high = 1e9, .text = "longer side of the image in which errors are counted"},
        t.texels...);
  visit(Field{.name = "uvMaxTexels", .high = 1e15, .unit = "texels", .text = "largest error of a coordinate"},
        t.deviation.uvTexels...);
  visit(Field{.name = "tangentMaxDegrees",
              .high = 180,
              .unit = "degrees",
              .text = "largest angle between a tangent and its source"},
        t.deviation.tangentDegrees...);
}

// ENCD of version 1: the grid that all meshes shared, then the number of meshes
struct SharedGrid {
  glm::vec3 origin{0};
  float range = 0;
  std::uint32_t positionBits = 0;
};
template <class Visitor, class... Grids>
void visitSharedGrid(Visitor&& visit, Grids&... g) {
  constexpr double kFar = std::numeric_limits<float>::max();
  visit(Field{.name = "grid.origin", .low = -kFar, .high = kFar, .unit = "m", .text = "corner of the grid, a float"},
        g.origin...);
  visit(Field{.name = "grid.range", .high = kFar, .unit = "m", .text = "side of the grid, a float"}, g.range...);
  visit(Field{.name = "grid.positionBits", .high = 26, .text = "bits per coordinate"}, g.positionBits...);
}

// ENCD, per mesh
template <class Visitor, class... Encoded>
void visitMeshEncoding(Visitor&& visit, Encoded&... m) {
  constexpr double kMaxDistance = 1e30;
  visit(Field{.name = "inputHash",
              .text = "XXH3 of all that the encoder was given: grid, bits, positions before and after rounding, "
                      "normals, triangles, and the map to the source if it is kept",
              .section = kEncodings},
        m.inputHash...);
  visit(Field{.name = "normalBits",
              .high = compress::kMaxNormalBits,
              .text = "bits of a normal; 0 without normals",
              .section = kEncodings},
        m.normalBits...);
  visit(Field{.name = "positionMax",
              .high = kMaxDistance,
              .unit = "m",
              .text = "largest distance of a vertex from its source",
              .section = kEncodings},
        m.deviation.positionMax...);
  visit(Field{.name = "normalMaxDegrees",
              .high = 180,
              .unit = "degrees",
              .text = "largest angle between a normal and its source",
              .section = kEncodings},
        m.deviation.normalMaxDegrees...);
  visit(Field{.name = "tiltMaxDegrees",
              .high = 180,
              .unit = "degrees",
              .text = "largest tilt of a face that has area",
              .section = kEncodings},
        m.deviation.tiltMaxDegrees...);
  visit(Field{.name = "tiltFace", .text = "the face with that tilt, counted as before encoding", .section = kEncodings},
        m.deviation.tiltFace...);
  visit(Field{.name = "flipped", .text = "number of flipped faces", .section = kEncodings}, m.deviation.flipped...);
  visit(Field{.name = "newDegenerate", .text = "number of faces that lost their area", .section = kEncodings},
        m.deviation.newDegenerate...);
  visit(Field{.name = "degenerateFace", .text = "the first of them", .section = kEncodings},
        m.deviation.degenerateFace...);
  visit(Field{.name = "sequentialReason",
              .text = "reason for the sequential encoding; empty for edgebreaker",
              .section = kEncodings},
        m.sequentialReason...);
  visit(Field{.name = "positionBits",
              .high = compress::kMaxPositionBits,
              .text = "bits of a coordinate",
              .section = kEncodings,
              .since = 2},
        m.positionBits...);
  visit(
      Field{.name = "faces", .text = "number of faces of the source that have area", .section = kEncodings, .since = 2},
      m.deviation.faces...);
  visit(Field{.name = "tilted",
              .text = "number of faces tilted by more than 0.1 degrees",
              .section = kEncodings,
              .since = 2},
        m.deviation.tilted...);
  visit(Field{.name = "tiltedArea",
              .high = kMaxDistance,
              .unit = "m^2",
              .text = "their area in the source",
              .section = kEncodings,
              .since = 2},
        m.deviation.tiltedArea...);
  visit(Field{.name = "flippedFace", .text = "the first flipped face", .section = kEncodings, .since = 2},
        m.deviation.flippedFace...);
  visit(Field{.name = "degenerateArea",
              .high = kMaxDistance,
              .unit = "m^2",
              .text = "area in the source of the faces that lost theirs",
              .section = kEncodings,
              .since = 2},
        m.deviation.degenerateArea...);
}
inline constexpr std::uint32_t kNewestEncodings = 2;

}  // namespace malus::pack

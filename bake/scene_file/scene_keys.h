// The keys of scene.json: one row per key with its range, whether it is required, its deprecated name and one line for
// bake/SCENE.md. Defaults are those of the members. The rows of a material are in bake/pack/material_fields.h.
//
// Keys that are lists, objects or files, and keys with rules over several, are in special_keys.h.
#pragma once

#include "bake/pack/field.h"
#include "bake/pack/format.h"
#include "bake/scene_file/scene_file.h"

namespace malus::bake {

inline constexpr double kMaxSceneLength = 1e12;  // metres
inline constexpr double kMaxSceneLight = 1e9;    // radiance, intensity
inline constexpr double kLeastFovDegrees = 0.01, kMostFovDegrees = 170;

template <class Visitor, class... Scenes>
void visitSceneKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "name",
              .text = "short name, used in file names: 1 to 100 letters, digits and `-`",
              .key = Key::required},
        s.name...);
  visit(Field{.name = "title", .text = "one line for people", .key = Key::optional}, s.title...);
  visit(Field{.name = "depth",
              .high = pack::kMaxDepth,
              .text = "most specular interactions (reflections and refractions) along a path",
              .key = Key::required},
        s.depth...);
  visit(Field{.name = "exposureEv",
              .low = -100,
              .high = 100,
              .unit = "stops",
              .text = "display exposure of PNG files",
              .key = Key::optional},
        s.exposureEv...);
  visit(Field{.name = "wavelengthsNm",
              .low = pack::kMinWavelengthNm,
              .high = pack::kMaxWavelengthNm,
              .unit = "nm",
              .text = "wavelengths in vacuum of red, green and blue, at which presets, files of optical constants and "
                      "thin films are evaluated",
              .key = Key::optional},
        s.wavelengthsNm...);
}

template <class Visitor, class... Scenes>
void visitCameraKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "position",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "pinhole; of an orthographic camera the middle of the image",
              .key = Key::required},
        s.cameraPosition...);
  visit(Field{.name = "target",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "point that the camera looks at",
              .key = Key::required},
        s.cameraTarget...);
  visit(Field{.name = "up",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .text = "direction that is up in the image",
              .key = Key::optional},
        s.cameraUp...);
  visit(Field{.name = "mediumEta",
              .low = pack::kMinEta,
              .high = pack::kMaxEta,
              .text = "index of the medium that the camera is in",
              .key = Key::optional},
        s.mediumEta...);
}

// A camera has the keys of one of these three.
template <class Visitor, class... Scenes>
void visitFovKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "verticalFovDegrees",
              .low = kLeastFovDegrees,
              .high = kMostFovDegrees,
              .unit = "degrees",
              .text = "vertical field of view",
              .key = Key::required},
        s.verticalFovDegrees...);
}

template <class Visitor, class... Scenes>
void visitOrthographicKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "orthographicHeight",
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "height of the image of an orthographic camera, whose rays start at the image and are parallel",
              .key = Key::required,
              .excludesLow = true},
        s.orthographicHeight...);
}

template <class Visitor, class... Intrinsics>
void visitIntrinsicsKeys(Visitor&& visit, Intrinsics&... i) {
  using pack::Field, pack::Key;
  constexpr double kMostPixels = 1e6;
  visit(Field{.name = "fx",
              .high = kMostPixels,
              .unit = "pixels",
              .text = "focal length over the width of a pixel",
              .key = Key::required,
              .excludesLow = true},
        i.fx...);
  visit(Field{.name = "fy",
              .high = kMostPixels,
              .unit = "pixels",
              .text = "focal length over the height of a pixel",
              .key = Key::required,
              .excludesLow = true},
        i.fy...);
  visit(Field{.name = "cx",
              .low = -kMostPixels,
              .high = kMostPixels,
              .unit = "pixels",
              .text = "principal point, the image of `target`, from the left edge of the image of `resolution`; where "
                      "pixels are counted by their centres, as OpenCV does, 0.5 more than its number",
              .key = Key::required},
        i.cx...);
  visit(Field{.name = "cy",
              .low = -kMostPixels,
              .high = kMostPixels,
              .unit = "pixels",
              .text = "and from the upper edge",
              .key = Key::required},
        i.cy...);
}

template <class Visitor, class... Scenes>
void visitEnvironmentKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "ambientIrradiance",
              .high = 1000,
              .text = "share of the environment's irradiance that reaches diffuse surfaces, unshadowed, from order-2 "
                      "spherical harmonics; 0 leaves them to the point lights",
              .key = Key::optional,
              .alias = "diffuseFill"},
        s.ambientIrradiance...);
  visit(Field{.name = "illuminates",
              .text = "true: the environment lights diffuse surfaces by `--light-samples` shadow rays; "
                      "`ambientIrradiance` then counts only without the effect `environment-light`",
              .key = Key::optional},
        s.environmentIlluminates...);
  visit(Field{.name = "sky.sun",
              .text = "direction toward the sun: the sky is polarized by single Rayleigh scattering",
              .key = Key::required,
              .shape = pack::Shape::direction},
        s.sun...);
  visit(Field{.name = "sky.maxDegree",
              .high = 1,
              .text = "degree of polarization at 90 degrees from the sun",
              .key = Key::optional,
              .fallback = 0.8},
        s.skyDegree...);
}

// Keys of an environment with a constant radiance.
template <class Visitor, class... Scenes>
void visitConstantKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "radiance",
              .high = kMaxSceneLight,
              .unit = "W/(m^2 sr)",
              .text = "constant radiance",
              .key = Key::required},
        s.environmentRadiance...);
}

// Keys of an environment with an image or a preset.
template <class Visitor, class... Scenes>
void visitImageKeys(Visitor&& visit, Scenes&... s) {
  using pack::Field, pack::Key;
  visit(Field{.name = "scale", .high = kMaxSceneLight, .text = "factor of the image's radiance", .key = Key::optional},
        s.environmentScale...);
  visit(Field{.name = "rotationDegrees",
              .low = -360,
              .high = 360,
              .unit = "degrees",
              .text = "rotation of the image, counter-clockwise about +y seen from above",
              .key = Key::optional},
        s.environmentRotationDegrees...);
}

// Keys of point and spot lights.
template <class Visitor, class... Lights>
void visitLightKeys(Visitor&& visit, Lights&... l) {
  using pack::Field, pack::Key;
  visit(Field{.name = "position",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "position",
              .key = Key::required},
        l.position...);
  visit(Field{.name = "intensity",
              .high = kMaxSceneLight,
              .unit = "W/sr",
              .text = "irradiance at distance d and normal incidence is intensity / d^2",
              .key = Key::required},
        l.intensity...);
}

// Key of spot and directional lights.
template <class Visitor, class... Lights>
void visitDirectionKeys(Visitor&& visit, Lights&... l) {
  using pack::Field, pack::Key;
  visit(Field{.name = "direction",
              .text = "in which the light travels",
              .key = Key::required,
              .shape = pack::Shape::direction},
        l.direction...);
}

template <class Visitor, class... Lights>
void visitSpotKeys(Visitor&& visit, Lights&... l) {
  using pack::Field, pack::Key;
  visit(Field{.name = "innerConeDegrees",
              .high = 90,
              .unit = "degrees",
              .text = "up to this angle from the direction the light has its intensity",
              .key = Key::optional},
        l.innerConeDegrees...);
  visit(Field{.name = "outerConeDegrees",
              .high = 90,
              .unit = "degrees",
              .text = "from this angle on, which is larger, it is dark; between them it is multiplied by the square of "
                      "(c - cos outer) / (cos inner - cos outer), c the cosine of the angle (KHR_lights_punctual)",
              .key = Key::optional,
              .fallback = 45},
        l.outerConeDegrees...);
}

// Keys of directional lights.
template <class Visitor, class... Lights>
void visitDirectionalKeys(Visitor&& visit, Lights&... l) {
  using pack::Field, pack::Key;
  visit(Field{.name = "irradiance",
              .high = kMaxSceneLight,
              .unit = "W/m^2",
              .text = "on a surface at normal incidence; the light comes from infinity",
              .key = Key::required},
        l.intensity...);
}

// Keys of an image that a material's numbers come from.
template <class Visitor, class... Textures>
void visitMapKeys(Visitor&& visit, Textures&... t) {
  using pack::Field, pack::Key;
  visit(
      Field{.name = "scale", .low = -1e6, .high = 1e6, .text = "number = offset + scale x value", .key = Key::optional},
      t.scale...);
  visit(Field{.name = "offset", .low = -1e6, .high = 1e6, .text = "see scale", .key = Key::optional}, t.offset...);
}

template <class Visitor, class... Maps>
void visitProjectionKeys(Visitor&& visit, Maps&... m) {
  using pack::Field, pack::Key;
  visit(Field{.name = "origin",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "point of the upper left corner",
              .key = Key::optional},
        m.origin...);
  visit(Field{.name = "u",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "1/m",
              .text = "a point p has the texture coordinate dot(p - origin, u), in repeats of the image",
              .key = Key::required},
        m.u...);
  visit(Field{.name = "v",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "1/m",
              .text = "and dot(p - origin, v)",
              .key = Key::required},
        m.v...);
}

template <class Visitor, class... Transforms>
void visitTransformKeys(Visitor&& visit, Transforms&... t) {
  using pack::Field, pack::Key;
  visit(
      Field{
          .name = "scale",
          .low = -1e9,
          .high = 1e9,
          .text =
              "factors along the axes, other than 0; a mirroring scale flips the faces, so that outside stays outside",
          .key = Key::optional,
          .shape = pack::Shape::numberOrVector},
      t.scale...);
  visit(Field{.name = "rotateDegrees",
              .low = -3600,
              .high = 3600,
              .unit = "degrees",
              .text = "about x, then y, then z",
              .key = Key::optional},
        t.rotateDegrees...);
  visit(Field{.name = "translate",
              .low = -kMaxSceneLength,
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "offset",
              .key = Key::optional},
        t.translate...);
}

// Keys of a mesh, and of an import for all of its parts.
template <class Visitor, class... Options>
void visitCleaningKeys(Visitor&& visit, Options&... o) {
  using pack::Field, pack::Key;
  visit(Field{.name = "flat", .text = "true: normals are those of the faces, no vertex is split", .key = Key::optional},
        o.flat...);
  visit(Field{.name = "creaseDegrees",
              .high = 180,
              .unit = "degrees",
              .text = "edges with a larger angle get two normals",
              .key = Key::optional},
        o.creaseDegrees...);
  visit(Field{.name = "weldTolerance",
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "corners closer than this become one vertex, unless an edge would get a third face; 0: equal "
                      "positions only",
              .key = Key::optional},
        o.steps.weldTolerance...);
  visit(Field{.name = "weldRelative",
              .high = 1,
              .text = "the same as a share of the diagonal of the mesh's box; the larger of the two applies",
              .key = Key::optional},
        o.weldRelative...);
  visit(Field{.name = "dropOpposite",
              .text = "true: of two faces back to back the later one is removed",
              .key = Key::optional},
        o.steps.dropOpposite...);
  visit(Field{.name = "fillHoles",
              .high = 1e6,
              .text = "holes of at most this many edges are filled",
              .key = Key::optional},
        o.steps.fillHoles...);
  visit(Field{.name = "simplifyError",
              .high = kMaxSceneLength,
              .unit = "m",
              .text = "edges are collapsed while the surface stays within this distance, before transforms",
              .key = Key::optional,
              .excludesLow = true},
        o.simplify.maxError...);
  visit(Field{.name = "simplifyTriangles",
              .low = 1,
              .high = pack::kMaxTriangles,
              .text = "edges are collapsed until so many triangles are left",
              .key = Key::optional},
        o.simplify.triangles...);
  visit(Field{.name = "simplifyNormal",
              .high = 180,
              .unit = "degrees",
              .text = "edges are collapsed only while the normals of the surface stay within this angle",
              .key = Key::optional,
              .excludesLow = true},
        o.simplify.maxNormalErrorDegrees...);
}

template <class Visitor, class... Meshes>
void visitMeshKeys(Visitor&& visit, Meshes&... m) {
  using pack::Field, pack::Key;
  visit(Field{.name = "name", .text = "unique name", .key = Key::required}, m.name...);
  visit(Field{.name = "material", .text = "name of a material", .key = Key::required}, m.material...);
  visit(Field{.name = "openSurface",
              .text = "true: the mesh is an open surface that may transmit; its side is that of the face that is hit. "
                      "An open glass surface needs another behind each of its faces",
              .key = Key::optional,
              .alias = "sheet"},
        m.preparation.openSurface...);
  visit(
      Field{.name = "asIs",
            .text =
                "true: nothing is cleaned, welded or flipped; vertices, faces and (unless `flat`) normals are those of "
                "the file, a PLY with `nx ny nz`. For deliberately bad meshes; glass must also be an `openSurface`",
            .key = Key::optional},
      m.preparation.asIs...);
}

}  // namespace malus::bake

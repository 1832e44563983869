// The scene of a pack, as the renderers read it. Lengths in metres, right-handed axes, positions
// relative to `origin`; colours linear RGB at `wavelengthsNm`; radiance in W/(m^2 sr).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "bake/pack/material_kinds.h"
#include "bake/pack/texel_storage.h"

namespace malus::pack {

// Default wavelengths of red, green and blue, and their bounds: from extreme ultraviolet to far infrared.
inline constexpr glm::dvec3 kDefaultWavelengthsNm{630, 532, 465};
inline constexpr double kMinWavelengthNm = 1, kMaxWavelengthNm = 1e6;

// Bounds of optical constants in a pack: within them the optics neither overflow nor lose their signs.
inline constexpr double kMinEta = 1e-3;
inline constexpr double kMaxEta = 1e3;

// A plane layer of real index, with interference.
struct Coating {
  glm::dvec3 eta{1.0};
  double thicknessNm = 0;  // 0: none
};

// A plane layer of real index without interference, on a share of a surface: 1 of all of it, 0 of none.
struct ClearCoat {
  double eta = 1.5;
  double factor = 0;
};

// Textures of a material: indices into Scene::textures, or -1. They are applied by parallel projection: the texture
// coordinates of a point p are dot(p - origin, u) and dot(p - origin, v), in repeats of the image.
struct Maps {
  std::int32_t albedo = -1;  // times the material's albedo
  std::int32_t eta = -1;     // in place of eta and k
  std::int32_t k = -1;
  glm::dvec3 origin{0.0};
  glm::dvec3 u{0.0}, v{0.0};  // 1/m
  bool any() const { return albedo >= 0 || eta >= 0 || k >= 0; }
};

// Ways in which a texture continues beyond its edges.
enum class Wrap : std::uint32_t { repeat, clamp, mirror };
inline constexpr std::array<const char*, 3> kWrapNames = {"repeat", "clamp", "mirror"};

// A texture by the texture coordinates (s, t) of the meshes, in place of a constant of the material. It is read at
// (dot(u, p), dot(v, p)), p = (s, t, 1): (0, 0) is the upper left corner of the image, (1, 1) the lower right.
struct MeshMap {
  std::int32_t texture = -1;  // index into Scene::textures; -1: none
  std::uint32_t set = 0;      // of Mesh::textureCoordinates
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  glm::dvec3 u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0};
  bool isUsed() const { return texture >= 0; }
  friend bool operator==(const MeshMap&, const MeshMap&) = default;
};

// Maps of a material by texture coordinates. The constants that they replace are their means, for an image without the
// effect mesh-textures.
struct MeshMaps {
  MeshMap albedo;
  MeshMap eta, k;          // of a metal both
  MeshMap reflectance;     // of a metal at normal incidence, in place of eta and k (conductorIndex in
                           // shaders/optics/texture_map.h)
  MeshMap metallic;        // red: edge tint of reflectance; none: 1
  MeshMap roughness;       // red
  MeshMap radiance;        // of an emitter or the diffuse layer
  MeshMap transmittance;   // of thin glass and glass bodies
  MeshMap normal;          // (n + 1) / 2, along the tangent, the bitangent and the normal
  MeshMap coverage;        // red: there is no surface where it is below the cutoff, at level 0 of the texture
  double normalScale = 1;  // factor of the first two components of the normal
  double cutoff = 0.5;
  bool any() const { return *this != MeshMaps{}; }
  friend bool operator==(const MeshMaps&, const MeshMaps&) = default;
};

struct Material {
  std::string name;
  MaterialKind kind = MaterialKind::lambert;
  glm::dvec3 eta{1.0};  // index eta - i k, per colour; glass uses the green one for every colour
  glm::dvec3 k{0.0};
  double outsideEta = 1.0;              // index on the side that the normals point to
  glm::dvec3 albedo{0.0};               // diffuse reflectance, 0 to 1
  glm::dvec3 radiance{0.0};             // of an emitter
  double highlightStrength = 0.0;       // 0: no highlight
  std::uint32_t highlightExponent = 0;  // 1 to 4095

  // Properties that few materials have (section SRFX); the defaults mean none.
  glm::dvec3 absorption{0.0};         // inside a glass body, in 1/m: power falls to e^-(absorption length)
  glm::dvec3 outsideAbsorption{0.0};  // of the medium on the side that the normals point to
  Coating coating;                    // on glass, mirror-glass, paint, metal
  ClearCoat clearCoat;                // on the same, in place of a coating
  double specularFactor = 1;          // share of the surface that has the interface, below a clear coat
  double roughness = 0;               // GGX alpha of metal, paint, mirror-glass; 0 to 1
  glm::dvec3 axis{0.0};  // unit: field of a polarized emitter, transmitted field of a polarizer, fast axis of a plate
  double polarization = 0;                // degree of an emitter's linear polarization
  bool twoSided = false;                  // an emitter that also radiates from its back
  bool illuminates = false;               // an emitter whose light on diffuse surfaces is computed
  glm::dvec3 transmittanceParallel{1.0};  // of power, of polarizers and wave plates, for a field parallel to the axis;
                                          // of thin glass inside, of glass bodies at each passage through the surface
  glm::dvec3 transmittanceCrossed{1.0};   // and crossed with it
  glm::dvec3 retardanceDegrees{0.0};      // of wave plates
  Maps maps;
  MeshMaps meshMaps;     // section MAPS
  bool isPlain() const;  // has none of these properties
};

// Rows from the top, linear.
struct Texture {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;
};

enum class LightKind : std::uint32_t { point, spot, directional };
inline constexpr std::array<const char*, 3> kLightKindNames = {"point", "spot", "directional"};

// A light without a surface. That of a spot falls off between its cones by the formula of KHR_lights_punctual: with the
// cosine c of the angle to the direction, its intensity is multiplied by
//   clamp((c - cos outer) / max(0.001, cos inner - cos outer))^2
struct LightSource {
  glm::dvec3 position;   // of a point or a spot light
  glm::dvec3 intensity;  // W/sr; of a directional light the irradiance at normal incidence, W/m^2
  LightKind kind = LightKind::point;
  glm::dvec3 direction{0.0};    // unit, in which the light of a spot or a directional light travels
  double innerConeDegrees = 0;  // of a spot: angles from the direction, inner < outer <= 90
  double outerConeDegrees = 0;
};

// Factors of the fall-off of a spot light: clamp(c scale + offset)^2. 0 and 1 of other lights.
struct SpotFalloff {
  double scale = 0, offset = 1;
};
SpotFalloff spotFalloff(const LightSource& light);

// Orthonormal axes; forward looks into the scene, up is up in the image. A perspective camera has its position as
// pinhole and the image at distance 1 along forward; the rays of an orthographic one start at the image, which is at
// its position, and are parallel to forward.
struct Camera {
  glm::dvec3 position{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};
  double verticalFovDegrees = 40.0;
  double mediumEta = 1.0;         // index of the medium that the camera is in
  double orthographicHeight = 0;  // of the image of an orthographic camera, in metres; 0: perspective
  double pixelAspect = 1;         // width of a pixel over its height
  double middleX = 0;             // middle of the image to the right of the axis and above it, in heights of the image
  double middleY = 0;
  bool isOrthographic() const { return orthographicHeight > 0; }
  bool isPlain() const { return !isOrthographic() && pixelAspect == 1 && middleX == 0 && middleY == 0; }
};

// Light from infinity: a constant radiance, or an octahedral map with a border of one texel all around that repeats the
// texels across the map's edges (size + 2 texels per side, row by row).
struct Environment {
  glm::dvec3 radiance{0.0};       // if size is 0
  std::uint32_t size = 0;         // texels per side without the border
  std::vector<glm::vec3> texels;  // (size + 2)^2, each exactly what storage can represent
  TexelStorage storage;
  double ambientIrradiance = 0.0;  // share of its irradiance that reaches diffuse surfaces, where it is not sampled
  bool illuminates = false;        // its light on diffuse surfaces is sampled, with shadows
  glm::dvec3 sun{0.0};             // unit vector toward the sun of a Rayleigh sky; 0: none
  double skyDegree = 0;            // its largest degree of polarization
  bool hasSun() const { return sun != glm::dvec3(0.0); }
  std::array<glm::dvec3, 9> irradiance{};  // coefficients of irradiancePolynomial (shaders/optics/environment.h)
};

// A mesh at its first place, with one material.
struct Mesh {
  std::string name;
  std::uint32_t material = 0;  // index into materials
  bool openSurface = false;    // an open surface that may transmit
  // Renderers use positions relative to the mesh's own origin, as floats. Meshes that share positions share an origin.
  glm::dvec3 origin{0.0};             // relative to the scene's; its coordinates are floats
  std::vector<glm::dvec3> positions;  // relative to the scene's origin
  std::vector<glm::vec3> normals;     // unit, one per position; empty: those of the faces
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside

  // Sets 0 and 1 of texture coordinates, each one per position or empty: in repeats of the image, from its upper left
  // corner, v down, within kMaxTextureCoordinate (format.h).
  std::array<std::vector<glm::vec2>, 2> textureCoordinates;
  // Per position, or empty: those of the derivatives of set 0 or 1. xyz is a unit vector in the direction of growing u;
  // the bitangent is w cross(normal, tangent), with w = 1 or -1, in the direction of shrinking v (glTF 2.0
  // Specification, section 3.7.2.1).
  std::vector<glm::vec4> tangents;
  bool hasTextureAttributes() const {
    return !textureCoordinates[0].empty() || !textureCoordinates[1].empty() || !tangents.empty();
  }

  // On request: the vertex and the face of the source file, from 0, that each vertex and triangle comes from.
  std::vector<std::uint32_t> sourceVertices, sourceFaces;
};

// A further place of a mesh (bake/pack/instances.h): a point p of the mesh is at linear p + translation. A negative
// determinant mirrors; the side that was outside stays outside.
struct Instance {
  std::string name;
  std::uint32_t mesh = 0;       // index into meshes
  glm::dmat3 linear{1.0};       // with an inverse
  glm::dvec3 translation{0.0};  // metres, relative to the scene's origin
};

// One effect, with the reason for its being on or off.
struct Effect {
  std::string name;
  bool on = false;
  std::string reason;
};

struct Scene {
  std::string name;
  std::string title;
  glm::dvec3 origin{0.0};  // world position that all other positions are relative to
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t depth = 0;                           // most specular interactions along a path
  double exposureEv = 0.0;                           // display exposure of PNG files
  glm::dvec3 wavelengthsNm = kDefaultWavelengthsNm;  // in vacuum, of red, green and blue
  Camera camera;
  Environment environment;
  std::vector<LightSource> lights;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Effect> effects;
  // Share of the image's light that arrives after more than i specular interactions, decreasing; 0 past the end. Empty:
  // not measured.
  std::vector<double> lightBeyond;
  std::string provenance;  // JSON: source hashes, settings, versions

  // Of the meshes, each once.
  std::uint64_t vertexCount() const;
  std::uint64_t triangleCount() const;
};

}  // namespace malus::pack

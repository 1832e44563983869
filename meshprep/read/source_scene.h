// Content of a model file: materials, parts with one material each, instances of the parts, cameras and lights. glTF
// has all of these; OBJ has materials, and faces are grouped by them; PLY, STL and OFF are one part and one instance.
//
// Nothing is processed here: transforms, optical constants and cleaning are applied later (bake/imports). Lengths are
// metres, coordinates double; the axes are those of the file (glTF: right-handed, +y up).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "meshprep/read/polygons.h"
#include "meshprep/read/source_view.h"

namespace malus::prep {

// Share of the light of a dielectric above which a material transmits; up to it, the material is opaque.
inline constexpr double kTransmissive = 0.5;

// Image that a material refers to.
struct SourceImage {
  std::string name;                                     // for messages
  std::filesystem::path file;                           // or, if that is empty,
  std::shared_ptr<const std::vector<std::byte>> bytes;  // the bytes of a file; null: the image cannot be found
};

// Ways in which a texture continues beyond its edges.
enum class SourceWrap { repeat, clamp, mirror };

// Place of a texture: coordinates (u, v) of its pixels, from the upper left corner, of the coordinates (s, t) of the
// mesh (KHR_texture_transform): (u, v) = offset + rotation (scale (s, t)).
struct SourcePlacement {
  std::size_t set = 0;  // of texture coordinates
  SourceWrap wrapU = SourceWrap::repeat, wrapV = SourceWrap::repeat;
  glm::dvec2 offset{0.0}, scale{1.0};
  double rotation = 0;  // radians, u' = cos u + sin v, v' = -sin u + cos v
  friend bool operator==(const SourcePlacement&, const SourcePlacement&) = default;
};

enum class AlphaMode { opaque, mask, blend };

// Material as in glTF 2.0, with its defaults. Colours are linear. Textures, indices into the images of the scene, are
// multiplied by the factors; those with other roles are ignored.
struct SourceMaterial {
  std::string name;  // empty if the file has none
  glm::dvec3 baseColour{1.0};
  AlphaMode alphaMode = AlphaMode::opaque;
  double alpha = 1;            // 0 to 1, of the base colour; not used if opaque
  double alphaCutoff = 0.5;    // of a mask: smaller alpha is not drawn
  double metallic = 1;         // 0 to 1
  double roughness = 1;        // 0 to 1; the square root of GGX's alpha
  glm::dvec3 emissive{0.0};    // radiance, W / (m^2 sr) or relative, including the strength
  bool isDoubleSided = false;  // emission on both sides
  double transmission = 0;     // 0 to 1
  bool isThinWalled = false;   // transmits without refraction
  bool tintsTransmission =
      false;         // the base colour tints transmitted light, of a body at each passage through its surface
  double ior = 1.5;  // 1 or more; 0: the reflectance of the dielectric at normal incidence is 1
  glm::dvec3 specularColour{1.0};  // 0 or more: factor of that reflectance
  double specular = 1;             // 0 to 1: factor of the reflectance at every angle
  double clearcoat = 0;            // 0 to 1: share of the surface under a layer of index 1.5
  double clearcoatRoughness = 0;   // as roughness
  double film = 0;                 // 0 to 1: share of the surface with a thin film
  double filmIor = 1.3;            // 1 or more
  double filmThicknessNm = 400;
  std::optional<std::size_t> baseColourImage;          // sRGB
  std::optional<std::size_t> metallicRoughnessImage;   // linear: roughness is green, metallic blue
  std::optional<std::size_t> emissiveImage;            // sRGB
  std::optional<std::size_t> specularGlossinessImage;  // sRGB and linear alpha, of specularColour and 1 - roughness
  std::optional<std::size_t> normalImage;              // linear: (n + 1) / 2
  double normalScale = 1;                              // of its x and y
  std::optional<std::size_t> transmissionImage;        // linear: red times transmission
  std::optional<std::size_t> coverageImage;            // MTL's map_d, linear: its alpha, or else red, times alpha
  SourcePlacement baseColourPlacement, metallicRoughnessPlacement, emissivePlacement, specularGlossinessPlacement,
      normalPlacement, transmissionPlacement, coveragePlacement;
  bool hasVolume = false;                                                // the interior absorbs light:
  glm::dvec3 attenuationColour{1};                                       // transmittance of
  double attenuationDistance = std::numeric_limits<double>::infinity();  // this distance, metres
};

// Texture attributes of vertices.
struct TextureNeeds {
  std::array<bool, 2> coordinates{};  // by set
  bool tangents = false;
};

// Returns what the images of a material need. Everything that keeps or drops texture coordinates decides by this.
TextureNeeds textureNeeds(const SourceMaterial& material);

// Texture coordinates and tangents that a reader keeps: those that the materials of the file need (textureNeeds()), or
// all or none. A part has an attribute if the file has it and it is kept.
enum class KeepTextures { none, needed, all };

struct SourcePart {
  std::string name;  // empty if the file has none
  Polygons polygons;
  std::optional<std::size_t> material;  // index into materials

  // Primitive of a mesh of glTF; no mesh for other formats.
  std::optional<std::size_t> mesh;  // index in the file
  std::string meshName;
  std::size_t primitive = 0;  // index in the mesh

  // Vertex and face of the file for each of the part, if the file has several parts; otherwise empty.
  std::vector<std::uint32_t> fileVertices, fileFaces;
};

struct SourceInstance {
  std::size_t part = 0;
  std::string name;
  glm::dmat4 worldFromObject{1.0};  // affine and invertible
  std::string node = {};            // name of the node of glTF, which may have several instances
};

struct SourceScene {
  std::vector<SourceMaterial> materials;
  std::vector<SourceImage> images;
  std::vector<SourcePart> parts;
  std::vector<SourceInstance> instances;
  std::vector<SourceCamera> cameras;  // of glTF, in the order of the nodes, depth-first
  std::vector<SourceLight> lights;

  // Ignored content, each kind once: "textures (2)"; or after kAcceptedNote (polygons.h), accepted content.
  std::vector<std::string> notes;
};

// Adds a note unless it exists. After 100 notes adds "and more" once.
void addNote(std::vector<std::string>& notes, std::string note);

// Reads a file by its extension: .gltf, .glb, .obj, .ply, .stl, .off. strict: as readGltf(). Throws Error as the reader
// of the format (read_gltf.h, read_mtl.h, read_mesh.h).
// withImages: the bytes of images in buffers are copied; without it they are null.
SourceScene readSourceScene(const std::filesystem::path& path, bool strict = false, bool withImages = false,
                            KeepTextures textures = KeepTextures::needed);

// Drops the texture coordinates unless they are kept, and otherwise the note about them.
void keepTextureCoordinates(Polygons& polygons, bool isKept);

// Groups faces by material: one part per material, in the order of their first faces, with the vertices that its faces
// use, in the order of the file. Of the materials only the names are set. Without materials there is one part.
SourceScene splitByMaterial(Polygons polygons);

// Returns the place of a point of an instance's part in world space.
inline glm::dvec3 toWorld(const SourceInstance& instance, const glm::dvec3& p) {
  return glm::dmat3(instance.worldFromObject) * p + glm::dvec3(instance.worldFromObject[3]);
}

// Returns the notes for a use of the meshes alone: those of the scene, and of its cameras and lights, which are left
// out.
std::vector<std::string> notesOfMeshes(const SourceScene& scene);

// Merges all instances in world space; the parts of the result are the instances. Faces of mirrored instances are
// flipped to keep their outside. If only some parts have normals or texture attributes, those of the others are zero.
Polygons mergeInstances(const SourceScene& scene);
// The same for some of them: indices of instances.
Polygons mergeInstances(const SourceScene& scene, std::span<const std::size_t> instances);

// Returns the files that affect the content of this one: buffers of glTF, material files of OBJ. They need not exist.
// Throws Error if the file cannot be read.
std::vector<std::filesystem::path> referencedFiles(const std::filesystem::path& path);

// Returns true if the extension is .gltf or .glb.
bool isGltf(const std::filesystem::path& path);

}  // namespace malus::prep

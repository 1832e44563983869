// The content of a glTF 2.0 document that malus reads, as plain structures with the defaults of the specification.
// Source: glTF 2.0 Specification, appendix A, "JSON Schema Reference", and the schemas of the extensions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "meshprep/read/gltf_left_out.h"

namespace malus::prep::gltf {

enum class ComponentType : std::uint32_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126,
};

enum class PrimitiveMode : std::uint32_t { triangles = 4, triangleStrip = 5, triangleFan = 6 };  // below 4: no faces

// Items of lists have isInvalid set if they are left out because of an error.
struct Buffer {
  std::string uri;  // empty: the binary chunk of a GLB
  std::size_t byteLength = 0;
  bool isInvalid = false;
};

// EXT_meshopt_compression: the elements of a view, compressed in another buffer.
struct MeshoptCompression {
  std::size_t buffer = 0;
  std::size_t byteOffset = 0;
  std::size_t byteLength = 0;
  std::size_t byteStride = 0;  // of the elements
  std::size_t count = 0;       // of elements
  std::string mode;            // "ATTRIBUTES", "TRIANGLES" or "INDICES"
  std::string filter = "NONE";
};

struct BufferView {
  std::size_t buffer = 0;
  std::size_t byteOffset = 0;
  std::size_t byteLength = 0;
  std::size_t byteStride = 0;  // 0: tightly packed; else a multiple of 4 up to 252
  std::optional<MeshoptCompression> meshopt;
  bool isInvalid = false;
};

struct SparseElements {
  std::size_t count = 0;
  std::size_t indicesView = 0, indicesByteOffset = 0;
  ComponentType indicesType{};
  std::size_t valuesView = 0, valuesByteOffset = 0;
};

struct Accessor {
  std::optional<std::size_t> bufferView;  // none: all elements are zero
  std::size_t byteOffset = 0;
  ComponentType componentType{};
  bool normalized = false;
  std::size_t count = 0;
  std::size_t components = 0;  // of an element: 1 (SCALAR) to 16 (MAT4)
  std::optional<SparseElements> sparse;
  bool isInvalid = false;
};

// KHR_draco_mesh_compression. Attributes are ids in the Draco data.
struct DracoExtension {
  std::size_t bufferView = 0;
  std::optional<std::uint32_t> position, normal, tangent;
  std::array<std::optional<std::uint32_t>, 2> texCoords;
};

// Displacements of the vertices of a primitive.
struct MorphTarget {
  std::optional<std::size_t> position, normal, tangent;
};

// Attributes and indices are indices into Document::accessors. Those of texture coordinates and tangents, which few
// materials need, may be kInvalidIndex.
inline constexpr std::size_t kInvalidIndex = std::numeric_limits<std::size_t>::max();
struct Primitive {
  std::uint32_t mode = static_cast<std::uint32_t>(PrimitiveMode::triangles);
  std::optional<std::size_t> position, normal, tangent, indices, material;
  std::array<std::optional<std::size_t>, 2> texCoords;
  std::array<std::optional<std::size_t>, 2> joints, weights;  // of a skin: four per vertex and set
  std::vector<MorphTarget> targets;
  std::optional<DracoExtension> draco;
  bool isInvalid = false;
};

struct Mesh {
  std::string name;
  std::vector<double> weights;  // default weights of the morph targets; empty: 0
  std::vector<Primitive> primitives;
  bool isInvalid = false;
};

struct Skin {
  std::vector<std::size_t> joints;                 // nodes
  std::optional<std::size_t> inverseBindMatrices;  // accessor; none: identity
};

// EXT_mesh_gpu_instancing: accessors with one value per instance.
struct GpuInstancing {
  std::optional<std::size_t> translation, rotation, scale;
};

struct Node {
  std::string name;
  std::optional<std::size_t> mesh, camera, light, skin;
  std::vector<double> weights;  // of the morph targets, in place of those of the mesh
  std::optional<GpuInstancing> instancing;
  std::vector<std::size_t> children;
  std::optional<std::array<double, 16>> matrix;  // column-major; replaces the other three
  std::optional<std::array<double, 3>> translation, scale;
  std::optional<std::array<double, 4>> rotation;  // quaternion (x, y, z, w)
  bool hasInvalidTransform = false, hasInvalidChildren = false, hasInvalidInstancing = false, hasInvalidSkin = false;
};

struct Image {
  std::string name, uri;
  std::optional<std::size_t> bufferView;  // in place of the URI
};

// A texture of a material, with KHR_texture_transform.
struct TextureInfo {
  std::optional<std::size_t> index;
  std::size_t texCoord = 0;
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;  // radians
};

// WebGL's numbers; others count as repeated.
struct Sampler {
  std::size_t wrapS = kRepeat, wrapT = kRepeat;
  static constexpr std::size_t kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648;
};

struct Texture {
  std::optional<std::size_t> source, sampler;
};

// KHR_materials_pbrSpecularGlossiness, in place of the metallic-roughness values.
struct SpecularGlossiness {
  std::array<double, 4> diffuseFactor{1, 1, 1, 1};
  std::array<double, 3> specularFactor{1, 1, 1};
  double glossinessFactor = 1;
  TextureInfo diffuseTexture, specularGlossinessTexture;
};

struct Material {
  std::string name;
  std::array<double, 4> baseColorFactor{1, 1, 1, 1};
  double metallicFactor = 1;
  double roughnessFactor = 1;
  std::array<double, 3> emissiveFactor{0, 0, 0};
  std::string alphaMode = "OPAQUE";  // or "MASK", "BLEND"
  double alphaCutoff = 0.5;
  bool doubleSided = false;
  double emissiveStrength = 1;  // KHR_materials_emissive_strength
  TextureInfo baseColorTexture, metallicRoughnessTexture, emissiveTexture, normalTexture, transmissionTexture;
  double normalScale = 1;
  double ior = 1.5;           // KHR_materials_ior; 0: the reflectance is 1
  double specularFactor = 1;  // KHR_materials_specular
  std::array<double, 3> specularColorFactor{1, 1, 1};
  double clearcoatFactor = 0;  // KHR_materials_clearcoat
  double clearcoatRoughnessFactor = 0;
  double iridescenceFactor = 0;  // KHR_materials_iridescence
  double iridescenceIor = 1.3;
  double iridescenceThicknessMaximum = 400;  // nanometres
  std::optional<SpecularGlossiness> specularGlossiness;
  double transmissionFactor = 0;     // KHR_materials_transmission
  double volumeThicknessFactor = 0;  // KHR_materials_volume
  std::array<double, 3> attenuationColor{1, 1, 1};
  double attenuationDistance = std::numeric_limits<double>::infinity();  // metres
};

struct Camera {
  std::string name, type;  // "perspective" or "orthographic"; other types are left out
  double yfov = 0;         // radians
  std::optional<double> aspectRatio;
  double xmag = 0, ymag = 0;  // half width and half height, metres
};

// KHR_lights_punctual
struct Light {
  std::string name, type;  // "point", "spot" or "directional"; other types are left out
  std::array<double, 3> color{1, 1, 1};
  double intensity = 1;       // candela; lux of a directional light
  double innerConeAngle = 0;  // radians from the axis
  double outerConeAngle = std::numbers::pi / 4;
};

struct Document {
  bool quantized = false;  // KHR_mesh_quantization is used
  std::optional<std::size_t> defaultScene;
  std::vector<std::vector<std::size_t>> sceneNodes;  // root nodes of each scene
  std::vector<Node> nodes;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<Accessor> accessors;
  std::vector<BufferView> bufferViews;
  std::vector<Buffer> buffers;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Sampler> samplers;
  std::vector<Image> images;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
};

// `document` must come from parseGltfJson(), which checks types and required keys; its strings are moved out. `where`
// is the file for messages. Leaves out an accessor with an unknown component type or element type, and a buffer view
// with a stride that glTF forbids. Indices into other lists are checked where they are used.
Document toDocument(nlohmann::json document, const std::string& where, GltfLeftOut& leftOut);

}  // namespace malus::prep::gltf

// A scene in the float structs of shaders/gpu/scene.h. Embree and Vulkan render from the same numbers.
#pragma once

#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"
#include "shaders/gpu/scene.h"

namespace malus::render {

inline constexpr std::uint32_t kNoInstance = 0xffffffff;

struct RenderScene {
  std::vector<gpu::Material> materials;
  std::vector<gpu::PointLight> lights;
  std::vector<gpu::LightShape> lightShapes;  // one per light, at least one
  // Meshes of equal origin follow each other, those of origin 0 first: each run is one instance of the acceleration
  // structures. Behind them is every place of the meshes that have instances, as a mesh that shares their vertices and
  // triangles.
  std::vector<gpu::Mesh> meshes;
  std::vector<gpu::MeshTransform> meshTransforms;  // one per mesh
  std::vector<std::uint32_t> sourceMeshes;         // index of each mesh in the pack's scene
  std::vector<std::uint32_t> sourceInstances;      // index of its instance, or kNoInstance
  std::vector<std::uint32_t> meshTriangles;  // that rays can meet, of each mesh: none of a surface between equal media
  std::vector<std::uint32_t> meshVertices;
  std::vector<glm::vec3> positions;        // relative to the origin of their mesh
  std::vector<glm::vec3> normals;          // one per position; (0, 0, 0) for flat meshes
  std::vector<glm::uvec3> triangles;       // indices within their mesh
  std::vector<gpu::MaterialExtra> extras;  // one per material
  std::vector<gpu::Texture> textures;      // at least one, because a buffer must not be empty
  std::vector<std::uint32_t> textureRows;  // row in it of each texture of the pack's scene
  std::vector<glm::vec3> textureTexels;
  // Textures by the texture coordinates of meshes: each is followed by the levels of its pyramid in `textures`.
  bool hasMeshTextures = false;
  std::vector<gpu::MeshMaps> materialMaps;      // one per material, at least one
  std::vector<gpu::TextureMap> textureMaps;     // row 0 is unused
  std::vector<glm::vec4> textureCoordinates;    // sets 0 and 1, one per position; one element without mesh textures
  std::vector<glm::vec4> tangents;              // the same, where a material has a normal map
  std::vector<glm::vec3> environmentTexels;     // with their border; one texel if there is no map
  std::vector<gpu::AreaLight> areaLights;       // at least one
  std::vector<gpu::LightNode> lightNodes;       // the root is the first; at least one
  std::vector<float> environmentDistributions;  // environment_distribution.h; at least one number
};

// Whether a mesh is another place of the mesh before it, whose vertices and triangles it has.
bool sharesVertices(const RenderScene& scene, std::size_t mesh);

// Runs of meshes of equal origin, or one place of a mesh: the index of the first mesh and the number of meshes.
struct MeshRun {
  std::uint32_t first = 0, count = 0;
  std::uint32_t shape = 0;  // rank of its triangles: runs that follow each other may share them
  bool isPlaced = false;    // by a transform
};
std::vector<MeshRun> findMeshRuns(const RenderScene& scene);

// Whether parts of a mesh are cut out by its material.
inline bool hasCutOuts(const RenderScene& scene, std::size_t mesh) {
  return scene.materialMaps[scene.meshes[mesh].material].coverage != 0;
}

RenderScene makeRenderScene(const pack::Scene& scene);

// Parts of the materials that the geometry of a RenderScene and acceleration structures depend on.
struct GeometryNeeds {
  std::vector<bool> isTraced, hasCutOuts;  // per material
  bool hasMeshTextures = false, hasNormalMaps = false;
  friend bool operator==(const GeometryNeeds&, const GeometryNeeds&) = default;
};
GeometryNeeds findGeometryNeeds(const pack::Scene& scene);

// Replaces everything but geometry and textures: materials, lights, environment. scene: with the meshes, instances,
// textures and GeometryNeeds that `result` was made from.
void updateSurfaces(const pack::Scene& scene, RenderScene& result);

// Cone of the camera's rays (shaders/optics/ray_cone.h), one per sample of a pixel, whose width is the geometric mean
// of the sample's sides: that in the middle of the image.
struct CameraCone {
  double width, spread;
};
CameraCone cameraCone(const pack::Camera& camera, const RenderParameters& parameters);

gpu::CameraParameters makeCameraParameters(const pack::Scene& scene, const RenderParameters& parameters);

// Mean transmittance of a dielectric interface, or 1 - R of a metal, for light from all directions of a
// hemisphere (cosine weighted), per colour.
glm::dvec3 hemisphereTransmittance(const pack::Material& material,
                                   const glm::dvec3& wavelengthsNm = pack::kDefaultWavelengthsNm);

// Twice the thickness over the wavelength of each colour (shaders/optics/film.h).
glm::dvec3 roundTripPhase(const pack::Coating& coating, const glm::dvec3& wavelengthsNm);

// Point i of the unit disk that chooses facet i of a rough surface (shaders/optics/facets.h).
glm::dvec2 facetPoint(std::size_t i);

// A distance from any surface that is beyond all of them: that of shadow rays toward a light at infinity.
double lightReach(const pack::Scene& scene);

// Kind of surface, hence hit group, of a material.
gpu::SurfaceKind surfaceKind(pack::MaterialKind kind);

}  // namespace malus::render

// Structs that C++ and GLSL share, in GLSL's scalar block layout: a vec3 has 12 bytes and an alignment of 4. Positions
// are relative to the scene's origin, those of vertices to that of their mesh, in metres; radiance is in W/(m^2 sr),
// per colour.
#ifdef __cplusplus
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "shaders/gpu/constants.h"

namespace malus::gpu {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using real = float;
using real3 = vec3;
using word = uint;
#define MALUS_SIZE(T, bytes) static_assert(sizeof(T) == (bytes))
#else
#define MALUS_SIZE(T, bytes)
#endif

// Kinds of surface, each with its own hit group. In GLSL the preamble of a variant defines them
// (render/vulkan/variant.cpp).
#ifdef __cplusplus
enum SurfaceKind : uint {
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description) k##id,
#include "shaders/effects.def"
  kSurfaceKinds
};
#endif

#include "shaders/gpu/material.h"
MALUS_SIZE(Material, 92);
MALUS_SIZE(MaterialExtra, 216);
MALUS_SIZE(TextureMap, 44);
MALUS_SIZE(MeshMaps, 48);
MALUS_SIZE(PointLight, 24);
MALUS_SIZE(LightShape, 24);
MALUS_SIZE(MeshTransform, 136);
MALUS_SIZE(AreaLight, 100);
MALUS_SIZE(LightNode, 44);

struct Texture {
  uint first;  // of its texels, row by row from the top
  uint width;
  uint height;
};
MALUS_SIZE(Texture, 12);

struct Mesh {
  uint firstTriangle;
  uint firstVertex;  // of its positions and normals
  uint material;
  uint hasNormals;  // 0: flat shading by the normals of the triangles
  vec3 origin;      // of its positions
};
MALUS_SIZE(Mesh, 28);

struct CameraParameters {
  vec3 position;
  vec3 up;           // unit vector
  vec3 firstSample;  // cameraSampleDirection, or cameraSampleOffset of an orthographic camera (optics/camera.h)
  vec3 firstSampleFine;
  vec3 columnStep;
  vec3 columnStepFine;
  vec3 rowStep;
  vec3 rowStepFine;
  float basicToRadiance;  // square of the index of the medium at the camera
  vec4 analyser;          // first row of the Mueller matrix of the camera's filter
  uint width;             // of the whole image
  uint height;
  uint regionX;  // the part that is rendered, in pixels
  uint regionY;
  uint regionWidth;
  uint regionHeight;
  uint samples;  // rays per pixel and axis
  int depth;     // most specular interactions
  int lightCount;
  int environmentSize;      // texels per side of the octahedral map without its border; 0: constant
  vec3 environment;         // radiance where environmentSize is 0
  float ambientIrradiance;  // fraction of the environment's irradiance that reaches diffuse surfaces
  vec3 irradiance[9];       // coefficients of irradiancePolynomial, per colour
  uint shadows;             // 0: surfaces do not block point lights
  vec3 sun;                 // unit vector toward the sun
  float skyDegree;          // largest degree of linear polarization of the sky
  vec2 facets[kFacets];     // points of the unit disk (optics/facets.h)
  float tolerance;          // iterative methods: fraction of a source's radiance that a path may lose
  vec3 forward;             // unit vector; that of the rays of an orthographic camera
  float coneWidth;          // of the cones of its rays (optics/ray_cone.h), and their growth per length
  float coneSpread;
  uint orthographic;      // not 0: the samples are points of the image, from which parallel rays start
  int areaLightCount;     // 0: no surface lights others
  int lightLevels;        // most nodes between the root of the tree of lights and a light
  uint lightSamples;      // of the area lights, and of the environment, per hit; 1 to 256
  uint environmentLight;  // not 0: the environment is sampled, in place of its ambient irradiance
  uint environmentStep;   // largest power of two that is at most environmentSize
  float lightReach;       // a distance beyond all surfaces
  uint filteredShadows;   // not 0: light passes polarizing elements and thin glass on its way to a surface
};
MALUS_SIZE(CameraParameters, 484);

#ifdef __cplusplus
}  // namespace malus::gpu
#endif
#undef MALUS_SIZE

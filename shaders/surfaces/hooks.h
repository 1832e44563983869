// Functions and data that a renderer supplies to the surfaces. C++ tracers declare them as members, GLSL stages as
// buffers (shaders/stages/bindings.glsl) and functions that may be defined after the surfaces.
//
// Data, as described in shaders/gpu/scene.h:
//   camera               camera, analyser, lights and environment of the image
//   materials[]          by Hit.material
//   lights[]             camera.lightCount lights
//   environmentTexels[]  octahedral map with a border of one texel
//   textures[], textureTexels[]  only with MALUS_EFFECT_TEXTURES or MALUS_EFFECT_MESH_TEXTURES
//   kCheckNumerics       compile-time constant: whether to check every value (check.h)
//
// Functions:
//   MaterialExtra materialExtra(material)
//     Returns the rarer properties of a material. Called only if an effect of the build needs them.
//   LightShape lightShape(index)
//     Returns the shape of a light. Called only with MALUS_EFFECT_LIGHT_SHAPES.
//   Payload traceRay(ray)
//     Traces one ray and shades what it meets. Recursive methods with recursion only.
//   bool findHit(ray, out hit)
//     Returns whether the ray meets a surface, and the nearest hit. Iterative methods, and recursive ones without
//     recursion (shade_stack.h).
//   mask visible(needed, origin, way)
//     Returns whether no surface is between origin and origin + way. Called only if a lane needs it; the result means
//     nothing in the others.
//   AreaLight areaLight(index), LightNode lightNode(index)
//     Only with MALUS_EFFECT_AREA_LIGHTS.
//   real environmentDistribution(index)
//     Entry of RenderScene::environmentDistributions; index is a whole number. Only with
//     MALUS_EFFECT_ENVIRONMENT_LIGHT.
//   mask findShadowHit(needed, ray, out hit)
//     As findHit, for a ray from a hit toward a light, followed by materials[] and materialExtra() of the new hit.
//     Called only if a lane needs it; the hit means nothing in the others. Only with MALUS_EFFECT_FILTERED_SHADOWS, as
//     is
//   void endShadowHits(hit)
//     After the last of them: hit is that from which the rays began.
//   real3 environmentTexel(x, y)
//     Texel of the environment map, border included; x and y are whole numbers.
//   real3 texel(texture, x, y)
//     Texel of a repeated texture; x and y are whole numbers, at most one texel outside. Not kNoTexture in a lane that
//     uses the result. Only with MALUS_EFFECT_TEXTURES or MALUS_EFFECT_MESH_TEXTURES, as is
//   void textureSize(texture, out width, out height)
//   bool hasMeshTextures()
//     Whether a material of the scene has textures by the coordinates of meshes. Only with MALUS_EFFECT_MESH_TEXTURES,
//     as are
//   MeshMaps meshMaps(material), TextureMap textureMap(map)
//   word textureRow(texture, level)
//     The row of textures[] of a level of a texture; level is a whole number.
//   void noteFault(hit, stokes, kind, colour, slack)
//     Records an unphysical value: its kind (shaders/gpu/fault.h), the colour's index, the rounding error allowed.
//     Called only if kCheckNumerics.

#ifndef __cplusplus
#ifdef MALUS_CHECK_NUMERICS
const bool kCheckNumerics = true;
#else
const bool kCheckNumerics = false;
#endif

MaterialExtra materialExtra(word material) {
#if MALUS_MATERIAL_EXTRAS
  return extras[material];
#else
  MaterialExtra unused;
  return unused;
#endif
}

LightShape lightShape(int index) {
#if MALUS_EFFECT_LIGHT_SHAPES
  return lightShapes[index];
#else
  LightShape unused;
  return unused;
#endif
}

#if MALUS_EFFECT_AREA_LIGHTS
AreaLight areaLight(word index) { return areaLights[index]; }
LightNode lightNode(word index) { return lightNodes[index]; }
#endif
#if MALUS_EFFECT_ENVIRONMENT_LIGHT
real environmentDistribution(real index) { return environmentDistributions[int(index)]; }
#endif

real3 environmentTexel(real x, real y) { return environmentTexels[int(y) * (camera.environmentSize + 2) + int(x)]; }

#if MALUS_EFFECT_MESH_TEXTURES
bool hasMeshTextures() { return true; }
MeshMaps meshMaps(word material) { return materialMaps[material]; }
TextureMap textureMap(word map) { return textureMaps[map]; }
word textureRow(word index, real level) { return index + word(level); }
#endif

#if MALUS_EFFECT_TEXTURES || MALUS_EFFECT_MESH_TEXTURES
real3 texel(word index, real x, real y) {
  Texture t = textures[index];
  real column = x < 0.0 ? x + real(t.width) : x >= real(t.width) ? x - real(t.width) : x;
  real row = y < 0.0 ? y + real(t.height) : y >= real(t.height) ? y - real(t.height) : y;
  return textureTexels[int(t.first) + int(row) * int(t.width) + int(column)];
}

void textureSize(word index, OUT(real) width, OUT(real) height) {
  width = real(textures[index].width);
  height = real(textures[index].height);
}
#endif

#ifdef MALUS_STACK_SIZE
bool findHit(Ray ray, OUT(Hit) hit);
#else
Payload traceRay(Ray ray);
#endif
#if MALUS_EFFECT_FILTERED_SHADOWS
mask findShadowHit(mask needed, Ray ray, OUT(Hit) hit) { return findHit(ray, hit); }
void endShadowHits(Hit hit) {}
#endif
mask visible(mask needed, real3 origin, real3 way);
void noteFault(Hit h, vec4 stokes, uint kind, uint colour, float slack);
#endif

// What every stage sees of the scene (render/vulkan/renderer.cpp fills it in the same order).
layout(set = 0, binding = 0) uniform accelerationStructureEXT tlas;
layout(set = 0, binding = 1, scalar) writeonly buffer Pixels { float pixels[]; };
layout(set = 0, binding = 2, scalar) readonly buffer CameraBlock { CameraParameters camera; };
layout(set = 0, binding = 3, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Lights { PointLight lights[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Meshes { Mesh meshes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Triangles { uvec3 triangles[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 8, scalar) readonly buffer Normals { vec3 normals[]; };
layout(set = 0, binding = 9, scalar) readonly buffer EnvironmentTexels { vec3 environmentTexels[]; };
#if MALUS_EFFECT_POLARIZING_ELEMENT || MALUS_EFFECT_TEXTURES || MALUS_EFFECT_ABSORPTION || MALUS_EFFECT_COATINGS || \
    MALUS_EFFECT_ROUGHNESS || MALUS_EFFECT_POLARIZED_EMITTERS
layout(set = 0, binding = 12, scalar) readonly buffer MaterialExtras { MaterialExtra extras[]; };
#endif
#if MALUS_EFFECT_TEXTURES
layout(set = 0, binding = 13, scalar) readonly buffer Textures { Texture textures[]; };
layout(set = 0, binding = 14, scalar) readonly buffer TextureTexels { vec3 textureTexels[]; };
#endif
#ifdef MALUS_CHECK_NUMERICS
layout(set = 0, binding = 11, scalar) shadercallcoherent buffer FaultBlock { Faults faults; };
#endif
#ifdef MALUS_COUNT_RAYS
layout(set = 0, binding = 10, scalar) buffer Counter { uint rayCount; };
void countRay() { atomicAdd(rayCount, 1u); }
#else
void countRay() {}
#endif

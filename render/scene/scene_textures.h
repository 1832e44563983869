// Textures, their pyramids and the texture coordinates of meshes in the float structs of a RenderScene.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_scene.h"

namespace malus::render {

// Returns the next level of a texture's pyramid: half the width and half the height, rounded down and at least 1. A
// texel is the mean of the area of the texture that it covers. Values are linear; normals are averaged as stored,
// so that a level's normals are shorter where they differ.
pack::Texture halfSize(const pack::Texture& texture);

// Adds the textures, those that a mesh map reads with all levels down to one texel.
void addTextures(const pack::Scene& scene, RenderScene& result);

// Replaces the mesh maps of the materials; after the textures.
void addMeshMaps(const pack::Scene& scene, RenderScene& result);

// Number of levels of a texture's pyramid.
std::uint32_t countLevels(std::uint32_t width, std::uint32_t height);

// Adds the texture coordinates and tangents of the meshes, in the order of result.meshes. A mesh without them has
// zeros.
void addTextureCoordinates(const pack::Scene& scene, RenderScene& result);

}  // namespace malus::render

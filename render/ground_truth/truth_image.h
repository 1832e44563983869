// Ground truth as an EXR image of 32-bit floats. Channels are named LAYER.COMPONENT; Depth.Z, Position.X, Normal.X,
// IndexMA.X and IndexOB.X are the names of Blender's passes.
//
//   Depth.Z                       along the camera's forward axis [m]
//   Distance.Z                    along the pixel's ray [m]
//   Position.X .Y .Z              in world space [m]
//   Normal.X .Y .Z                shading normal in world space, against the ray
//   NormalGeometric.X .Y .Z       normal of the triangle in world space, against the ray
//   NormalCamera.X .Y .Z          shading normal in the axes of the camera: x right, y up, z toward the viewer
//   NormalGeometricCamera.X ...   normal of the triangle in these axes
//   Incidence.V                   angle between the ray and the shading normal [radians]
//   IndexMA.X                     index of the material; its name is in the attribute malus:materials
//   IndexOB.X                     index of the mesh or instance; its name is in the attribute malus:meshes
//   Interactions.V                surfaces on the principal path (PixelTruth::interactions)
//   Valid.V                       1 where the ray meets a surface, else 0
//
// Where the ray meets no surface, the indices are -1 and all other channels 0.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "bake/pack/reader.h"
#include "meshprep/base/image.h"
#include "render/ground_truth/ground_truth.h"

namespace malus::render {

// pixels: those of parameters.region, or of a tile of it. Attributes: worldToCamera, malus:scene, malus:pack,
// malus:region (also of a tile that of parameters), and malus:materials and malus:meshes, lists of names in JSON.
image::Image truthImage(std::span<const PixelTruth> pixels, const pack::Pack& pack, const RenderParameters& parameters,
                        std::optional<Region> tile = {});

// Writes the image as .exr. Lossy compression is replaced by zip: it would take the channels .Y for luminance.
void writeTruth(const std::filesystem::path& path, const image::Image& truth, image::ExrCompression compression);

}  // namespace malus::render

// A scene's arrays on the device, one buffer for each MALUS_SCENE_BUFFER of shaders/gpu/bindings.def.
#pragma once

#include "render/scene/render_scene.h"
#include "render/vulkan/bindings.h"

namespace malus::vulkan {

struct SceneBuffers {
  // device: must outlive the buffers. Throws Error.
  SceneBuffers(const Device& device, const render::RenderScene& scene);
  // Replaces the buffers of the arrays that render::updateSurfaces() changes; bind() them afterwards. No command may be
  // reading them. Throws Error.
  void updateSurfaces(const Device& device, const render::RenderScene& scene);
  // Throws Error if a buffer is larger than the device can bind.
  void bind(Bindings& bindings) const;

#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage) Buffer name;
#define MALUS_HOST_BUFFER(number, name, type, access)
#include "shaders/gpu/bindings.def"
};

}  // namespace malus::vulkan

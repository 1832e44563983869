#include "render/vulkan/host_buffers.h"

namespace malus::vulkan {

HostBuffers::HostBuffers(const Device& device, Bindings& bindings) {
#define MALUS_ACCELERATION_STRUCTURE(number, name)
#define MALUS_PIXEL_BUFFER(number, name, element)
#define MALUS_SCENE_BUFFER(number, name, element, usage)
#define MALUS_HOST_BUFFER(number, name, type, access) \
  name = HostBuffer<gpu::type>(device, #name);        \
  bindings.bind(Binding::name, name.buffer());
#include "shaders/gpu/bindings.def"
}

}  // namespace malus::vulkan

// Compiled variants of the shaders for one scene.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "render/scene/render_scene.h"
#include "render/vulkan/pipeline.h"
#include "render/vulkan/shader_table.h"

namespace malus::vulkan {

struct Program {
  std::unique_ptr<const Pipeline> pipeline;
  ShaderTable table;
  double compileMs;       // shaders and pipeline, by the clock of the host
  bool isTraced = false;  // drivers finish compiling at the first trace
};

class Programs {
 public:
  struct Key {
    Variant variant;
    std::uint32_t recursion = 1;  // as for Pipeline
    auto operator<=>(const Key&) const = default;
  };

  // device, scene, bindings: must outlive the programs.
  Programs(const Device& device, const render::RenderScene& scene, VkDescriptorSetLayout bindings)
      : device_(device), scene_(scene), bindings_(bindings) {}

  // Compiles a program at its first use. The reference is valid as long as this object. Throws Error.
  Program& get(const Key& key);

  // Compiles programs in parallel. Those that fail are left to get(). Ends early if interrupted.
  void compile(const std::vector<Key>& keys);

 private:
  Program& add(const Key& key, std::unique_ptr<const Pipeline> pipeline, double compileMs);

  const Device& device_;
  const render::RenderScene& scene_;
  VkDescriptorSetLayout bindings_;
  std::map<Key, Program> programs_;
};

}  // namespace malus::vulkan

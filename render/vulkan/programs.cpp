#include "render/vulkan/programs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "meshprep/base/error.h"
#include "meshprep/base/interrupt.h"

namespace malus::vulkan {
using Clock = std::chrono::steady_clock;

namespace {

struct Compiled {
  std::unique_ptr<const Pipeline> pipeline;  // null: failed
  double ms = 0;
};

Compiled compilePipeline(const Device& device, const Programs::Key& key, VkDescriptorSetLayout bindings) {
  const auto start = Clock::now();
  Compiled result{std::make_unique<const Pipeline>(device, key.variant, bindings, key.recursion)};
  result.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return result;
}

// Threads that compile pipelines. Mesa's lavapipe translates the same shaders to other code after other pipelines have
// been created, and caches compiled code by this code: created by several threads, in an order that varies, a fifth of
// the pipelines of `malus compare` missed the cache. It compiles at the first trace, so that threads would save little.
std::size_t countThreads(const Device& device) {
  return device.physical().type == VK_PHYSICAL_DEVICE_TYPE_CPU ? 1 : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace

Program& Programs::add(const Key& key, std::unique_ptr<const Pipeline> pipeline, double compileMs) {
  ShaderTable table(device_, pipeline->get(), stageSources(key.variant), scene_);
  return programs_.emplace(key, Program{std::move(pipeline), std::move(table), compileMs}).first->second;
}

Program& Programs::get(const Key& key) {
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
  Compiled compiled = compilePipeline(device_, key, bindings_);
  return add(key, std::move(compiled.pipeline), compiled.ms);
}

void Programs::compile(const std::vector<Key>& keys) {
  std::vector<Key> missing;
  for (const Key& key : keys)
    if (!programs_.contains(key) && std::find(missing.begin(), missing.end(), key) == missing.end())
      missing.push_back(key);
  std::vector<Compiled> compiled(missing.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < missing.size() && !interrupted(); i = next++) try {
        compiled[i] = compilePipeline(device_, missing[i], bindings_);
      } catch (const std::exception&) {  // reported by get()
      }
  };
  std::vector<std::jthread> threads(std::min(missing.size(), countThreads(device_)));
  for (std::jthread& thread : threads) thread = std::jthread(work);
  threads.clear();  // waits
  // Tables are uploaded by the only queue.
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (compiled[i].pipeline) add(missing[i], std::move(compiled[i].pipeline), compiled[i].ms);
}

}  // namespace malus::vulkan

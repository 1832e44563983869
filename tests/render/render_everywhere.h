// One scene on every renderer that has Stokes vectors.
#pragma once

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/vulkan/renderer.h"

namespace malus::test {

// The image by every renderer with Stokes vectors, by its name.
inline std::map<std::string, render::RenderResult> renderEverywhere(const pack::Scene& scene,
                                                                    render::RenderParameters parameters) {
  parameters.stokes = true;
  embree::Renderer embree(scene, 0);
  vulkan::Renderer vulkan(scene, {});
  std::map<std::string, render::RenderResult> results;
  for (const char* method : {"stokes", "importance"})
    results[std::string("vulkan ") + method] = vulkan.render(method, parameters);
  parameters.checkNumerics = true;
  results["reference"] = reference::render(scene, parameters, 0);
  for (const char* method : {"stokes", "importance"})
    results[std::string("embree ") + method] = embree.render(method, parameters);
  for (const auto& [name, result] : results) EXPECT_EQ(result.faults.count, 0u) << name;
  return results;
}
inline std::map<std::string, render::RenderResult> renderEverywhere(const pack::Scene& scene) {
  return renderEverywhere(scene, render::defaultParameters(scene));
}

}  // namespace malus::test

// One scene on every renderer that has Stokes vectors.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/vulkan/renderer.h"

namespace malus::test {

// S0..S3 of one colour of a pixel, of an image with Stokes vectors.
using Stokes = std::array<double, 4>;
inline Stokes stokesAt(const render::RenderResult& image, std::size_t pixel, std::size_t colour) {
  Stokes s{};
  for (std::size_t k = 0; k < 4; ++k) s[k] = image.pixels[pixel * image.channels + 3 + 3 * k + colour];
  return s;
}
inline std::size_t middlePixel(const render::RenderResult& image) { return image.pixels.size() / image.channels / 2; }

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

// The error of a combination, estimated from the small image and from tiles of the full one.
#pragma once

#include <memory>
#include <vector>

#include "bake/pack/scene.h"
#include "render/budget/combination.h"
#include "render/budget/display_error.h"
#include "render/renderer_pool.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Method, parameters and scene that render a combination.
struct PlannedImage {
  std::string method;
  RenderParameters parameters;
  std::shared_ptr<const pack::Scene> scene;  // without effects; null: the whole one
};
PlannedImage planImage(const pack::Scene& scene, const Combination& combination, const RenderParameters& parameters);

struct CheckedError {
  double relRms = 0;      // upper bound of a one-sided confidence interval of about 97.5 %
  double wrongShare = 0;  // expected share of pixels with an error above 1 %
};

// Estimates errors against the complete image by stratified sampling. The pixels of the small image are samples of the
// full one outside of the tiles: kTiles blocks of kTileSide pixels of the full image, where the small image differs
// most, which are rendered by both. Thin structures that the small image hits once are so seen at full resolution.
inline constexpr std::uint32_t kTileSide = 64, kTiles = 12;
class ErrorCheck {
 public:
  // full: parameters of the complete image, of method. pool must outlive this.
  ErrorCheck(const pack::Scene& scene, std::string method, const RenderParameters& full, RendererPool& pool);
  // Renders the combination small and in tiles. Throws as Renderer::render() does.
  CheckedError operator()(const Combination& combination);

 private:
  std::vector<Region> chooseTiles(const std::vector<SquaredError>& small) const;

  const pack::Scene& scene_;
  std::string method_;
  RenderParameters full_, small_;
  RendererPool& pool_;
  RenderResult complete_;  // small
};

}  // namespace malus::render

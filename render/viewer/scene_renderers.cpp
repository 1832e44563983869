#include "render/viewer/scene_renderers.h"

#include <algorithm>

#include "bake/effects/effects.h"
#include "render/scene/left_out.h"

namespace malus::viewer {

struct SceneRenderers::Entry {
  render::Backend backend;
  std::vector<std::string> off;
  std::unique_ptr<pack::Scene> reduced;  // null: the whole scene
  std::unique_ptr<render::Renderer> renderer;
};

SceneRenderers::SceneRenderers(const Host& host, const pack::Scene& scene, render::RendererOptions options)
    : host_(host), options_(std::move(options)), whole_(std::make_unique<pack::Scene>(scene)) {}

SceneRenderers::~SceneRenderers() = default;

SceneRenderers::Entry& SceneRenderers::entry(render::Backend backend, const std::vector<std::string>& off) {
  const auto found =
      std::ranges::find_if(entries_, [&](const auto& entry) { return entry->backend == backend && entry->off == off; });
  if (found != entries_.end()) {
    std::rotate(entries_.begin(), found, found + 1);
    return *entries_.front();
  }
  auto added = std::make_unique<Entry>();
  added->backend = backend;
  added->off = off;
  if (bake::canBeRemoved(off)) added->reduced = std::make_unique<pack::Scene>(bake::withoutEffects(*whole_, off));
  added->renderer = host_.makeRenderer(backend, added->reduced ? *added->reduced : *whole_, options_);
  entries_.insert(entries_.begin(), std::move(added));
  if (entries_.size() > kMost) entries_.resize(kMost);
  return *entries_.front();
}

void SceneRenderers::releaseUnused() {
  constexpr std::size_t kUsed = 2;  // by the sides
  for (std::size_t i = kUsed; i < entries_.size(); ++i) entries_[i]->renderer->releaseTargets();
}

SideImage SceneRenderers::prepare(const render::JobSettings& settings) {
  SideImage image;
  image.parameters = host_.renderParameters(settings, *whole_);
  const render::ImageChoice choice = host_.chooseImage(settings, image.parameters, *whole_);
  render::switchOff(choice.off, image.parameters);
  Entry& chosen = entry(settings.backend, choice.off);
  image.renderer = chosen.renderer.get();
  image.scene = chosen.reduced ? chosen.reduced.get() : whole_.get();
  image.method = choice.method;
  image.substitutedFor = choice.substitutedFor;
  image.warnings = choice.warnings;
  return image;
}

}  // namespace malus::viewer

#include "render/viewer/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/effects/effects.h"
#include "meshprep/base/error.h"

namespace malus::viewer {

namespace {

// With the filter and every Stokes channel requested, so that a switch of the display needs no other effects.
std::vector<pack::Effect> neededEffects(const pack::Scene& scene) {
  bake::ImageRequest request;
  request.depth = scene.depth;
  request.linearStokes = request.circularStokes = true;
  return bake::findEffects(scene, request);
}

}  // namespace

Session::Session(const Request& request, const Host& host, const DisplayDevice& device,
                 const std::function<void()>& notify)
    : state(request.state),
      request_(request),
      file_{request.file, request.pack->scene.origin, neededEffects(request.pack->scene)},
      stores_(device),
      renders_(host, request.pack->scene, {request.device, request.threads}, stores_, file_.needed, notify),
      background_(host, request.pack->scene, {request.device, request.threads}, stores_, file_.needed, notify) {}

std::uint64_t Session::update(std::uint32_t width, std::uint32_t height) {
  if (const std::string failure = renders_.failure(); !failure.empty()) throw Error("", failure);
  Wish next{wish_ ? wish_->generation : 0, width, height, state};
  if (!wish_ || needsRender(*wish_, next, file_.needed)) {
    ++next.generation;
    renders_.submit(next);
  }
  wish_ = next;
  return wish_->generation;
}

bool Session::updateBackground(const Published& published) {
  background_.setView(*wish_);
  const bool isStill = published.isComplete && published.generation == wish_->generation;
  background_.requestReference(state.usesReference && isStill);
  const bool showsFlip = state.shown == Quantity::flip;
  const bool againstOther = state.comparesSides();
  if (!isStill || (!state.usesReference && !(showsFlip && againstOther))) return false;
  // Errors take seconds, and depend on what changes while a polarizer turns: only of a view that is still.
  const render::Analyser analyser = state.filter.analyser();
  const std::string key = fmt::format("{} {} {} {} {} {}", wish_->generation, fmt::join(analyser, " "),
                                      state.exposureEv, showsFlip, againstOther, published.images);
  const auto now = std::chrono::steady_clock::now();
  if (key != errorKey_) {
    errorKey_ = key;
    errorKeyChanged_ = now;
    isErrorRequested_ = false;
  }
  constexpr std::chrono::milliseconds kStill(250);
  if (isErrorRequested_) return false;
  if (now - errorKeyChanged_ < kStill) return true;
  isErrorRequested_ = true;
  background_.requestErrors({wish_->generation,
                             {published.sides[0].fine, published.sides[1].fine},
                             analyser,
                             state.exposureEv,
                             againstOther,
                             showsFlip});
  return false;
}

void Session::probe(std::uint32_t x, std::uint32_t y) {
  if (wish_) background_.requestPixel({wish_->generation, x, y});
}

DisplayInput Session::input(const Published& published) const {
  DisplayInput input = displayInput(state, published, width());
  const BackgroundState background = background_.state();
  if (background.generation != generation()) return input;
  input.reference = background.reference;
  input.flip = background.flip;
  return input;
}

pack::Pack Session::viewedPack() const {
  pack::Pack viewed;
  viewed.hash = pack().hash;
  viewed.scene.name = pack().scene.name;
  viewed.scene.origin = pack().scene.origin;
  viewed.scene.camera = wish_->state.camera;
  return viewed;
}

std::string Session::command(std::size_t side, const std::string& output) const {
  return renderCommand(state, state.sides[side], file_, width(), height(), output);
}

}  // namespace malus::viewer

#include "render/viewer/session.h"

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
      renders_(host, request.pack->scene, {request.device, request.threads}, stores_, file_.needed, notify) {}

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

DisplayInput Session::input() const { return displayInput(state, renders_.published(), width()); }

std::string Session::command(std::size_t side, const std::string& output) const {
  return renderCommand(state, state.sides[side], file_, width(), height(), output);
}

}  // namespace malus::viewer

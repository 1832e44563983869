#include "render/renderer.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

RenderResult Renderer::renderTo(std::string_view, const RenderParameters&, const SharedPixels&, std::size_t) {
  throw Error("", fmt::format("{} does not share the memory of images", device()));
}

}  // namespace malus::render

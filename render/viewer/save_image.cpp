#include "render/viewer/save_image.h"

#include <filesystem>

#include "meshprep/base/error.h"
#include "meshprep/base/image.h"
#include "render/image/output.h"
#include "render/viewer/filtered_colours.h"

namespace malus::viewer {

namespace {

void saveExr(const std::string& file, const Session& session) {
  const PublishedSide side = session.renders().published().sides[0];
  if (!side.fine.isComplete()) throw Error(file, "the image is not complete yet", "a still view");
  const Wish& wish = session.wish();
  render::RenderResult result = filteredImage(side.fine, wish.state.filter.analyser());
  result.device = side.device;
  render::RenderParameters parameters;
  parameters.width = wish.width;
  parameters.height = wish.height;
  parameters.region = {0, 0, wish.width, wish.height};
  parameters.depth = wish.state.depth;
  parameters.samples = wish.state.samples;
  parameters.analyser = wish.state.filter.analyser();
  image::writeExr(file, render::takeImage(result, session.viewedPack(), parameters,
                                          render::backendInfo(wish.state.sides[0].backend).name, side.method));
}

}  // namespace

void savePng(const std::string& file, const DisplayDevice& device, const DisplayImageTarget& target) {
  image::writePng(file, static_cast<int>(target.width()), static_cast<int>(target.height()), 3,
                  readTarget(device, target));
}

void saveImage(const std::string& file, const Session& session, const DisplayDevice& device,
               const DisplayImageTarget& target) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".exr")
    saveExr(file, session);
  else if (extension == ".png")
    savePng(file, device, target);
  else
    throw Error(file, "unknown image format", ".exr or .png", extension.empty() ? "no extension" : extension);
}

}  // namespace malus::viewer

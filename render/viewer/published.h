// Images that the render thread and the background reference hand to the display.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/viewer/pixel_store.h"

namespace malus::viewer {

// The upper `rows` rows of an image of width x height pixels, channels as in render/scene/render_result.h.
struct ImageRows {
  std::shared_ptr<PixelStore> store;  // null: no image
  std::uint32_t width = 0, height = 0, channels = 0, rows = 0;

  bool isComplete() const { return store && rows == height; }
};

struct PublishedSide {
  ImageRows coarse;  // complete, stretched to the window
  ImageRows fine;    // full resolution, in front of it
  // Of the last image: rays and shading, scaled to the full resolution [ms].
  double traceMs = 0;
  double medianMs = 0;         // of the last 30 images at full resolution
  std::uint64_t rays = 0;      // of the last complete image; 0 if they were not counted
  std::string method;          // that rendered
  std::string substitutedFor;  // as render::Job::substitutedFor()
  std::string device;
  std::string path;               // of the rays: packet, scalar, pipeline or query
  bool isShared = false;          // the image stays on the device; else it is copied to the display by the host
  std::uint64_t copiedBytes = 0;  // of pixels by the host, since the side was prepared
  std::vector<std::string> warnings;
  std::string problem;  // reason if there is no new image; else empty
};

struct Published {
  std::uint64_t generation = 0;  // of the wish that is shown
  std::array<PublishedSide, 2> sides;
  double fraction = 1;       // share of the resolution of the coarse images
  bool isComplete = false;   // every side at full resolution
  std::uint64_t images = 0;  // number of coarse and full images so far
};

}  // namespace malus::viewer

#include "render/budget/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/budget/measure.h"
#include "render/scene/left_out.h"

namespace malus::render {

namespace {

// The region of the full image that a pixel of the small one is a sample of, relative to the whole region.
struct Scale {
  double x, y;
};

bool isInside(double x, double y, const Region& r) {
  return x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height;
}

// Mean and standard error of the squared differences of the pixels outside of the tiles.
struct Outside {
  double mean = 0, standardError = 0, reference = 0, wrong = 0;
};

Outside summarize(const std::vector<SquaredError>& pixels) {
  Outside result;
  if (pixels.empty()) return result;
  const double n = static_cast<double>(pixels.size());
  double squares = 0;
  for (const SquaredError& e : pixels) {
    result.mean += e.difference / n;
    squares += e.difference * e.difference / n;
    result.reference += e.reference / n;
    result.wrong += static_cast<double>(e.wrongPixels) / n;
  }
  const double variance = std::max(0.0, squares - result.mean * result.mean);
  result.standardError = std::sqrt(variance / n);
  return result;
}

}  // namespace

PlannedImage planImage(const pack::Scene& scene, const Combination& combination, const RenderParameters& parameters) {
  PlannedImage image{combination.method, parameters, nullptr};
  image.parameters.depth = std::min(combination.depth, parameters.depth);
  image.parameters.tolerance = combination.tolerance;
  if (!combination.off.empty()) image.scene = leaveOut(scene, combination.off, image.parameters);
  return image;
}

ErrorCheck::ErrorCheck(const pack::Scene& scene, std::string method, const RenderParameters& full, RendererPool& pool)
    : scene_(scene), method_(std::move(method)), full_(full), small_(smallParameters(full)), pool_(pool) {
  complete_ = pool_[nullptr].render(method_, small_);
}

std::vector<Region> ErrorCheck::chooseTiles(const std::vector<SquaredError>& small) const {
  const Region& r = full_.region;
  const std::uint32_t columns = (r.width + kTileSide - 1) / kTileSide, rows = (r.height + kTileSide - 1) / kTileSide;
  const Scale scale{static_cast<double>(r.width) / complete_.width, static_cast<double>(r.height) / complete_.height};
  std::vector<std::pair<double, std::uint32_t>> blocks(std::size_t{columns} * rows);
  for (std::uint32_t i = 0; i < blocks.size(); ++i) blocks[i].second = i;
  for (std::size_t i = 0; i < small.size(); ++i) {
    const double x = (static_cast<double>(i % complete_.width) + 0.5) * scale.x,
                 y = (static_cast<double>(i / complete_.width) + 0.5) * scale.y;
    const auto column = static_cast<std::uint32_t>(x / kTileSide), row = static_cast<std::uint32_t>(y / kTileSide);
    blocks[std::size_t{row} * columns + column].first += small[i].difference;
  }
  std::sort(blocks.begin(), blocks.end(), std::greater<>());
  std::vector<Region> tiles;
  for (std::size_t i = 0; i < std::min<std::size_t>(kTiles, blocks.size()); ++i) {
    const std::uint32_t x = blocks[i].second % columns * kTileSide, y = blocks[i].second / columns * kTileSide;
    tiles.push_back({r.x + x, r.y + y, std::min(kTileSide, r.width - x), std::min(kTileSide, r.height - y)});
  }
  return tiles;
}

CheckedError ErrorCheck::operator()(const Combination& combination) {
  // Compare the small images pixel by pixel.
  const PlannedImage small = planImage(scene_, combination, small_);
  const RenderResult image = pool_[small.scene].render(small.method, small.parameters);
  std::vector<SquaredError> pixels;
  for (std::size_t i = 0; i < std::size_t{image.width} * image.height; ++i)
    pixels.push_back(pixelError(image.pixels.data() + i * image.channels,
                                complete_.pixels.data() + i * complete_.channels, scene_.exposureEv));

  // Compare the tiles where they differ most.
  const Region& r = full_.region;
  const bool isFull = r.width == complete_.width && r.height == complete_.height && full_.samples == 1;
  const std::vector<Region> tiles = isFull ? std::vector<Region>() : chooseTiles(pixels);
  SquaredError inside;
  for (const Region& tile : tiles) {
    PlannedImage part = planImage(scene_, combination, full_);
    RenderParameters whole = full_;
    part.parameters.region = whole.region = tile;
    part.scene = small.scene;
    inside += displayError(pool_[part.scene].render(part.method, part.parameters),
                           pool_[nullptr].render(method_, whole), scene_.exposureEv);
  }

  // Add the rest, from the small image.
  std::vector<SquaredError> rest;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double x = r.x + (static_cast<double>(i % image.width) + 0.5) * r.width / image.width,
                 y = r.y + (static_cast<double>(i / image.width) + 0.5) * r.height / image.height;
    if (std::none_of(tiles.begin(), tiles.end(), [&](const Region& tile) { return isInside(x, y, tile); }))
      rest.push_back(pixels[i]);
  }
  const Outside outside = summarize(rest);
  const double count = static_cast<double>(r.width) * r.height - static_cast<double>(inside.pixels);
  SquaredError total = inside;
  total.difference += count * (outside.mean + (isFull ? 0 : 2 * outside.standardError));
  total.reference += count * outside.reference;
  return {total.relRms(), (static_cast<double>(inside.wrongPixels) + count * outside.wrong) /
                              (count + static_cast<double>(inside.pixels))};
}

}  // namespace malus::render

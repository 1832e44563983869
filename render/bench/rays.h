// The cost of the rays of an image alone, beside that of the renderer that traces them (`malus bench rays`).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "render/backend.h"
#include "render/embree/ray_log.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Rays of one class, by the fastest call of Embree, or by the faster path of a Vulkan device.
struct ClassFloor {
  embree::RayClass kind;
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;  // by the first call
  std::string bestCall;
  double ms = 0;                                      // of bestCall
  double singleMs = 0;                                // by the first call: of Embree, single rays as they were traced
  std::vector<std::pair<std::string, double>> calls;  // every call [ms]
};

// The rays of one or several methods.
struct RayFloor {
  std::vector<std::string> methods;  // that trace exactly these rays in this order
  std::vector<ClassFloor> classes;

  double ms() const;        // sum over the classes
  double singleMs() const;  // the same of single rays
  std::uint64_t rays() const;
};

struct BenchRow {
  Backend backend = Backend::embree;
  std::string method, path;     // path: as on the command line
  std::size_t floor = 0;        // index of its rays in the floors of the backend
  std::vector<double> samples;  // time of tracing and shading in each round [ms]

  double totalMs() const;  // minimum, as the floor's
};

struct RaysBench {
  std::string scene, device;  // device: Embree
  std::string vulkanDevice;   // empty: not measured
  std::uint32_t width = 0, height = 0;
  unsigned rounds = 0;
  std::vector<RayFloor> floors;        // of Embree; empty: not measured
  std::vector<RayFloor> vulkanFloors;  // of the same rays, in the same order
  std::vector<BenchRow> rows;

  const RayFloor& floor(const BenchRow& row) const {
    return (row.backend == Backend::vulkan ? vulkanFloors : floors)[row.floor];
  }
};

struct RaysBenchSettings {
  std::vector<std::string> methods;
  std::vector<Backend> backends = {Backend::embree};
  std::string device;    // Vulkan, as for makeRenderer()
  unsigned threads = 0;  // 0: all
  unsigned rounds = 5;
};

// Logs the rays of each method once, by Embree. Then, in each round and by each backend, replays every class of rays by
// every call (Vulkan: path) and renders every method by every path. Times are the least over the rounds. Throws Error
// if the rays do not fit into half of the memory, or if there is no Vulkan device.
RaysBench benchRays(const pack::Scene& scene, const RenderParameters& parameters, const RaysBenchSettings& settings);

// {scene, device, machine, date, width, height, rounds, floorMs, singleMs, classes, rows, otherFloors, vulkan}:
// floorMs, singleMs and classes are those of the first method. classes: {depth, shadow, rays, hits, bestCall, ms,
// singleMs, calls: {NAME: ms}}. rows: {backend, method, path, rays, floorMs, totalMs, medianMs, ratio}, ratio = totalMs
// / floorMs. otherFloors: {methods, floorMs, singleMs, classes} of the methods that trace other rays. Without Embree:
// without floorMs, singleMs, classes and otherFloors. vulkan: {device, floors}, or null; its floors are as otherFloors,
// without singleMs.
nlohmann::json toJson(const RaysBench& bench);

// The same as text.
std::string toTable(const RaysBench& bench);

}  // namespace malus::render

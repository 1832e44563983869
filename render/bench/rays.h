// The cost of the rays of an image alone, beside that of the renderer that traces them (`malus bench rays`).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "render/backend.h"
#include "render/embree/ray_log.h"
#include "render/scene/embree_path.h"
#include "render/scene/render_parameters.h"
#include "render/scene/vulkan_path.h"

namespace malus::render {

// Rays of one class, by the fastest call of Embree, or by the faster path of a Vulkan device.
struct ClassFloor {
  embree::RayClass kind;
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;  // by the first call
  // Every call and its least time [ms]. The first one of Embree is that of single rays, in the order of the render.
  std::vector<std::pair<std::string, double>> calls;

  const std::string& bestCall() const;
  double ms() const;  // of bestCall()
  double singleMs() const { return calls.front().second; }
  // Keeps the time of call i if it is the least.
  void add(std::size_t i, double ms, std::uint64_t hitsOfCall);
};
// Time of a call that was not made yet.
inline constexpr double kNotTimed = std::numeric_limits<double>::infinity();

// The rays of one or several methods.
struct RayFloor {
  std::vector<std::string> methods;  // that trace exactly these rays in this order
  std::vector<ClassFloor> classes;

  double ms() const;        // sum over the classes
  double singleMs() const;  // the same of single rays
  std::uint64_t rays() const;
};

struct BenchRow {
  std::string method;
  std::variant<EmbreePath, VulkanPath> path;
  std::size_t floor = 0;          // index of its rays in the floors of the backend
  std::vector<double> samples{};  // time of tracing and shading in each round [ms]

  Backend backend() const { return std::holds_alternative<VulkanPath>(path) ? Backend::vulkan : Backend::embree; }
  const char* pathName() const;  // as on the command line
  double totalMs() const;        // minimum, as the floor's
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
    return (row.backend() == Backend::vulkan ? vulkanFloors : floors)[row.floor];
  }
};

struct RaysBenchSettings {
  std::vector<std::string> methods;
  std::vector<Backend> backends = {Backend::embree};
  std::string device;    // Vulkan, as for makeRenderer()
  unsigned threads = 0;  // 0: all
  unsigned rounds = 5;
  std::string rayFile{};  // takes the rays of the first method (cli.h); empty: none
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

// The cost of the rays of an image alone, beside that of the renderer that traces them (`malus bench rays`).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/pack/scene.h"
#include "render/embree/ray_replay.h"
#include "render/scene/embree_path.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

// Rays of one class, by the fastest call of Embree.
struct ClassFloor {
  embree::RayClass kind;
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;  // of single rays
  embree::RayCall bestCall;
  double ms = 0;                                      // of bestCall
  double singleMs = 0;                                // single rays in the order in which they were traced
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
  std::string method;
  EmbreePath path = EmbreePath::packet;
  std::size_t floor = 0;        // index of its rays in RaysBench::floors
  std::vector<double> samples;  // time of tracing and shading in each round [ms]

  double totalMs() const;  // minimum, as the floor's
};

struct RaysBench {
  std::string scene, device;
  std::uint32_t width = 0, height = 0;
  unsigned rounds = 0;
  std::vector<RayFloor> floors;
  std::vector<BenchRow> rows;
};

struct RaysBenchSettings {
  std::vector<std::string> methods;
  unsigned threads = 0;  // 0: all
  unsigned rounds = 5;
};

// Logs the rays of each method once. Then, in each round, replays every class of rays by every call and renders every
// method by packets and by single rays. Times are the least over the rounds. Throws Error if the rays do not fit into
// half of the memory.
RaysBench benchRays(const pack::Scene& scene, const RenderParameters& parameters, const RaysBenchSettings& settings);

// {scene, device, machine, date, width, height, rounds, floorMs, singleMs, classes, rows, otherFloors}: floorMs and
// classes are those of the first method. classes: {depth, shadow, rays, hits, bestCall, ms, singleMs,
// calls: {NAME: ms}}. rows: {method,
// path, rays, floorMs, totalMs, medianMs, ratio}, ratio = totalMs / floorMs. otherFloors: {methods, floorMs, singleMs,
// classes} of the methods that trace other rays.
nlohmann::json toJson(const RaysBench& bench);

// The same as text.
std::string toTable(const RaysBench& bench);

}  // namespace malus::render

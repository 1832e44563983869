// The logged rays of several methods, and the times of their replays.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/bench/rays.h"
#include "render/embree/ray_replay.h"
#include "render/embree/renderer.h"

namespace malus::render {

class RaySets {
 public:
  struct Class {
    ClassFloor floor;
    embree::RayArrays traced, sorted;
  };
  struct Set {
    std::vector<std::string> methods;
    std::vector<Class> classes;
  };

  // renderer must outlive the object. Rays are those of renders with parameters.
  RaySets(embree::Renderer& renderer, const RenderParameters& parameters);

  // Logs the rays of a method. Returns the index of its set: that of an earlier method if they are the same. Throws
  // Error if the rays do not fit into half of the memory. Packets may trace a few rays more or less: a ray that meets
  // an edge may meet either triangle.
  std::size_t add(const std::string& method);

  // Traces every class of every set once by every call.
  void replayRound();

  const std::vector<Set>& sets() const { return sets_; }

  // Of the rounds so far, at least one.
  std::vector<RayFloor> floors() const;

 private:
  void requireMemory(std::uint64_t rays) const;

  embree::Renderer& renderer_;
  RenderParameters parameters_;
  std::vector<embree::RayCall> calls_;
  std::vector<Set> sets_;
  std::uint64_t stored_ = 0;  // rays of all sets
};

}  // namespace malus::render

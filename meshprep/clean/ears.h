// Triangulation of simple polygons by ear clipping: G. H. Meisters, "Polygons have ears", American Mathematical
// Monthly 82, 1975.
//
// A small polygon loses the ear with the smallest index first. The boundary of a large one is traversed repeatedly, and
// about every second corner is clipped per round, so that triangles stay short and few corners are near them; a grid
// finds these. A corner is tested again only after one of its neighbours, or the corner found inside its triangle, is
// removed. Most polygons need some tens of tests per corner, some need the square of the number of corners or more;
// therefore tests are limited by a budget.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/clean/flat_polygon.h"

namespace malus::prep {

// Reuses its memory for all polygons.
class EarCutter {
 public:
  enum class Outcome { kDone, kNoEars, kTooMuchWork };

  // Appends the triangles, or nothing if there are no more ears (the polygon is not simple) or no more tests. Reduces
  // `tests`, the rest of the budget, by the used tests (a few nanoseconds each).
  Outcome cut(const FlatPolygon& flat, std::uint64_t& tests, std::vector<glm::uvec3>& triangles);

 private:
  struct Cells {
    std::uint32_t beginX, endX, beginY, endY;
  };

  void makeRing();
  void makeGrid();
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;
  void remove(std::uint32_t corner);
  void enqueue(std::uint32_t corner);
  void wait(std::uint32_t corner, std::uint32_t until);
  void stopWaiting(std::uint32_t corner);
  std::optional<std::uint32_t> cornerInside(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                            std::uint64_t& tests) const;

  const FlatPolygon* flat_ = nullptr;

  // Remaining boundary.
  std::vector<std::uint32_t> next_, prev_;

  // Corners to test: a heap of round and index, the smallest first. An entry is valid if it equals key_ of the corner.
  // Other corners wait, in lists, for the removal of another one.
  std::vector<std::uint64_t> heap_, key_;
  std::uint64_t round_ = 0;
  std::vector<std::uint32_t> waitsFor_, firstWaiting_, nextWaiting_, prevWaiting_;

  // Corners by cells of a grid of columns_ x columns_: cell k has count_[k] corners from members_[begin_[k]] on.
  std::uint32_t columns_ = 1;
  glm::dvec2 origin_{0}, cellsPerUnit_{0};
  std::vector<std::uint32_t> begin_, count_, members_, slot_, cell_;
};

}  // namespace malus::prep

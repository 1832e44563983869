// Any polygon that does not cross itself into triangles, one ear after the other: G. H. Meisters, "Polygons have
// ears", American Mathematical Monthly 82, 1975.
//
// Of a small polygon the ear of the smallest number is cut first. Of a large one the boundary is gone around again and
// again, and about every other corner is cut in each round, so that triangles stay short and few corners are near them;
// those are looked for in a grid. Whether a corner is an ear is asked again only when one of its neighbours, or the
// corner found inside its triangle, is gone. Most polygons take a few tens of tests a corner, but some take as many
// as the square of their corners or more, so tests are counted against a budget.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/clean/flat_polygon.h"

namespace malus::prep {

// Keeps its memory from one polygon to the next.
class EarCutter {
 public:
  enum class Outcome { kDone, kNoEars, kTooMuchWork };

  // Adds the triangles, or nothing where ears run out (the polygon crosses itself) or the tests do. `tests` is what is
  // left of the budget, a few nanoseconds each; it is reduced.
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
  void ask(std::uint32_t corner);
  void wait(std::uint32_t corner, std::uint32_t until);
  void stopWaiting(std::uint32_t corner);
  std::optional<std::uint32_t> cornerInside(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                            std::uint64_t& tests) const;

  const FlatPolygon* flat_ = nullptr;

  // What is left of the boundary.
  std::vector<std::uint32_t> next_, prev_;

  // Corners to ask whether they are ears: a heap of round and number, the smallest first. What it holds of a corner
  // counts where it equals key_. Others wait, in lists, until another one is gone.
  std::vector<std::uint64_t> heap_, key_;
  std::uint64_t round_ = 0;
  std::vector<std::uint32_t> waitsFor_, firstWaiting_, nextWaiting_, prevWaiting_;

  // Corners by cell of a grid of columns_ x columns_: those of cell k are members_[begin_[k]] and on, count_[k] of
  // them.
  std::uint32_t columns_ = 1;
  glm::dvec2 origin_{0}, cellsPerUnit_{0};
  std::vector<std::uint32_t> begin_, count_, members_, slotOf_, cellOf_;
};

}  // namespace malus::prep

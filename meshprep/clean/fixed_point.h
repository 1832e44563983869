// Cleaning: all steps, repeated until the mesh does not change.
//
// The steps depend on each other: splitting of fans may require a component to be flipped, pairing at edges depends on
// orientation, a flipped face may be a duplicate of another, and a cap connects components. A mesh that does not touch
// itself needs one pass. In further passes the mesh is treated as if it was read from a file, so that cleaning a
// cleaned mesh changes nothing; their changes are reported too. If a step other than `unreferenced` is skipped, there
// is one pass.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/duplicate_faces.h"
#include "meshprep/clean/fans.h"
#include "meshprep/clean/holes.h"
#include "meshprep/clean/orient.h"
#include "meshprep/clean/weld.h"

namespace malus::prep {

// Steps of cleaning, and their parameters.
struct Cleaning {
  bool weld = true;
  bool degenerate = true;  // fans requires it
  bool duplicates = true;
  bool unreferenced = true;
  bool orient = true;
  bool fans = true;
  bool openSurface = false;     // orient: never flip whole components
  bool dropOpposite = false;    // duplicates: drop the later one of two faces back to back
  double weldTolerance = 0;     // metres, 0 or more
  std::uint64_t fillHoles = 0;  // fill holes of at most this number of edges; 0: none
  std::string where = "mesh";   // name of the mesh in messages
};

// Steps that can be skipped, by name.
inline const std::array<std::pair<std::string_view, bool Cleaning::*>, 6> kCleaningSteps = {{
    {"weld", &Cleaning::weld},
    {"degenerate", &Cleaning::degenerate},
    {"duplicates", &Cleaning::duplicates},
    {"unreferenced", &Cleaning::unreferenced},
    {"orient", &Cleaning::orient},
    {"fans", &Cleaning::fans},
}};
// Returns these names, separated by commas.
std::string cleaningStepNames();

// Findings of the steps: those of the first pass, and what later passes dropped, cut and filled.
struct Cleaned {
  Weld welded;
  DegenerateFaces degenerate;
  DuplicateFaces duplicates;
  Findings unreferenced;
  Fans fans;
  Findings holes;  // after the first pass, before filling
  FilledHoles filled;
  OrientResult orientation;  // of the result; with orient skipped, not applied
  bool converged = true;     // false: the limit of passes was reached
};

// mesh.sourceVertices, sourceFaces and sourceCorners must be set. If all triangles are dropped, orientation is empty.
// Throws Error: weld tolerance too small for the coordinates (weld.h), too many fans (fans.h).
Cleaned cleanToFixedPoint(Mesh& mesh, const Cleaning& steps);

}  // namespace malus::prep

// All steps of cleaning, one round after the other until a round changes nothing.
//
// Steps depend on each other: what fans join may have to be turned as a whole; which backs face each other depends on
// the sides; a face that was turned may be a copy of one that it was the back of; a lid joins what was apart. A mesh
// that does not touch itself is done after one round. Another is cleaned again as if it were read from a file that
// holds the result, so that cleaning what was cleaned changes nothing; what that drops, cuts and fills is told as well.
// Where a step but `unreferenced` is left out, one round is made.
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

// Which steps are made, and how.
struct Cleaning {
  bool weld = true;
  bool degenerate = true;  // without it there are no fans either
  bool duplicates = true;
  bool unreferenced = true;
  bool orient = true;
  bool fans = true;
  bool sheet = false;           // orient: turn no component as a whole
  bool dropOpposite = false;    // duplicates
  double weldTolerance = 0;     // metres
  std::uint64_t fillHoles = 0;  // holes of at most so many edges
  std::string where = "mesh";   // for messages
};

// The steps that can be left out, by name.
inline const std::array<std::pair<std::string_view, bool Cleaning::*>, 6> kCleaningSteps = {{
    {"weld", &Cleaning::weld},
    {"degenerate", &Cleaning::degenerate},
    {"duplicates", &Cleaning::duplicates},
    {"unreferenced", &Cleaning::unreferenced},
    {"orient", &Cleaning::orient},
    {"fans", &Cleaning::fans},
}};
std::string cleaningStepNames();  // all of them, with commas

// What each step did: the first round in full, of later ones what they dropped, cut and filled besides.
struct Cleaned {
  Weld welded;
  DegenerateFaces degenerate;
  DuplicateFaces duplicates;
  Findings unreferenced;
  Fans fans;
  Findings holes;  // after the first round, before lids
  FilledHoles filled;
  OrientResult sides;   // of the mesh as it is now; only looked at where it is not to be oriented
  bool settled = true;  // false where rounds ran out
};

// mesh.sourceVertices, sourceFaces and sourceCorners must be there. Everything may be dropped: sides are then empty.
// Throws Error: a tolerance too small (weld.h), no surface (fans.h).
Cleaned cleanInRounds(Mesh& mesh, const Cleaning& steps);

}  // namespace malus::prep

// Bodies of glass of which a file places the pieces at nodes with different transforms, such as two halves, of which
// one is the mirror image of the other. Runs after joinParts().
//
// Instances are compared in the coordinates of the file: they are neighbours if they have open edges at the same
// positions. The weld tolerance applies, and at least the rounding error of positions in single precision, because a
// file has the pieces in different coordinates.
#pragma once

#include <string>
#include <vector>

#include "bake/imports/join_parts.h"
#include "meshprep/prepare.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

// Replaces the instances of each body by one instance of a new part, in the coordinates of the file, named after the
// first of them. Adds the use of new parts to uses. Shared vertices get equal positions. Returns a note for each body.
// Nothing is joined if the preparation does not weld.
std::vector<std::string> joinInstances(prep::SourceScene& source, std::vector<PartUse>& uses,
                                       const prep::Options& preparation);

}  // namespace malus::bake

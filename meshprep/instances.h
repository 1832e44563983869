// Preparation of a file that places meshes several times.
//
// A mesh is cleaned, inspected and certified once, at its first place, and the result is used at the others. Its
// vertices get the positions that the file gives them there. Only what concerns no other mesh is prepared alone:
// instances whose boxes overlap or touch are merged first, so that all steps see their faces together. Everything is
// merged if the result of a step may depend on meshes elsewhere, or if a certificate is refused.
#pragma once

#include <string>

#include "meshprep/prepare.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

// As prepare() of mergeInstances(scene), with the same sources: vertices and faces are numbered through the instances.
// Errors are those of the merged polygons. If the result was prepared in pieces, its vertices and triangles are ordered
// by piece, in mesh.pieces, and sourceCorners, flipped and the attributes of triangles are empty.
Mesh prepareInstances(const SourceScene& scene, const std::string& source, const Options& options, Report& report);

}  // namespace malus::prep

// Simplification of a clean mesh by edge collapses (OpenMesh::Decimater).
//
// Each collapse moves a vertex onto a neighbour, the one with the smallest quadric error first. The vertices of the
// result are therefore vertices of the source. Kept are
// - vertices of boundaries and of material borders, and vertices at the position of another vertex, without exception;
// - creases and borders of smoothing groups as lines: a vertex on a line moves along the line only, and ends and
//   crossings of lines do not move. No collapse makes a new crease.
// Seams of texture coordinates and tangents do not move, and with maxError the image moves on the surface by no more
// than that (seams.h). The deviation is measured afterwards (surface_deviation.h), in both directions, against the mesh
// before simplification. If it exceeds a bound, the collapses are repeated with a smaller internal tolerance, at last
// not at all. The result is the same for the same input on every machine with the same arithmetic. Source: M. Garland,
// P. S. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "meshprep/mesh.h"
#include "meshprep/report.h"

namespace malus::prep {

struct SimplifyBounds {
  std::optional<double> maxError;               // metres, over 0
  std::optional<std::uint64_t> triangles;       // stop at this number or one below it, over 0
  std::optional<double> maxNormalErrorDegrees;  // over 0, at most 180
  bool any() const { return maxError || triangles || maxNormalErrorDegrees; }
};

// Lines that the result keeps.
struct SimplifyLines {
  std::optional<double> creaseDegrees;            // edges with a larger angle between their normals are creases
  bool smoothingGroups = false;                   // edges between different groups, or of group 0, are creases
  std::span<const std::uint32_t> materials = {};  // per triangle; empty: one material
};

// Throws Error that names the option for bounds out of range, NaN included.
void checkSimplifyBounds(const SimplifyBounds& bounds);

// `mesh` must be an oriented manifold after cleaning, with at least one triangle; its corner normals are dropped if it
// changes. Returns the entry of the report. A mesh that cannot be simplified within the bounds stays unchanged, with a
// warning. Throws Error for bounds out of range.
Simplification simplify(Mesh& mesh, const SimplifyBounds& bounds, const SimplifyLines& lines);

}  // namespace malus::prep

// From a mesh file as a modeller leaves it to a mesh that a renderer can trust.
//
// read -> triangulate -> weld -> degenerate -> duplicates -> unreferenced -> orient -> fans -> holes -> simplify ->
// junctions and intersections (reported) -> certificate -> normals. Each step of cleaning can be left out, counts what
// it found and changed, and names the first of them with their vertices, faces and places in the file; nothing is
// dropped uncounted. A mesh that needs nothing keeps its vertices and triangles in their order; a mesh that was cleaned
// needs nothing more. Coordinates are taken as metres, in double. Compression is separate: see compress/draco_mesh.h.
#pragma once

#include <filesystem>
#include <string>

#include "meshprep/clean/rounds.h"
#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"
#include "meshprep/report.h"
#include "meshprep/simplify/simplify.h"

namespace malus::prep {

enum class Normals {
  crease,     // smooth but for edges sharper than an angle
  smoothing,  // by the smoothing groups of the file (OBJ)
  authored,   // as the file has them
};

struct Options {
  // Kinds of mesh.
  bool flat = false;   // normals are those of the faces: none are stored, no vertex is split
  bool sheet = false;  // an open surface on purpose: keeps its side
  bool asIs = false;   // only triangulate: the file's own vertices, faces and, unless flat, normals

  // Cleaning; its `sheet` is that of the mesh.
  Cleaning steps;
  double weldRelative = 0;  // steps.weldTolerance as a share of the diagonal of the mesh's box; the larger of the two

  // Simplification after cleaning; none if no bound is set. Needs all steps of cleaning but unreferenced and weld.
  SimplifyBounds simplify;

  // Looking, and normals.
  bool findJunctions = true;       // tell vertices that lie on a boundary edge
  bool findIntersections = false;  // tell faces that cross, touch or lie on each other; a certificate always does
  bool certifyGlass = false;       // tell whether the mesh can be a body of glass, or a pair of sheets
  Normals normals = Normals::crease;
  double creaseDegrees = 40;  // edges sharper than this get two normals; 0 to 180
};

// Fills `report` except for errors and compression. Throws Error: unreadable file, unknown extension,
// anything in the file that cannot be read right, options out of bounds, nothing left after cleaning; normals that
// are asked for and are not there; asIs and not flat where the file has no normals, or one without a length.
// A certificate that is refused is no Error: see report.certificate.
Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report);

// The same of faces that were read already; `source` is their name in messages.
Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report);

// The same from a mesh in memory, from weld on; report.input is left to the caller.
Mesh clean(Mesh mesh, const Options& options, Report& report);

}  // namespace malus::prep

// Preparation of a mesh file for rendering.
//
// read -> triangulate -> weld -> degenerate -> duplicates -> unreferenced -> orient -> fans -> holes -> simplify ->
// junctions and intersections (reported only) -> certificate -> normals -> texture coordinates. Each step of cleaning
// can be skipped; it counts its findings and changes, and lists the first ones with vertices, faces and locations in
// the file. Every dropped vertex or face is counted. A mesh without defects keeps the order of its vertices and
// triangles, and cleaning a cleaned mesh changes nothing. Coordinates are metres, in double. Compression is separate
// (compress/draco_mesh.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "meshprep/clean/fixed_point.h"
#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"
#include "meshprep/report.h"
#include "meshprep/simplify/simplify.h"

namespace malus::prep {

enum class Normals {
  crease,     // smooth, except at edges sharper than an angle
  smoothing,  // by the smoothing groups of the file (OBJ)
  authored,   // normals of the file
};

struct Options {
  // Kind of mesh.
  bool flat = false;          // normals are those of the faces: none are stored, and no vertex is split
  bool openSurface = false;   // the surface is intentionally open: components keep their orientation
  bool asIs = false;          // only triangulate; keep the vertices, faces and, unless flat, normals of the file
  bool keepTextures = false;  // of a file: keep texture coordinates and tangents; polygons keep what they have
  bool strict = false;        // refuse a file with an invalid part instead of leaving the part out (readGltf())

  // Cleaning. steps.openSurface is set to openSurface.
  Cleaning steps;
  double weldRelative =
      0;  // weld tolerance relative to the bounding box diagonal, 0 to 1; the larger of the two applies

  // Simplification after cleaning; none if no bound is set. Needs all steps of cleaning but unreferenced and weld.
  SimplifyBounds simplify;

  // Inspection and normals.
  bool findJunctions = true;       // report T-junctions
  bool findIntersections = false;  // report faces that cross, touch or coincide; implied by certifyGlass
  bool certifyGlass = false;       // certify the mesh as glass (certify/glass.h)
  Normals normals = Normals::crease;
  double creaseDegrees = 40;  // edges sharper than this get two normals, 0 to 180
};

// Options that exclude simplification.
struct OptionConflict {
  std::string_view problem, expected, found;
};

// Nothing if no bound of simplification is set, or if the options permit it. The normals are those of `options`.
std::optional<OptionConflict> findSimplifyConflict(const Options& options);

// Fills `report` except for errors and compression. Throws Error: the errors of the readers, options out of range, no
// triangle left after cleaning, requested normals that the file does not have, asIs without flat for a file without
// normals or with one of length 0. A refused certificate does not throw (report.certificate).
// Meshes that a glTF file places several times are prepared once (instances.h).
Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report);

// Prepares polygons that were read before. `source` is their name in messages.
Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report);

// Cleans a mesh in memory: the steps from weld on. The caller sets report.input.
Mesh clean(Mesh mesh, const Options& options, Report& report);

}  // namespace malus::prep

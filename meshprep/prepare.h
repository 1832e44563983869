// From a mesh file as a modeller leaves it to a mesh that a renderer can trust.
//
// read (OBJ, PLY, STL, OFF, glTF) -> triangulate -> weld -> drop degenerate faces -> drop duplicate faces -> drop
// unreferenced vertices -> orient -> normals. Every step counts what it changed and nothing is dropped
// uncounted; a mesh that needs nothing keeps its vertices and triangles in their order. Coordinates are
// taken as metres. Compression is separate: see compress/draco_mesh.h.
#pragma once

#include <filesystem>
#include <string>

#include "meshprep/mesh.h"
#include "meshprep/read/polygons.h"
#include "meshprep/report.h"

namespace malus::prep {

struct Options {
  bool flat = false;          // normals are those of the faces: none are stored, no vertex is split
  bool sheet = false;         // an open surface on purpose: keeps its side, opposite duplicates stay
  double creaseDegrees = 40;  // edges sharper than this get two normals; 0 to 180
  double weldTolerance = 0;   // metres; corners closer than this become one vertex; 0: equal positions only
  bool asIs = false;          // only triangulate: the file's own vertices, faces and, unless flat, normals (PLY)
};

// Fills `report` except for errors and compression. Throws Error: unreadable file, unknown extension,
// anything in the file that cannot be read right, options out of bounds, nothing left after cleaning; asIs
// and not flat where the file has no normals, or one without a length.
Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report);

// The same from polygons that have been read; source names them in messages.
Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report);

// The same from a mesh in memory, from weld on; report.input is left to the caller.
Mesh clean(Mesh mesh, const Options& options, Report& report);

}  // namespace malus::prep

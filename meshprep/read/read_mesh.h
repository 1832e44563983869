// Reads a mesh file (OBJ, PLY, STL, OFF, by extension) as polygons. For glTF (.gltf, .glb; read_gltf.h) the result
// contains every instance in world space.
//
// Coordinates are kept in double precision. The tests compare the scans with OpenMesh's readers
// (tests/meshprep/read/crosscheck.h).
//
// Materials are names only. A `mtllib` statement of OBJ may name one file with blanks in its name, or several files:
// read_mtl.h decides.
#pragma once

#include <filesystem>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// A vertex or a face that is invalid, and an unknown statement of OBJ, are left out with a note, or an Error if
// `strict` or if no face is left; glTF: as readGltf(). STL shares no vertices: three positions per face. Throws Error
// that names a line or a byte: unreadable file, unknown extension, no vertices or faces, more than 65536 + 64 corners
// per vertex, and every error of readGltf() and of the scans. Any 10 MB of bytes take less than 2 s and 512 MB.
Polygons readMesh(const std::filesystem::path& path, bool strict = false);

}  // namespace malus::prep

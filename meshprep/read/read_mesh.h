// A mesh file (OBJ, PLY, STL, OFF, told by its extension) as polygons. Of glTF (.gltf, .glb; read_gltf.h) every
// instance is there, in world space.
//
// The file is scanned (scan.h), then OpenMesh reads the same bytes, in which the scan has blanked what OpenMesh gets
// wrong. Vertices, faces and every corner must then be those of the scan, or the file is an error; coordinates
// are those of the scan, in double, since OpenMesh's go through float (second_opinion.h).
//
// Read by the scan alone, its own counts checked against those of the file, because OpenMesh reads them wrong or not at
// all: PLY with triangle strips, with lists beside the corners or before them, with lengths of lists other than uchar,
// uint8 and int, with whole numbers for coordinates, with faces before vertices, with other elements that have data;
// ASCII STL with empty lines between the corners of a face; any file with a face of more than 256 corners.
//
// Materials are names alone here. A `mtllib` of OBJ may name one file with blanks in it or several files: read_mtl.h
// finds out.
#pragma once

#include <filesystem>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// STL shares no vertices: three positions a face. Throws Error that names a line or a byte: unreadable file, unknown
// extension, no vertices or faces, whatever readGltf() refuses, more than 65536 + 64 corners a vertex, whatever the
// scan refuses, OpenMesh reading something else than the scan. 10 MB of any bytes take less than 2 s and 512 MB.
Polygons readMesh(const std::filesystem::path& path);

}  // namespace malus::prep

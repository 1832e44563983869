// A mesh file (OBJ, PLY, STL, OFF, told by its extension) as polygons. Of glTF (.gltf, .glb; read_gltf.h) every
// instance is there, in world space.
//
// The file is scanned first (scan.h), then read by OpenMesh from the same bytes. OpenMesh hands over faces
// one by one as it parses them; they are collected as they are written, not put into a half-edge structure,
// because that would duplicate vertices on non-manifold faces and crack the surface. Vertices, faces and
// every corner's position must then be those of the scan, or the file is an error. Coordinates are those of
// the scan, in double; OpenMesh's went through float.
#pragma once

#include <filesystem>

#include "meshprep/read/polygons.h"

namespace malus::prep {

// STL shares no vertices: three positions a face. Throws Error: unreadable file, unknown extension, no
// vertices or faces, whatever the scan or readGltf() refuses, OpenMesh reading something else than the scan.
Polygons readMesh(const std::filesystem::path& path);

}  // namespace malus::prep

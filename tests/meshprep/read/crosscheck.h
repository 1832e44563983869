// Comparison of the mesh readers with those of OpenMesh.
//
// OpenMesh reports faces one by one while it parses. They are collected in that form and not put into a
// half-edge structure, which would duplicate vertices at non-manifold faces.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "meshprep/read/scan.h"

namespace malus::prep::test {

// Throws Error if OpenMesh cannot read `bytes`, or reads other vertices, faces or corners than the scan. `bytes` must
// be those that the scan has reduced (scan.h), `extension` in lower case with its dot. Positions are equal if they
// agree after a conversion to float. Faces with repeated corners may be missing or shortened in OpenMesh's reading.
void requireSameAsOpenMesh(std::string bytes, std::string_view extension, const Scan& scan);

// Reads a file with readMesh(), scans it again and compares the scan with OpenMesh where OpenMesh can read the variant
// (Scan::openMeshReads) and no face has more than 256 corners, because OpenMesh compares each corner with each.
Polygons readCrosschecked(const std::filesystem::path& path);

// The same for the content of a file.
Polygons readCrosschecked(std::string_view extension, const std::string& text);

}  // namespace malus::prep::test

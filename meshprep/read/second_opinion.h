// OpenMesh's reading of the bytes that a scan has read, against the scan's.
//
// OpenMesh hands over faces one by one as it parses them; they are collected as they are written, not put into a
// half-edge structure, because that would duplicate vertices on non-manifold faces and crack the surface.
#pragma once

#include <string>
#include <string_view>

#include "meshprep/read/scan.h"

namespace malus::prep {

// A face of more corners is not asked about: OpenMesh compares each corner with each.
constexpr std::size_t kMaxOpenMeshCorners = 256;

// `extension` with its dot, in lower case. Throws Error: OpenMesh cannot read the bytes, or reads other vertices, faces
// or corners than the scan. Positions count as equal where one of them went through float.
void requireSecondOpinion(std::string bytes, const std::string& extension, const Scan& scan, std::string_view where);

}  // namespace malus::prep

// A strict look at a mesh file before OpenMesh sees it: every number finite, every index in range, every
// count backed by bytes.
//
// Each scan returns what the file says. It also changes the bytes, in place, to what OpenMesh reads right: what it
// has no need for and what could confuse it (materials, texture coordinates, names, colours) becomes blanks, and the
// lines of a continued statement become one. Where a file is of a variant that OpenMesh cannot read whatever is
// blanked, the scan says so.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "meshprep/read/lines.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

struct Scan {
  Polygons polygons;
  bool openMeshReads = true;  // the bytes, as they are now
  bool isBinary = false;      // told for STL alone
};

// `where` is the path for messages. All throw Error that names where:line or a byte.
Scan scanObj(std::string& bytes, std::string_view where);
Scan scanPly(std::string& bytes, std::string_view where);
Scan scanOff(std::string& bytes, std::string_view where);

// STL: three positions a face, nothing shared. Binary is told by its size, 84 + 50 n bytes.
Scan scanStl(std::string& bytes, std::string_view where);

// Adds to the notes what the file holds and nobody reads, once.
void noteOnce(Polygons& polygons, std::string_view what);

}  // namespace malus::prep

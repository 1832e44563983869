// Parsing of a mesh file: every number must be finite, every index in range, every count backed by bytes. A vertex or a
// face that is not is left out with a note (Polygons::notes); with `strict` it is an error, and so is everything that
// makes the structure of the file unreadable: a wrong header or count, missing bytes, control characters in text.
//
// Each scan returns the content of the file. It also reduces the bytes, in place, to the positions and faces:
// materials, texture coordinates, names and colours become blanks, and continued statements become one line. The tests
// read the reduced bytes with OpenMesh and compare; variants that OpenMesh cannot read even then are marked.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "meshprep/base/error.h"
#include "meshprep/read/invalid_parts.h"
#include "meshprep/read/lines.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

struct Scan {
  Polygons polygons;
  bool openMeshReads = true;               // OpenMesh can read the reduced bytes
  bool isBinary = false;                   // STL only
  std::optional<Error> firstInvalid = {};  // of the parts that are left out
};

// `where` is the path for messages. All throw Error at "WHERE:LINE" or "WHERE, byte N".
Scan scanObj(std::string& bytes, std::string_view where, bool strict = false);
Scan scanPly(std::string& bytes, std::string_view where, bool strict = false);
Scan scanOff(std::string& bytes, std::string_view where, bool strict = false);

// STL has three positions per face and shares none. A file of 84 + 50 n bytes is binary.
Scan scanStl(std::string& bytes, std::string_view where, bool strict = false);

// Ends a scan: removes the faces with invalid vertices, and adds the notes about what is left out.
void leaveOutInvalid(Scan& scan, InvalidParts& invalid, std::string_view where);

// Adds a note about ignored content, once.
void noteOnce(Polygons& polygons, std::string_view what);

// Adds a note about content that the format does not permit, once.
void noteAccepted(Polygons& polygons, std::string_view what);

// Adds notes about accepted line ends and comments.
void noteLines(Polygons& polygons, const Lines& lines);

// Notes about content that several formats ignore.
inline constexpr std::string_view kFewCorners = "faces of fewer than three corners";
inline constexpr std::string_view kPaddingNote = "padding at the end of the file";

}  // namespace malus::prep

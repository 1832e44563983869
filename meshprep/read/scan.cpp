#include "meshprep/read/scan.h"

#include <algorithm>
#include <string>

namespace malus::prep {

void noteOnce(Polygons& polygons, std::string_view what) {
  if (std::find(polygons.notes.begin(), polygons.notes.end(), what) == polygons.notes.end())
    polygons.notes.emplace_back(what);
}

void noteAccepted(Polygons& polygons, std::string_view what) {
  noteOnce(polygons, std::string(kAcceptedNote) + std::string(what));
}

void leaveOutInvalid(Scan& scan, InvalidParts& invalid, std::string_view where) {
  dropInvalidFaces(scan.polygons, invalid, where);
  if (!invalid.any()) return;
  invalid.addNotes(scan.polygons.notes);
  scan.firstInvalid = invalid.first();
  scan.openMeshReads = false;
}

void noteLines(Polygons& polygons, const Lines& lines) {
  if (lines.hasCrLineEnds()) noteAccepted(polygons, "CR line ends");
  if (lines.hasCutComments()) noteAccepted(polygons, "comments at line ends");
}

}  // namespace malus::prep

#include "meshprep/read/scan.h"

#include <algorithm>

namespace malus::prep {

void noteOnce(Polygons& polygons, std::string_view what) {
  if (std::find(polygons.notes.begin(), polygons.notes.end(), what) == polygons.notes.end())
    polygons.notes.emplace_back(what);
}

}  // namespace malus::prep

#include "meshprep/clean/duplicate_faces.h"

#include <algorithm>
#include <array>
#include <map>

namespace malus::prep {

DuplicateCounts dropDuplicateFaces(Mesh& mesh, bool keepOpposite) {
  // Which ways around a set of three vertices has been seen.
  struct Seen {
    bool even = false;
    bool odd = false;
  };
  std::map<std::array<std::uint32_t, 3>, Seen> faces;
  DuplicateCounts counts;
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    std::array<std::uint32_t, 3> key{t.x, t.y, t.z};
    std::sort(key.begin(), key.end());
    // Turning a triangle keeps its way around: smallest corner first, then compare.
    const bool even =
        (t.x == key[0] && t.y == key[1]) || (t.y == key[0] && t.z == key[1]) || (t.z == key[0] && t.x == key[1]);
    Seen& seen = faces[key];
    bool& mine = even ? seen.even : seen.odd;
    const bool other = even ? seen.odd : seen.even;
    if (mine) {
      ++counts.same;
      return true;
    }
    if (other && !keepOpposite) {
      ++counts.opposite;
      return true;
    }
    mine = true;
    return false;
  });
  return counts;
}

}  // namespace malus::prep

// Suggestions for unknown names: of options, keys, values, materials.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace malus {

// Returns the nearest of the names by edit distance (insertions, deletions and replacements); empty if none is near.
std::string nearestName(std::string_view name, const std::vector<std::string>& names);

// Returns "; the nearest is 'NAME'" to follow a problem in an error; empty if none is near.
std::string nearestClause(std::string_view name, const std::vector<std::string>& names);

}  // namespace malus

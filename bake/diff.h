// Differences between two scene packs, as text and JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// {equal, sections[{id, change, sizeBytes[2]}], changes[{where, a, b}]}. equal: byte for byte. change: "only in the
// first", "only in the second" or "changed"; where: a path such as "materials.gold.eta.0"; a, b: its values, null
// if a pack has none. For meshes of one name with equal triangles, the largest distance of corresponding corners.
nlohmann::json diffJson(const pack::Pack& a, const pack::Pack& b);
std::string diffText(const nlohmann::json& difference);

}  // namespace malus::bake

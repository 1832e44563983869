// What is different between two scene packs, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// {equal, sections[{id, change, sizeBytes[2]}], changes[{where, a, b}]}. equal: byte for byte. change: "only in the
// first", "only in the second" or "changed"; where: a place such as "materials.gold.eta.0"; a, b: its values, null
// where one has none. Of meshes of one name that differ: how far their corners are apart, where their triangles are the
// same.
nlohmann::json diffJson(const pack::Pack& a, const pack::Pack& b);
std::string diffText(const nlohmann::json& difference);

}  // namespace malus::bake

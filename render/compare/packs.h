// The packs of a comparison, and names of files that are made from names of scenes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bake/pack/reader.h"

namespace malus::render {

// Reads packs; the result is ordered by the names of their scenes. Throws Error: no pack, a pack that cannot be read,
// two packs of one scene.
std::map<std::string, pack::Pack> readPacks(const std::vector<std::filesystem::path>& paths);

// The name of a scene as a part of a file name. A pack may come from anywhere: other characters than letters, digits
// and '-' become %XX, so that no name leaves the folder and different scenes have different files.
std::string safeName(const std::string& name);

}  // namespace malus::render

// Reads a JSON file that people write: every error names the file and the line, or the key.
#pragma once

#include <filesystem>
#include <string_view>

#include <nlohmann/json.hpp>

namespace malus::bake {

// Returns the document. schema: what the file must follow, for errors ("the schema of bake/SCENE.md"). Throws Error: a
// file that cannot be read or is larger than 64 MiB, text that is not JSON, a number that does not fit a double, a key
// that occurs twice in one object, more than 32 levels of nesting.
nlohmann::json readJsonFile(const std::filesystem::path& path, std::string_view schema);

}  // namespace malus::bake

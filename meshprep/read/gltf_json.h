// Parser of the JSON of a glTF file for a whitelist of keys (gltf_rules.h), each with its type. Other keys are dropped
// while parsing; those that would change the image leave a note. The result is small, shallow and of the right types;
// gltf_document.h makes structures of it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::prep {

struct GltfJson {
  nlohmann::json document;         // keys of the whitelist only
  std::vector<std::string> notes;  // ignored content: "textures (2)"
};

// `where` is the file for messages; errors add the location: "FILE: nodes[3].matrix", or a byte of the JSON. Throws
// Error: not JSON, more than 64 levels, a duplicate key, a value of the wrong type, a missing required key, a version
// other than 2, an unknown required extension, more than max(200000, bytes / 50) objects. Without `strict`, a key of a
// material, camera or light with a value of the wrong type is removed with a note.
GltfJson parseGltfJson(std::string_view text, const std::string& where, bool strict);

}  // namespace malus::prep

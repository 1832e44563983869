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
  nlohmann::json document;         // of the whitelist's keys
  std::vector<std::string> notes;  // "textures"
};

// `where` is the file for messages; errors add the place: "file: nodes[3].matrix", or a byte of the JSON. Throws
// Error: no JSON, nested deeper than 64, a kept key that is there twice, a value of the wrong type, a required key
// that is missing, a version other than 2, a required extension that is not known, more than max(200000, bytes / 50)
// objects.
GltfJson parseGltfJson(std::string_view text, const std::string& where);

}  // namespace malus::prep

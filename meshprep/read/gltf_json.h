// The JSON of a glTF file, as far as anybody here needs it: a whitelist of keys, each with its type. Other keys are
// dropped while parsing; those that change the picture leave a note. What is left is small, shallow and of the right
// types, so that tinygltf, which passes over values of a wrong type and follows nesting to any depth, reads it as it
// is meant.
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

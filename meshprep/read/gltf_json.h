// Parser of the JSON of a glTF file for a whitelist of keys (gltf_rules.h), each with its type. Other keys are dropped
// while parsing; those that would change the image leave a note. The result is small, shallow and of the right types;
// gltf_document.h makes structures of it.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "meshprep/read/gltf_left_out.h"

namespace malus::prep {

// Returns the keys of the whitelist. `where` is the file for messages; errors add the location: "FILE:
// nodes[3].matrix", or a byte of the JSON. Ignored content leaves a note in `leftOut`.
//
// An item of a list with a value of the wrong type, or without a required key, is left out: it becomes null, which
// keeps the indices of the others, or for a material an empty object. A key with a default is removed, and a key that
// places part of the scene (gltf::Invalid::part) becomes null.
//
// Throws Error: not JSON, more than 64 levels, a duplicate key, a list or an object outside of lists with the wrong
// type, a version other than 2, an unknown required extension, more than max(200000, bytes / 50) objects.
nlohmann::json parseGltfJson(std::string_view text, const std::string& where, GltfLeftOut& leftOut);

}  // namespace malus::prep

// The keys of glTF's JSON that are read, each with its type: a whitelist for gltf_json.h.
// Source: glTF 2.0 Specification, appendix A, "JSON Schema Reference", and the schemas of the extensions.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace malus::prep::gltf {

enum class Type { object, objects, index, indices, size, number, numbers, text, texts, flag, noted };

// `size` numbers of an array; `required` where the object that holds it cannot do without; `note` of what is dropped.
struct Rule {
  std::string_view path;
  Type type;
  std::size_t size = 0;
  bool required = false;
  std::string_view note = {};
};

// The rule of a path such as "meshes/primitives/indices", in which lists do not show; nullptr: not on the whitelist.
const Rule* findRule(std::string_view path);

// The keys that an object at this path ("": the document) must have.
const std::vector<std::string_view>& requiredKeys(std::string_view path);

}  // namespace malus::prep::gltf

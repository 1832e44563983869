// Keys of a glTF document that are read, with their types: the whitelist of gltf_json.h.
// Source: glTF 2.0 Specification, appendix A, "JSON Schema Reference", and the schemas of the extensions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace malus::prep::gltf {

enum class Type {
  object,
  objects,
  index,
  indices,
  size,
  number,
  numbers,
  numberList,
  text,
  texts,
  flag,
  unchecked,
  noted
};

// Extent of the damage by a value of the wrong type.
enum class Invalid {
  object,  // the object that has the key, up to the next item of a list; outside of lists, the file
  value,   // the value, for which the default is used
  part     // the value, which becomes null: a part of the scene is missing
};

// size: length of an array of numbers. required: the parent object must have the key. note: for a key that is dropped.
struct Rule {
  std::string_view path;
  Type type;
  std::size_t size = 0;
  bool required = false;
  std::string_view note = {};
  Invalid invalid = Invalid::object;
};

// Returns the rule of a path without indices ("meshes/primitives/indices"), or nullptr if it is not on the whitelist.
const Rule* findRule(std::string_view path);

// Returns the note of a key that is not on the whitelist: "extension NAME" inside of one, else "key 'PATH'". Empty for
// keys that do not change an image, such as extras, bounds of accessors and the planes that clip a rasterizer's image.
std::string unknownKeyNote(std::string_view path);

// Returns the keys that an object at this path must have. "" is the document.
const std::vector<std::string_view>& requiredKeys(std::string_view path);

}  // namespace malus::prep::gltf

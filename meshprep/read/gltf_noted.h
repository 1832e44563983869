// Content of a glTF document that is left out with a note (gltf_rules.h): its number and its names, taken from the
// events of the parser of gltf_json.h.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace malus::prep {

class GltfNotedContent {
 public:
  // The value of the key at a path without indices follows. note: empty if the value is kept or needs none.
  void begin(std::string_view path, std::string note);
  // A value, or the begin of an object or a list, inside of so many levels of the dropped value: 0 for that itself. A
  // list counts by its elements, any other value as one.
  void value(int levels, bool isList);
  void key(int levels, std::string_view key);
  void string(int levels, std::string_view value);

  // "textures (2)", "animations (3: 'walk', 'run'; the pose of the file is used)": one per kind of content, in the
  // order of the file. Keys with one note are one kind: the number is that of the list of the document if there is one,
  // else the sum. Names are listed as by countedNote().
  std::vector<std::string> describe() const;

 private:
  struct Content {
    std::string note;
    std::size_t inList = 0, elsewhere = 0;
    std::vector<std::string> names;
  };

  std::vector<Content> contents_;
  std::size_t current_ = 0;  // 1 + index of the content of the value that is dropped; 0: none
  bool isTopLevel_ = false, isList_ = false, isName_ = false;
};

}  // namespace malus::prep

// Parts of a file whose statements set a group name and a material for the following faces: one part for each pair of
// names with faces, in the order of their first faces. Each name is stored once, so that memory is proportional to the
// file size.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "meshprep/read/polygons.h"

namespace malus::prep {

class PartList {
 public:
  void setName(std::string name) { select(name_, std::move(name)); }
  void setMaterial(std::string material) { select(material_, std::move(material)); }

  // Returns the index of the part for the next face.
  std::uint32_t current();
  std::vector<Part> take() { return std::move(parts_); }

 private:
  // Current name, and its number among all names of the file.
  struct Selected {
    std::string text;
    std::uint32_t number = 0;
  };
  void select(Selected& selected, std::string text);

  Selected name_, material_;
  bool changed_ = true;
  std::uint32_t current_ = 0;
  std::unordered_map<std::string, std::uint32_t> numbers_ = {{std::string(), 0}};
  std::unordered_map<std::uint64_t, std::uint32_t> partOfNumbers_;
  std::vector<Part> parts_;
};

}  // namespace malus::prep

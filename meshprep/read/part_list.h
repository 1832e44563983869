// The parts of a file whose faces follow statements that name a group and a material: a part for each pair of names
// that has faces, in the order of their first faces. Names are kept once, so that a file of nothing but names costs
// no more than its own size.
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

  // The index of the part of a face that is written here.
  std::uint32_t current();
  std::vector<Part> take() { return std::move(parts_); }

 private:
  // A name in effect and its number among all that the file has.
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

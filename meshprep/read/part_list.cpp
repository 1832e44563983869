#include "meshprep/read/part_list.h"

#include <utility>

namespace malus::prep {

void PartList::select(Selected& selected, std::string text) {
  if (selected.text == text) return;
  selected.number = numbers_.try_emplace(text, static_cast<std::uint32_t>(numbers_.size())).first->second;
  selected.text = std::move(text);
  changed_ = true;
}

std::uint32_t PartList::current() {
  if (!changed_) return current_;
  changed_ = false;
  const std::uint64_t key = std::uint64_t{name_.number} << 32u | material_.number;
  const auto [at, isNew] = partOfNumbers_.try_emplace(key, static_cast<std::uint32_t>(parts_.size()));
  if (isNew) parts_.push_back({name_.text, material_.text});
  return current_ = at->second;
}

}  // namespace malus::prep

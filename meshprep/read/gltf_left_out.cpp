#include "meshprep/read/gltf_left_out.h"

#include <utility>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

GltfLeftOut::GltfLeftOut(bool strict, std::string where, std::vector<std::string>& notes)
    : strict_(strict), where_(std::move(where)), notes_(notes) {}

void GltfLeftOut::addPart(const Error& error) {
  if (!first_) first_ = error;
  addValue(error);
}

void GltfLeftOut::addValue(const Error& error) {
  if (strict_) throw Error(error);
  addNote(notes_, shortText(error));
}

void GltfLeftOut::rethrowFirst() const {
  if (first_) throw Error(*first_);
}

std::string GltfLeftOut::shortText(const Error& error) const {
  std::string text = error.what();
  if (text.starts_with(where_ + ": ")) text.erase(0, where_.size() + 2);
  return text;
}

}  // namespace malus::prep

#include "meshprep/read/gltf_noted.h"

#include <algorithm>
#include <utility>

#include "meshprep/read/counted_note.h"

namespace malus::prep {

void GltfNotedContent::begin(std::string_view path, std::string note) {
  current_ = 0;
  isList_ = isName_ = false;
  if (note.empty()) return;
  const auto found = std::find_if(contents_.begin(), contents_.end(), [&](const Content& c) { return c.note == note; });
  current_ = static_cast<std::size_t>(found - contents_.begin()) + 1;
  isTopLevel_ = path.find('/') == std::string_view::npos;
  if (found == contents_.end()) contents_.push_back({std::move(note), 0, 0, {}});
}

void GltfNotedContent::value(int levels, bool isList) {
  if (current_ == 0 || levels > 1) return;
  if (levels == 0) isList_ = isList;
  if (levels == (isList_ ? 1 : 0)) {
    Content& content = contents_[current_ - 1];
    ++(isTopLevel_ && isList_ ? content.inList : content.elsewhere);
  }
}

void GltfNotedContent::key(int levels, std::string_view key) {
  isName_ = current_ > 0 && isList_ && levels == 2 && key == "name";
}

void GltfNotedContent::string(int levels, std::string_view value) {
  if (!isName_ || levels != 2) return;
  isName_ = false;
  std::vector<std::string>& names = contents_[current_ - 1].names;
  if (names.size() <= kListedNames) names.emplace_back(value);
}

std::vector<std::string> GltfNotedContent::describe() const {
  std::vector<std::string> notes;
  for (const Content& content : contents_) {
    const std::size_t count = content.inList > 0 ? content.inList : content.elsewhere;
    if (count == 0) continue;
    const std::string_view note = content.note;
    const std::size_t remark = note.find(" (");
    const bool hasRemark = remark != std::string_view::npos;
    notes.push_back(countedNote(note.substr(0, remark), count, content.names,
                                hasRemark ? note.substr(remark + 2, note.size() - remark - 3) : ""));
  }
  return notes;
}

}  // namespace malus::prep

#include "meshprep/read/counted_note.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace malus::prep {

std::string countedNote(std::string_view content, std::size_t count, const std::vector<std::string>& names,
                        std::string_view remark) {
  constexpr std::size_t kNameBytes = 60;
  std::vector<std::string> listed;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    listed.push_back(listed.size() < kListedNames ? fmt::format("'{}'", name.substr(0, kNameBytes)) : "...");
    if (listed.size() > kListedNames) break;
  }
  return fmt::format("{} ({}{}{}{}{})", content, count, listed.empty() ? "" : ": ", fmt::join(listed, ", "),
                     remark.empty() ? "" : "; ", remark);
}

std::vector<std::string> viewNotes(const std::vector<SourceCamera>& cameras, const std::vector<SourceLight>& lights) {
  std::vector<std::string> notes, names;
  for (const SourceCamera& camera : cameras) names.push_back(camera.name);
  if (!cameras.empty()) notes.push_back(countedNote("cameras", cameras.size(), names));
  names.clear();
  for (const SourceLight& light : lights) names.push_back(light.name);
  if (!lights.empty()) notes.push_back(countedNote("lights", lights.size(), names));
  return notes;
}

}  // namespace malus::prep

// Notes about content of a file that is left out, with its number and names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/read/source_view.h"

namespace malus::prep {

inline constexpr std::size_t kListedNames = 8;

// Returns "textures (2)" or "animations (3: 'walk', 'run'; the pose of the file is used)". The first kListedNames names
// are listed, each shortened to 60 bytes; empty names are not.
std::string countedNote(std::string_view content, std::size_t count, const std::vector<std::string>& names,
                        std::string_view remark = {});

// The notes of cameras and lights that are not used; empty without any.
std::vector<std::string> viewNotes(const std::vector<SourceCamera>& cameras, const std::vector<SourceLight>& lights);

}  // namespace malus::prep

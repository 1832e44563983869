// The user's cache folder, by the XDG Base Directory Specification 0.8.
#pragma once

#include <filesystem>
#include <string_view>

namespace malus {

// Returns $XDG_CACHE_HOME/malus/NAME, or $HOME/.cache/malus/NAME if XDG_CACHE_HOME is unset, empty or relative (the
// specification ignores relative paths). Returns an empty path if HOME is unset or empty as well: there is no cache
// then. Reads the environment only; the folder may not exist yet. `name` is a folder name without separators. Not
// thread-safe against changes of the environment.
std::filesystem::path cacheFolder(std::string_view name);

}  // namespace malus

#include "meshprep/base/cache_folder.h"

#include <cstdlib>

namespace malus {
namespace fs = std::filesystem;

fs::path cacheFolder(std::string_view name) {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute())
    return fs::path(cache) / "malus" / name;
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "malus" / name;
  return {};
}

}  // namespace malus

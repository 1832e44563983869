#include "meshprep/base/program_folder.h"

#include <system_error>

namespace malus {
namespace fs = std::filesystem;

namespace {
fs::path& chosenFolder() {
  static fs::path folder;
  return folder;
}
}  // namespace

fs::path programFolder() {
  if (!chosenFolder().empty()) return chosenFolder();
  std::error_code failed;
  return fs::read_symlink("/proc/self/exe", failed).parent_path();
}

void setProgramFolder(const fs::path& folder) { chosenFolder() = folder; }

}  // namespace malus

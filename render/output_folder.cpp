#include "render/output_folder.h"

#include <unistd.h>

#include <system_error>

#include "meshprep/base/error.h"

namespace malus::render {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  std::error_code failed;
  made_ = fs::create_directories(path, failed);
  if (!fs::is_directory(path))
    throw Error(path.string(), "cannot write", "a folder", failed ? failed.message() : "a file");
  if (::access(path.c_str(), W_OK | X_OK) != 0) throw Error(path.string(), "cannot write", "a writable folder");
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (made_) fs::remove(path_, ignored);  // fails unless the folder is empty
}

}  // namespace malus::render

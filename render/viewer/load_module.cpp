#include "render/viewer/load_module.h"

#include <dlfcn.h>

#include <filesystem>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/program_folder.h"

namespace malus::viewer {
namespace fs = std::filesystem;

const Module& loadModule() {
  const fs::path file = (programFolder() / MALUS_MODULE_PATH / "malus-viewer.so").lexically_normal();
  if (!fs::exists(file))
    throw Error(file.string(), "this malus was built without the viewer",
                "a build with libglfw3-dev and libimgui-dev (tools/install-deps), or -DMALUS_VIEWER=ON");
  void* library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!library)
    throw Error(file.string(), fmt::format("cannot load the viewer: {}", ::dlerror()),
                "the packages libglfw3 and libvulkan1");
  const auto entry = reinterpret_cast<const Module* (*)()>(::dlsym(library, kModuleEntry));
  if (!entry) throw Error(file.string(), "is not the viewer of malus", "the file that the build puts there");
  if (std::string_view(entry()->version) != MALUS_VERSION)
    throw Error(file.string(), "is of another version", "malus " MALUS_VERSION, entry()->version);
  return *entry();
}

}  // namespace malus::viewer

#include "meshprep/base/image.h"

#include <dlfcn.h>

#include <span>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image_module.h"

namespace malus::image {
namespace fs = std::filesystem;

namespace {

// Loads the module once. MALUS_MODULE_PATH is its folder relative to that of the executable, in the build tree and in
// the installed one.
const Module& module() {
  static const Module* const kModule = [] {
    constexpr const char* kExpected = "the file that the build or `cmake --install` puts there";
    std::error_code failed;
    const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
    const fs::path file = executable.parent_path() / MALUS_MODULE_PATH / "malus-image.so";
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) throw Error(file.string(), fmt::format("cannot load the image module: {}", ::dlerror()), kExpected);
    using Entry = const Module* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(library, kModuleEntry));
    if (!entry) throw Error(file.string(), "is not the image module of malus", kExpected);
    return entry();
  }();
  return *kModule;
}

void checkResult(const fs::path& path, const char* problem, const std::string& message) {
  if (!message.empty()) throw Error(path.string(), fmt::format("{}: {}", problem, message));
}

}  // namespace

int Image::channel(std::string_view name) const {
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i] == name) return static_cast<int>(i);
  return -1;
}

Image read(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw Error(path.string(), "cannot open: no such file", "an image file");
  Image image;
  checkResult(path, "cannot read the image", module().read(path.string(), image));
  return image;
}

void writeExr(const fs::path& path, const Image& image) {
  writeBeside(path, [&](const fs::path& temporary) {
    checkResult(path, "cannot write", module().writeExr(temporary.string(), image));
  });
}

void writePng(const fs::path& path, int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
  std::vector<unsigned char> bytes;
  checkResult(path, "cannot write", module().encodePng(width, height, channels, pixels.data(), bytes));
  writeFile(path, std::as_bytes(std::span(bytes)));
}

void writeGrey(const fs::path& path, int width, int height, GreyDepth depth, const std::vector<std::uint16_t>& values,
               const std::string& description) {
  writeBeside(path, [&](const fs::path& temporary) {
    checkResult(path, "cannot write",
                module().writeGrey(temporary.string(), width, height, depth, values.data(), description));
    // OpenImageIO's PNG writer does not report a full disk; a truncated file fails to read.
    Image back;
    checkResult(path, "cannot write", module().read(temporary.string(), back));
  });
}

}  // namespace malus::image

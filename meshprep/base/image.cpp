#include "meshprep/base/image.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/image_module.h"
#include "meshprep/base/program_folder.h"

namespace malus::image {
namespace fs = std::filesystem;

namespace {

// File of a module. MALUS_MODULE_PATH is its folder relative to that of the program, in the build tree and in the
// installed one.
fs::path moduleFile(const char* name) { return (programFolder() / MALUS_MODULE_PATH / name).lexically_normal(); }

template <class Interface>
const Interface* load(const fs::path& file, const char* entryName) {
  constexpr const char* kExpected = "the file that the build or `cmake --install` puts there";
  void* library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!library) throw Error(file.string(), fmt::format("cannot load the image module: {}", ::dlerror()), kExpected);
  const auto entry = reinterpret_cast<const Interface* (*)()>(::dlsym(library, entryName));
  if (!entry) throw Error(file.string(), "is not the image module of malus", kExpected);
  return entry();
}

const Module& module() {
  static const Module* const kModule = load<Module>(moduleFile("malus-image.so"), kModuleEntry);
  return *kModule;
}

// Throws Error that names path, which has another format than EXR and PNG, if there is no such module.
const FormatsModule& formatsModule(const fs::path& path) {
  static const FormatsModule* const kModule = []() -> const FormatsModule* {
    const fs::path file = moduleFile("malus-image-formats.so");
    return fs::exists(file) ? load<FormatsModule>(file, kFormatsModuleEntry) : nullptr;
  }();
  if (!kModule)
    throw Error(path.string(), "unsupported format: this malus reads and writes EXR and PNG only",
                "a malus with OpenImageIO for other formats");
  return *kModule;
}

// A file without a name in the file system.
class MemoryFile {
 public:
  MemoryFile(std::span<const std::byte> bytes, std::string_view name) : file_(::memfd_create("image", MFD_CLOEXEC)) {
    if (file_ < 0) throw Error(name, fmt::format("cannot make a file in memory: {}", std::strerror(errno)));
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        const int error = errno;
        ::close(file_);
        throw Error(name, fmt::format("cannot write a file in memory: {}", std::strerror(error)));
      }
    }
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  fs::path path() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

// By the first bytes of the file.
bool isExrOrPng(const fs::path& path) {
  char start[8] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  return startsAsExrOrPng({start, sizeof start});
}

void checkResult(const fs::path& path, const char* problem, const std::string& message) {
  if (!message.empty()) throw Error(path.string(), fmt::format("{}: {}", problem, message));
}

// name: of the image, for errors.
Image readAs(const fs::path& path, const fs::path& name) {
  Image image;
  checkResult(name, "cannot read the image",
              (isExrOrPng(path) ? module().read : formatsModule(name).read)(path.string(), image));
  return image;
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
  return readAs(path, path);
}

Image readBytes(std::span<const std::byte> bytes, std::string_view name) {
  // A file in memory: the libraries read files, some formats by their path alone.
  const MemoryFile file(bytes, name);
  return readAs(file.path(), fs::path(name));
}

void writeExr(const fs::path& path, const Image& image, ExrCompression compression) {
  writeBeside(path, [&](const fs::path& temporary) {
    checkResult(path, "cannot write", module().writeExr(temporary.string(), image, compression));
  });
}

void writePng(const fs::path& path, int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
  std::vector<unsigned char> bytes;
  checkResult(path, "cannot write", module().encodePng(width, height, channels, pixels.data(), bytes));
  writeFile(path, std::as_bytes(std::span(bytes)));
}

void writeGrey(const fs::path& path, int width, int height, GreyDepth depth, const std::vector<std::uint16_t>& values,
               const std::string& description) {
  const GreyPixels pixels{width, height, depth, values.data(), description.c_str()};
  if (path.extension() == ".png") {
    std::vector<unsigned char> bytes;
    checkResult(path, "cannot write", module().encodeGreyPng(pixels, bytes));
    return writeFile(path, std::as_bytes(std::span(bytes)));
  }
  const FormatsModule& formats = formatsModule(path);
  writeBeside(path, [&](const fs::path& temporary) {
    checkResult(path, "cannot write", formats.writeTiff(temporary.string(), pixels));
    // OpenImageIO may not report a full disk; a truncated file fails to read.
    Image back;
    checkResult(path, "cannot write", formats.read(temporary.string(), back));
  });
}

}  // namespace malus::image

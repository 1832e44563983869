#include "render/compare/packs.h"

#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

std::map<std::string, pack::Pack> readPacks(const std::vector<std::filesystem::path>& paths) {
  if (paths.empty()) throw Error("malus compare", "no scene pack", "one or more");
  std::map<std::string, pack::Pack> packs;
  for (const std::filesystem::path& path : paths) {
    pack::Pack pack = pack::read(path);
    const std::string name = pack.scene.name;
    if (!packs.emplace(name, std::move(pack)).second)
      throw Error(path.string(), fmt::format("a second pack of scene '{}'", name), "each scene once");
  }
  return packs;
}

std::string safeName(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    safe += isPlain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return safe;
}

}  // namespace malus::render

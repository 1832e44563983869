#include "bake/older_pack.h"

#include <system_error>

#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;

std::optional<OlderBake> readOlder(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  try {
    OlderBake older;
    older.bytes = readFile(path);
    older.pack = pack::parse(older.bytes, path.string());
    return older;
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool isUpToDate(const OlderBake& older, const std::string& provenance) {
  return older.pack.scene.provenance == provenance;
}

bool isOfSameVersions(const OlderBake& older, const std::string& provenance) {
  const json before = json::parse(older.pack.scene.provenance, nullptr, false), now = json::parse(provenance);
  if (!before.is_object()) return false;
  for (const char* key : {"malus", "baker", "draco"})
    if (before.value(key, json()) != now.at(key)) return false;
  return true;
}

}  // namespace malus::bake

#include "bake/previous_pack.h"

#include <system_error>

#include <nlohmann/json.hpp>

#include "bake/scene_json.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;

std::optional<PreviousBake> readPrevious(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  try {
    PreviousBake previous;
    previous.bytes = readFile(path);
    previous.pack = pack::parse(previous.bytes, path.string());
    return previous;
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool isUpToDate(const PreviousBake& previous, const std::string& provenance) {
  json before = provenanceJson(previous.pack.scene);
  const json now = json::parse(provenance);
  // Warnings are a result. A pack without them is of an earlier version, and is baked again.
  if (!before.is_object() || !before.contains("warnings")) return false;
  before["warnings"] = now.at("warnings");
  return before == now;
}

bool isOfSameVersions(const PreviousBake& previous, const std::string& provenance) {
  const json before = json::parse(previous.pack.scene.provenance, nullptr, false), now = json::parse(provenance);
  if (!before.is_object()) return false;
  for (const char* key : {"malus", "baker", "draco"})
    if (before.value(key, json()) != now.at(key)) return false;
  return true;
}

}  // namespace malus::bake

#include "meshprep/read/gltf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {
using nlohmann::json;

namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMinObjects = 200'000;  // are always allowed
constexpr std::size_t kBytesPerObject = 50;
constexpr std::int64_t kMaxIndex = 0x7fffffff;            // tinygltf keeps them in int
constexpr std::int64_t kMaxSize = std::int64_t{1} << 53;  // what every JSON reader holds

enum class Type { object, objects, index, indices, size, number, numbers, text, texts, flag, noted };

// `size` numbers of an array; `required` where the object that holds it cannot do without; `note` of what is dropped.
struct Rule {
  std::string_view path;
  Type type;
  std::size_t size = 0;
  bool required = false;
  std::string_view note = {};
};

constexpr Rule noted(std::string_view path, std::string_view note) { return {path, Type::noted, 0, false, note}; }

// Array levels do not show in a path.
constexpr std::array kRules = {
    Rule{"asset", Type::object, 0, true},
    Rule{"asset/version", Type::text, 0, true},
    Rule{"asset/minVersion", Type::text},
    Rule{"extensionsUsed", Type::texts},
    Rule{"extensionsRequired", Type::texts},
    Rule{"scene", Type::index},
    Rule{"scenes", Type::objects},
    Rule{"scenes/nodes", Type::indices},
    Rule{"nodes", Type::objects},
    Rule{"nodes/name", Type::text},
    Rule{"nodes/mesh", Type::index},
    Rule{"nodes/children", Type::indices},
    Rule{"nodes/matrix", Type::numbers, 16},
    Rule{"nodes/translation", Type::numbers, 3},
    Rule{"nodes/rotation", Type::numbers, 4},
    Rule{"nodes/scale", Type::numbers, 3},
    noted("nodes/skin", "skins: the pose of the file is taken"),
    noted("nodes/camera", "cameras"),
    Rule{"meshes", Type::objects},
    Rule{"meshes/name", Type::text},
    Rule{"meshes/primitives", Type::objects, 0, true},
    Rule{"meshes/primitives/mode", Type::index},
    Rule{"meshes/primitives/indices", Type::index},
    Rule{"meshes/primitives/material", Type::index},
    Rule{"meshes/primitives/attributes", Type::object, 0, true},
    Rule{"meshes/primitives/attributes/POSITION", Type::index},
    Rule{"meshes/primitives/attributes/NORMAL", Type::index},
    noted("meshes/primitives/attributes/TANGENT", "tangents"),
    noted("meshes/primitives/attributes/TEXCOORD_0", "texture coordinates"),
    noted("meshes/primitives/attributes/COLOR_0", "colours of vertices"),
    noted("meshes/primitives/attributes/JOINTS_0", "skins: the pose of the file is taken"),
    noted("meshes/primitives/targets", "morph targets: the shape of the file is taken"),
    Rule{"meshes/primitives/extensions", Type::object},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression", Type::object},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/bufferView", Type::index, 0, true},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes", Type::object, 0, true},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/POSITION", Type::index},
    Rule{"meshes/primitives/extensions/KHR_draco_mesh_compression/attributes/NORMAL", Type::index},
    Rule{"accessors", Type::objects},
    Rule{"accessors/bufferView", Type::index},
    Rule{"accessors/byteOffset", Type::size},
    Rule{"accessors/componentType", Type::index, 0, true},
    Rule{"accessors/normalized", Type::flag},
    Rule{"accessors/count", Type::size, 0, true},
    Rule{"accessors/type", Type::text, 0, true},
    Rule{"accessors/sparse", Type::object},
    Rule{"accessors/sparse/count", Type::index, 0, true},
    Rule{"accessors/sparse/indices", Type::object, 0, true},
    Rule{"accessors/sparse/indices/bufferView", Type::index, 0, true},
    Rule{"accessors/sparse/indices/byteOffset", Type::index},
    Rule{"accessors/sparse/indices/componentType", Type::index, 0, true},
    Rule{"accessors/sparse/values", Type::object, 0, true},
    Rule{"accessors/sparse/values/bufferView", Type::index, 0, true},
    Rule{"accessors/sparse/values/byteOffset", Type::index},
    Rule{"bufferViews", Type::objects},
    Rule{"bufferViews/buffer", Type::index, 0, true},
    Rule{"bufferViews/byteOffset", Type::size},
    Rule{"bufferViews/byteLength", Type::size, 0, true},
    Rule{"bufferViews/byteStride", Type::index},
    Rule{"buffers", Type::objects},
    Rule{"buffers/uri", Type::text},
    Rule{"buffers/byteLength", Type::size, 0, true},
    Rule{"materials", Type::objects},
    Rule{"materials/name", Type::text},
    Rule{"materials/pbrMetallicRoughness", Type::object},
    Rule{"materials/pbrMetallicRoughness/baseColorFactor", Type::numbers, 4},
    Rule{"materials/pbrMetallicRoughness/metallicFactor", Type::number},
    Rule{"materials/pbrMetallicRoughness/roughnessFactor", Type::number},
    Rule{"materials/emissiveFactor", Type::numbers, 3},
    Rule{"materials/alphaMode", Type::text},
    Rule{"materials/extensions", Type::object},
    Rule{"materials/extensions/KHR_materials_ior", Type::object},
    Rule{"materials/extensions/KHR_materials_ior/ior", Type::number},
    Rule{"materials/extensions/KHR_materials_transmission", Type::object},
    Rule{"materials/extensions/KHR_materials_transmission/transmissionFactor", Type::number},
    Rule{"materials/extensions/KHR_materials_volume", Type::object},
    Rule{"materials/extensions/KHR_materials_volume/thicknessFactor", Type::number},
    Rule{"materials/extensions/KHR_materials_volume/attenuationDistance", Type::number},
    Rule{"materials/extensions/KHR_materials_volume/attenuationColor", Type::numbers, 3},
    Rule{"materials/extensions/KHR_materials_emissive_strength", Type::object},
    Rule{"materials/extensions/KHR_materials_emissive_strength/emissiveStrength", Type::number},
    noted("textures", "textures"),
    noted("images", "textures"),
    noted("animations", "animations: the pose of the file is taken"),
    noted("skins", "skins: the pose of the file is taken"),
    noted("cameras", "cameras"),
};

// Extensions that are read, and those that touch nothing but textures, which are left out anyway.
constexpr std::array<std::string_view, 10> kKnownExtensions = {
    "KHR_draco_mesh_compression", "KHR_mesh_quantization",
    "KHR_materials_ior",          "KHR_materials_transmission",
    "KHR_materials_volume",       "KHR_materials_emissive_strength",
    "KHR_texture_transform",      "KHR_texture_basisu",
    "EXT_texture_webp",           "EXT_texture_avif"};

const Rule* findRule(std::string_view path) {
  static const std::map<std::string_view, const Rule*> kByPath = [] {
    std::map<std::string_view, const Rule*> rules;
    for (const Rule& rule : kRules) rules.emplace(rule.path, &rule);
    return rules;
  }();
  const auto found = kByPath.find(path);
  return found == kByPath.end() ? nullptr : found->second;
}

// The required keys of the objects at each path.
const std::vector<std::string_view>& requiredKeys(std::string_view path) {
  static const std::map<std::string_view, std::vector<std::string_view>> kByPath = [] {
    std::map<std::string_view, std::vector<std::string_view>> keys;
    for (const Rule& rule : kRules) {
      const std::size_t slash = rule.path.rfind('/');
      const bool top = slash == std::string_view::npos;
      if (rule.required)
        keys[top ? std::string_view() : rule.path.substr(0, slash)].push_back(top ? rule.path
                                                                                  : rule.path.substr(slash + 1));
    }
    return keys;
  }();
  static const std::vector<std::string_view> kNone;
  const auto found = kByPath.find(path);
  return found == kByPath.end() ? kNone : found->second;
}

// Decides, event by event of nlohmann's parser, what of the JSON is kept.
class Filter {
 public:
  Filter(std::size_t textBytes, const std::string& where, std::vector<std::string>& notes)
      : where_(where), notes_(notes), objectsLeft_(std::max(kMinObjects, textBytes / kBytesPerObject)) {}

  bool operator()(int depth, json::parse_event_t event, const json& value) {
    if (depth > kMaxNesting)
      throw Error(where_, "JSON is nested too deep", fmt::format("at most {} levels", kMaxNesting));
    const auto level = static_cast<std::size_t>(depth);
    if (event != json::parse_event_t::key && level < dropped_) dropped_ = 0;
    switch (event) {
      case json::parse_event_t::key:
        return keep(level, value.get_ref<const std::string&>());
      case json::parse_event_t::object_start:
        if (dropped_ == 0) count();
        if (seen_.size() < level + 1) seen_.resize(level + 1);
        seen_[level].clear();
        return true;
      case json::parse_event_t::value:
        if (dropped_ == 0 && value.is_string()) count();
        return true;
      default:
        return true;
    }
  }

 private:
  // The key stands in an object at level - 1; its value is dropped with all that it holds, or kept.
  bool keep(std::size_t level, const std::string& key) {
    if (dropped_ > 0 && level > dropped_) return false;
    dropped_ = 0;
    keys_.resize(level);
    keys_[level - 1] = key;
    path_.clear();
    for (const std::string& k : keys_) {
      if (k.empty()) continue;
      if (!path_.empty()) path_ += '/';
      path_ += k;
    }
    const Rule* rule = key.empty() ? nullptr : findRule(path_);
    if (rule != nullptr && rule->type == Type::noted) addNote(notes_, std::string(rule->note));
    if (rule == nullptr || rule->type == Type::noted) {
      dropped_ = level;
      return false;
    }
    if (!seen_[level - 1].insert(rule).second)
      throw Error(where_, fmt::format("key '{}' is there twice in one object", path_), "each key once");
    return true;
  }

  void count() {
    if (objectsLeft_-- == 0)
      throw Error(where_, "holds more objects than its size gives reason for",
                  fmt::format("at most {}, or one for {} bytes", kMinObjects, kBytesPerObject));
  }

  const std::string& where_;
  std::vector<std::string>& notes_;
  std::size_t objectsLeft_;
  std::size_t dropped_ = 0;                  // level of the key whose value is being dropped; 0: none
  std::vector<std::string> keys_;            // that lead here, by level; empty where an array is
  std::vector<std::set<const Rule*>> seen_;  // of the open objects, by level
  std::string path_;
};

// Whether every kept value is what its rule says. Whole numbers that stand for real ones become real, because tinygltf
// takes them through int in places.
class TypeCheck {
 public:
  explicit TypeCheck(const std::string& where) : where_(where) {}

  // path: of rules; place: for messages.
  void object(json& value, const std::string& path, const std::string& place) const {
    for (const std::string_view key : requiredKeys(path))
      if (!value.contains(key)) throw Error(fmt::format("{}: {}", where_, joined(place, key)), "is missing", "it");
    for (auto item = value.begin(); item != value.end(); ++item)
      check(item.value(), path.empty() ? item.key() : path + "/" + item.key(), joined(place, item.key()));
  }

 private:
  static std::string joined(const std::string& place, std::string_view key) {
    return place.empty() ? std::string(key) : fmt::format("{}.{}", place, key);
  }

  [[noreturn]] void fail(const std::string& place, std::string_view expected, const json& found) const {
    std::string text = found.is_structured() ? std::string(found.type_name()) : found.dump();
    if (text.size() > 40) text = text.substr(0, 40) + "...";
    throw Error(fmt::format("{}: {}", where_, place), "is of the wrong type", expected, text);
  }

  void wholeNumber(const json& value, const std::string& place, std::int64_t most) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > static_cast<std::uint64_t>(most))
      fail(place, fmt::format("a whole number of 0 to {}", most), value);
  }

  void check(json& value, const std::string& path, const std::string& place) const {
    const Rule& rule = *findRule(path);  // nothing else is kept
    switch (rule.type) {
      case Type::object:
        if (!value.is_object()) fail(place, "an object", value);
        object(value, path, place);
        break;
      case Type::objects:
        if (!value.is_array()) fail(place, "a list of objects", value);
        for (std::size_t i = 0; i < value.size(); ++i) {
          const std::string item = fmt::format("{}[{}]", place, i);
          if (!value[i].is_object()) fail(item, "an object", value[i]);
          object(value[i], path, item);
        }
        break;
      case Type::index:
        wholeNumber(value, place, kMaxIndex);
        break;
      case Type::size:
        wholeNumber(value, place, kMaxSize);
        break;
      case Type::indices:
        if (!value.is_array()) fail(place, "a list of whole numbers", value);
        for (const json& item : value) wholeNumber(item, place, kMaxIndex);
        break;
      case Type::number:
        if (!value.is_number()) fail(place, "a number", value);
        value = value.get<double>();
        break;
      case Type::numbers:
        if (!value.is_array() || value.size() != rule.size) fail(place, fmt::format("{} numbers", rule.size), value);
        for (json& item : value) {
          if (!item.is_number()) fail(place, fmt::format("{} numbers", rule.size), item);
          item = item.get<double>();
        }
        break;
      case Type::text:
        if (!value.is_string()) fail(place, "a string", value);
        break;
      case Type::texts:
        if (!value.is_array()) fail(place, "a list of strings", value);
        for (const json& item : value)
          if (!item.is_string()) fail(place, "a list of strings", item);
        break;
      case Type::flag:
        if (!value.is_boolean()) fail(place, "true or false", value);
        break;
      case Type::noted:
        break;
    }
  }

  const std::string& where_;
};

void checkVersion(const json& asset, const std::string& where) {
  const auto isTwo = [](const std::string& version) { return version == "2" || version.starts_with("2."); };
  const std::string version = asset.at("version").get<std::string>();
  if (!isTwo(version)) throw Error(where + ": asset.version", "is of another version", "2.0", "'" + version + "'");
  const std::string least = asset.value("minVersion", "2.0");
  if (least != "2.0" && least != "2") throw Error(where + ": asset.minVersion", "is of a later version", "2.0", least);
}

void checkExtensions(const json& document, const std::string& where, std::vector<std::string>& notes) {
  const auto known = [](const std::string& name) {
    return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
  };
  const auto names = [&](const char* key) { return document.value(key, std::vector<std::string>()); };
  for (const std::string& name : names("extensionsRequired"))
    if (!known(name))
      throw Error(where + ": extensionsRequired", "names an extension that is not known",
                  fmt::format("{}", fmt::join(kKnownExtensions, ", ")), "'" + name.substr(0, 60) + "'");
  for (const std::string& name : names("extensionsUsed"))
    if (!known(name)) addNote(notes, fmt::format("extension {}", name.substr(0, 60)));
}

}  // namespace

GltfJson parseGltfJson(std::string_view text, const std::string& where) {
  GltfJson result;

  // Step 1: parse what is on the whitelist.
  Filter filter(text.size(), where, result.notes);
  try {
    result.document = json::parse(
        text, [&filter](int depth, json::parse_event_t event, json& value) { return filter(depth, event, value); });
  } catch (const json::parse_error& error) {
    throw Error(fmt::format("{}, byte {} of the JSON", where, error.byte > 0 ? error.byte - 1 : 0), "is not JSON",
                "glTF 2.0", error.what());
  } catch (const json::exception& error) {  // a number such as 1e999
    throw Error(where, "holds a number that no double holds", "glTF 2.0", error.what());
  }

  // Step 2: types, version, extensions.
  if (!result.document.is_object()) throw Error(where, "is no glTF", "a JSON object", result.document.type_name());
  TypeCheck(where).object(result.document, "", "");
  checkVersion(result.document.at("asset"), where);
  checkExtensions(result.document, where, result.notes);
  return result;
}

}  // namespace malus::prep

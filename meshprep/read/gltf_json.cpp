#include "meshprep/read/gltf_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_noted.h"
#include "meshprep/read/gltf_rules.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {
using gltf::findRule;
using gltf::Invalid;
using gltf::requiredKeys;
using gltf::Rule;
using gltf::Type;
using nlohmann::json;

namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMinObjects = 200'000;  // lower bound of the limit
constexpr std::size_t kBytesPerObject = 50;
constexpr std::int64_t kMaxIndex = 0x7fffffff;
constexpr std::int64_t kMaxSize = std::int64_t{1} << 53;  // exact in every JSON reader

// Extensions that are read, and those that affect ignored textures only.
constexpr auto kKnownExtensions = std::to_array<std::string_view>(
    {"KHR_draco_mesh_compression", "KHR_mesh_quantization", "KHR_materials_ior", "KHR_materials_transmission",
     "KHR_materials_volume", "KHR_materials_emissive_strength", "KHR_texture_transform", "KHR_texture_basisu",
     "EXT_texture_webp", "EXT_texture_avif", "KHR_lights_punctual", "EXT_mesh_gpu_instancing",
     "EXT_meshopt_compression", "KHR_materials_specular", "KHR_materials_iridescence", "KHR_materials_clearcoat",
     "KHR_materials_pbrSpecularGlossiness", "KHR_materials_variants"});

// Builds the document of kept keys from the parser's events. nlohmann's filter by callback needs quadratic time,
// because it searches the whole list at the end of each object.
class Builder : public json::json_sax_t {
 public:
  Builder(std::size_t textBytes, const std::string& where)
      : where_(where), objectsLeft_(std::max(kMinObjects, textBytes / kBytesPerObject)) {}

  json take() { return std::move(root_); }
  std::vector<std::string> describeNoted() const { return noted_.describe(); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string&) override { return put(value); }
  bool string(std::string& value) override {
    if (isKept()) count();
    noted_.string(droppedLevels_, value);
    return put(std::move(value));
  }
  bool binary(json::binary_t&) override { return false; }  // not in JSON
  bool start_object(std::size_t) override {
    if (isKept()) count();
    return open(json::object());
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_array() override { return close(); }

  bool key(std::string& key) override {
    if (droppedLevels_ > 0) {
      noted_.key(droppedLevels_, key);
      return true;
    }
    Open& object = open_.back();
    path_.resize(object.pathSize);
    if (!path_.empty()) path_ += '/';
    path_ += key;
    const Rule* rule = findRule(path_);
    isDropped_ = rule == nullptr || rule->type == Type::noted;
    noted_.begin(path_, rule == nullptr ? gltf::unknownKeyNote(path_) : std::string(isDropped_ ? rule->note : ""));
    if (isDropped_) return true;
    if (object.value->contains(key))
      throw Error(where_, fmt::format("duplicate key '{}'", path_), "each key once per object");
    key_ = std::move(key);
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const json::exception& error) override {
    constexpr int kNumberOutOfRange = 406;
    const std::string location = fmt::format("{}, byte {} of the JSON", where_, byte > 0 ? byte - 1 : 0);
    if (error.id == kNumberOutOfRange)
      throw Error(location, fmt::format("number out of the range of double: {}", error.what()), "a size up to 1.8e308");
    throw Error(location, fmt::format("is not JSON: {}", error.what()), "glTF 2.0");
  }

 private:
  // List or object that has not ended.
  struct Open {
    json* value;
    std::size_t pathSize;  // length of its path; lists have the path of their key
  };

  bool isKept() const { return droppedLevels_ == 0 && !isDropped_; }

  // Inserts a kept value into the document.
  json* insert(json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    json& parent = *open_.back().value;
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    return &(parent[key_] = std::move(value));
  }

  bool put(json value) {
    if (isKept()) insert(std::move(value));
    noted_.value(droppedLevels_, false);
    if (droppedLevels_ == 0) isDropped_ = false;
    return true;
  }

  bool open(json value) {
    if (++levels_ > kMaxNesting)
      throw Error(where_, "JSON is nested too deeply", fmt::format("at most {} levels", kMaxNesting));
    if (!isKept()) {
      noted_.value(droppedLevels_, value.is_array());
      ++droppedLevels_;
      isDropped_ = false;
      return true;
    }
    // Restore the path of the list, which the last object may have extended.
    if (!open_.empty() && open_.back().value->is_array()) path_.resize(open_.back().pathSize);
    open_.push_back({insert(std::move(value)), path_.size()});
    return true;
  }

  bool close() {
    --levels_;
    if (droppedLevels_ > 0)
      --droppedLevels_;
    else
      open_.pop_back();
    return true;
  }

  void count() {
    if (objectsLeft_-- == 0)
      throw Error(where_, "too many objects for the file size",
                  fmt::format("at most {}, or one per {} bytes", kMinObjects, kBytesPerObject));
  }

  const std::string& where_;
  GltfNotedContent noted_;
  std::size_t objectsLeft_;
  json root_;
  std::vector<Open> open_;
  std::string path_;  // path of the last key
  std::string key_;
  int levels_ = 0;
  int droppedLevels_ = 0;   // levels within a dropped value
  bool isDropped_ = false;  // the value of the last key is dropped
};

// Checks the types of kept values by their rules. Leaves out what is invalid.
class TypeCheck {
 public:
  TypeCheck(const std::string& where, GltfLeftOut& leftOut) : where_(where), leftOut_(leftOut) {}

  // path: of the rules, without indices. location: for messages.
  void object(json& value, const std::string& path, const std::string& location) const {
    for (const std::string_view key : requiredKeys(path))
      if (!value.contains(key))
        throw Error(fmt::format("{}: {}", where_, joined(location, key)), "missing key", fmt::format("'{}'", key));
    for (auto item = value.begin(); item != value.end();) {
      const std::string itemPath = path.empty() ? item.key() : path + "/" + item.key();
      const Rule& rule = *findRule(itemPath);  // exists for every kept value
      try {
        check(item.value(), rule, itemPath, joined(location, item.key()));
        ++item;
      } catch (const Error& error) {
        if (rule.invalid == Invalid::object) throw;
        if (rule.invalid == Invalid::value) {
          leftOut_.addValue(error);
          item = value.erase(item);
        } else {
          leftOut_.addPart(error);
          *item++ = nullptr;
        }
      }
    }
  }

 private:
  static std::string joined(const std::string& location, std::string_view key) {
    return location.empty() ? std::string(key) : fmt::format("{}.{}", location, key);
  }

  [[noreturn]] void fail(const std::string& location, std::string_view expected, const json& found) const {
    std::string text = found.is_structured() ? std::string(found.type_name()) : found.dump();
    if (text.size() > 40) text = text.substr(0, 40) + "...";
    throw Error(fmt::format("{}: {}", where_, location), "wrong type", expected, text);
  }

  // Accepts a fraction of zero, which glTF does not permit.
  void wholeNumber(json& value, const std::string& location, std::int64_t most) const {
    if (value.is_number_float()) {
      const double number = value.get<double>();
      if (number >= 0 && number <= static_cast<double>(most) && number == std::floor(number)) {
        value = static_cast<std::uint64_t>(number);
        addNote(leftOut_.notes(), std::string(kAcceptedNote) + "integers with a decimal point");
      }
    }
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > static_cast<std::uint64_t>(most))
      fail(location, fmt::format("an integer from 0 to {}", most), value);
  }

  // Materials, cameras and lights become empty objects, which have defaults or are checked where they are used.
  void objects(json& value, const Rule& rule, const std::string& path, const std::string& location) const {
    if (!value.is_array()) fail(location, "a list of objects", value);
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string item = fmt::format("{}[{}]", location, i);
      try {
        if (!value[i].is_object()) fail(item, "an object", value[i]);
        object(value[i], path, item);
      } catch (const Error& error) {
        if (path == "materials" || rule.invalid == Invalid::value) {
          leftOut_.addValue(error);
          value[i] = json::object();
        } else {
          leftOut_.addPart(error);
          value[i] = nullptr;
        }
      }
    }
  }

  // Leaves out the invalid items.
  void indices(json& value, const std::string& location) const {
    if (!value.is_array()) fail(location, "a list of integers", value);
    json::array_t kept;
    kept.reserve(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      try {
        wholeNumber(value[i], fmt::format("{}[{}]", location, i), kMaxIndex);
        kept.push_back(std::move(value[i]));
      } catch (const Error& error) {
        leftOut_.addPart(error);
      }
    }
    value = std::move(kept);
  }

  // Leaves out the invalid items of a list with a default.
  void texts(json& value, const Rule& rule, const std::string& location) const {
    if (!value.is_array()) fail(location, "a list of strings", value);
    json::array_t kept;
    kept.reserve(value.size());
    for (json& item : value) {
      try {
        if (!item.is_string()) fail(location, "a list of strings", item);
        kept.push_back(std::move(item));
      } catch (const Error& error) {
        if (rule.invalid != Invalid::value) throw;
        leftOut_.addValue(error);
      }
    }
    value = std::move(kept);
  }

  void check(json& value, const Rule& rule, const std::string& path, const std::string& location) const {
    switch (rule.type) {
      case Type::object:
        if (!value.is_object()) fail(location, "an object", value);
        object(value, path, location);
        break;
      case Type::objects:
        objects(value, rule, path, location);
        break;
      case Type::index:
        wholeNumber(value, location, kMaxIndex);
        break;
      case Type::size:
        wholeNumber(value, location, kMaxSize);
        break;
      case Type::indices:
        indices(value, location);
        break;
      case Type::number:
        if (!value.is_number()) fail(location, "a number", value);
        break;
      case Type::numbers:
        if (!value.is_array() || value.size() != rule.size) fail(location, fmt::format("{} numbers", rule.size), value);
        for (const json& item : value)
          if (!item.is_number()) fail(location, fmt::format("{} numbers", rule.size), item);
        break;
      case Type::numberList:
        if (!value.is_array()) fail(location, "a list of numbers", value);
        for (const json& item : value)
          if (!item.is_number()) fail(location, "a list of numbers", item);
        break;
      case Type::text:
        if (!value.is_string()) fail(location, "a string", value);
        break;
      case Type::texts:
        texts(value, rule, location);
        break;
      case Type::flag:
        if (!value.is_boolean()) fail(location, "true or false", value);
        break;
      case Type::unchecked:
      case Type::noted:
        break;
    }
  }

  const std::string& where_;
  GltfLeftOut& leftOut_;
};

void checkVersion(const json& asset, const std::string& where) {
  const auto isTwo = [](const std::string& version) { return version == "2" || version.starts_with("2."); };
  const std::string version = asset.at("version").get<std::string>();
  if (!isTwo(version)) throw Error(where + ": asset.version", "unsupported version", "2.0", "'" + version + "'");
  const std::string least = asset.value("minVersion", "2.0");
  if (least != "2.0" && least != "2") throw Error(where + ": asset.minVersion", "unsupported version", "2.0", least);
}

void checkExtensions(const json& document, const std::string& where, std::vector<std::string>& notes) {
  const auto known = [](const std::string& name) {
    return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
  };
  const auto names = [&](const char* key) { return document.value(key, std::vector<std::string>()); };
  for (const std::string& name : names("extensionsRequired"))
    if (!known(name))
      throw Error(where + ": extensionsRequired", "unknown extension",
                  fmt::format("{}", fmt::join(kKnownExtensions, ", ")), "'" + name.substr(0, 60) + "'");
  for (const std::string& name : names("extensionsUsed")) {
    // One that is in place has a note with its number.
    const std::string note = fmt::format("extension {}", name.substr(0, 60));
    const bool isNoted = std::any_of(notes.begin(), notes.end(),
                                     [&](const std::string& other) { return other.starts_with(note + " ("); });
    if (!known(name) && !isNoted) addNote(notes, note);
  }
}

}  // namespace

json parseGltfJson(std::string_view text, const std::string& where, GltfLeftOut& leftOut) {
  // Parse the keys of the whitelist.
  Builder builder(text.size(), where);
  json::sax_parse(text, &builder);
  for (std::string& note : builder.describeNoted()) addNote(leftOut.notes(), std::move(note));
  json document = builder.take();

  // Check types, version and extensions.
  if (!document.is_object()) throw Error(where, "is not glTF", "a JSON object", document.type_name());
  TypeCheck(where, leftOut).object(document, "", "");
  checkVersion(document.at("asset"), where);
  checkExtensions(document, where, leftOut.notes());
  return document;
}

}  // namespace malus::prep

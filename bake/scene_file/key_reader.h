// Reads the keys of an object of scene.json by their description (bake/pack/field.h): a visitor that checks presence,
// type and range, and accepts deprecated names.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/vec3.hpp>

#include "bake/pack/field.h"
#include "bake/scene_file/strict_object.h"

namespace malus::bake {

class KeyReader {
 public:
  // kinds: those of the material that the object describes; keys of other kinds are unknown.
  explicit KeyReader(StrictObject& object, pack::KindSet kinds = pack::kEveryKind) : object_(object), kinds_(kinds) {}

  // An absent optional key keeps the value, which is the default, or sets the field's fallback. A field "coating.eta"
  // is looked for in the object "coating", if that is present. Throws Error.
  template <class T>
  void operator()(const pack::Field& field, std::optional<T>& value) {
    if (object_.has(std::string(field.name).c_str())) (*this)(field, value.emplace());
  }
  template <class T>
  void operator()(const pack::Field& field, T& value) {
    if constexpr (kIsReadable<T>) {
      if (field.key == pack::Key::none || (field.kinds & kinds_) == 0) return;
      const auto dot = field.name.find('.');
      if (dot == std::string_view::npos) {
        read(object_, std::string(field.name), field, value);
      } else if (StrictObject* nested = findNested(std::string(field.name.substr(0, dot)))) {
        read(*nested, std::string(field.name.substr(dot + 1)), field, value);
      }
    }
  }

  // Call it last, before finish() of the object: throws Error for unknown keys of the nested objects.
  void finish() {
    for (auto& [key, object] : nested_) object.finish();
  }

 private:
  // Types of values that keys have; those of the pack alone (kind, index of a texture) are not read by rows.
  template <class T>
  static constexpr bool kIsReadable =
      std::is_same_v<T, double> || std::is_same_v<T, glm::dvec3> || std::is_same_v<T, std::uint32_t> ||
      std::is_same_v<T, std::uint64_t> || std::is_same_v<T, bool> || std::is_same_v<T, std::string>;

  template <class T>
  void read(StrictObject& object, const std::string& name, const pack::Field& field, T& value) {
    const std::string key = object.resolve(name, field.alias);
    if (field.key == pack::Key::required || object.has(key.c_str()))
      value = checked(object, key.c_str(), field, value);
    else if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, bool>)
      if (field.fallback) value = T(*field.fallback);
  }

  StrictObject* findNested(const std::string& key);

  static double checked(StrictObject& object, const char* key, const pack::Field& field, double);
  static glm::dvec3 checked(StrictObject& object, const char* key, const pack::Field& field, const glm::dvec3&);
  static std::uint32_t checked(StrictObject& object, const char* key, const pack::Field& field, std::uint32_t);
  static std::uint64_t checked(StrictObject& object, const char* key, const pack::Field& field, std::uint64_t);
  static bool checked(StrictObject& object, const char* key, const pack::Field& field, bool);
  static std::string checked(StrictObject& object, const char* key, const pack::Field& field, const std::string&);

  StrictObject& object_;
  pack::KindSet kinds_;
  std::map<std::string, StrictObject> nested_;
};

// A direction of any length as a unit vector. Throws Error if it is 0.
glm::dvec3 readDirection(StrictObject& object, const char* key);

}  // namespace malus::bake

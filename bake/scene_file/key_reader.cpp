#include "bake/scene_file/key_reader.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/scene_file/scene_keys.h"

namespace malus::bake {

StrictObject* KeyReader::findNested(const std::string& key) {
  const auto found = nested_.find(key);
  if (found != nested_.end()) return &found->second;
  if (!object_.has(key.c_str())) return nullptr;
  return &nested_.emplace(key, object_.object(key.c_str())).first->second;
}

double KeyReader::checked(StrictObject& object, const char* key, const pack::Field& field, double) {
  const double low = field.lowInScene(), high = field.highInScene(), value = object.number(key, low, high);
  if (field.excludesLow && value == low)
    object.fail(key, "is out of range", fmt::format("over {:g}, up to {:g}", low, high), fmt::format("{:g}", value));
  return value;
}

glm::dvec3 KeyReader::checked(StrictObject& object, const char* key, const pack::Field& field, const glm::dvec3&) {
  const double low = field.lowInScene(), high = field.highInScene();
  if (field.shape == pack::Shape::numberOrVector) return object.numberOrVector(key, low, high);
  if (field.shape == pack::Shape::vector) return object.vector(key, low, high);
  return readDirection(object, key);
}

std::uint32_t KeyReader::checked(StrictObject& object, const char* key, const pack::Field& field, std::uint32_t) {
  return object.integer(key, static_cast<std::uint32_t>(field.lowInScene()),
                        static_cast<std::uint32_t>(field.highInScene()));
}

std::uint64_t KeyReader::checked(StrictObject& object, const char* key, const pack::Field& field, std::uint64_t) {
  return checked(object, key, field, std::uint32_t{0});
}

bool KeyReader::checked(StrictObject& object, const char* key, const pack::Field&, bool) {
  return object.flag(key, false);
}

std::string KeyReader::checked(StrictObject& object, const char* key, const pack::Field&, const std::string&) {
  return object.text(key);
}

glm::dvec3 readDirection(StrictObject& object, const char* key) {
  const glm::dvec3 v = object.vector(key, -kMaxSceneLength, kMaxSceneLength);
  const double length = glm::length(v);
  if (!(length > 0)) object.fail(key, "has no direction", "a vector other than 0");
  return v / length;
}

}  // namespace malus::bake

#include "bake/scene_file/strict_object.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {
using nlohmann::json;

namespace {

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

}  // namespace

StrictObject::StrictObject(const json& value, std::string where, std::string path, std::vector<std::string>* notes)
    : value_(&value), where_(std::move(where)), path_(std::move(path)), notes_(notes) {
  if (!value.is_object()) throw Error(where_, path_.empty() ? "top level" : path_, "an object", shown(value));
}

std::string StrictObject::keyPath(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void StrictObject::fail(std::string_view key, std::string_view problem, std::string_view expected,
                        std::string_view found) const {
  throw Error(where_, fmt::format("{}: {}", keyPath(key), problem), expected, found);
}

bool StrictObject::has(const char* key) {
  known_.emplace_back(key);
  return value_->contains(key);
}

const json& StrictObject::at(const char* key) {
  if (!has(key)) {
    // A missing key is often a misspelt one.
    std::vector<std::string> present;
    for (const auto& item : value_->items()) present.push_back(item.key());
    const std::string near = nearestName(key, present);
    fail(key, "is missing", "the key", near.empty() ? "" : fmt::format("'{}'", near));
  }
  return value_->at(key);
}

StrictObject StrictObject::object(const char* key) { return {at(key), where_, keyPath(key), notes_}; }

std::size_t StrictObject::listSize(const char* key, std::string_view expected) {
  const json& value = at(key);
  if (!value.is_array()) fail(key, "must be a list", expected, shown(value));
  return value.size();
}

StrictObject StrictObject::element(const char* key, std::size_t index) {
  return {at(key).at(index), where_, fmt::format("{}[{}]", keyPath(key), index), notes_};
}

std::string StrictObject::resolve(std::string_view key, std::string_view alias) {
  if (alias.empty() || !value_->contains(alias)) return std::string(key);
  if (value_->contains(key))
    fail(alias, fmt::format("is the deprecated name of '{}', which is present too", key), fmt::format("'{}'", key));
  if (notes_ != nullptr) notes_->push_back(fmt::format("{}: {} is deprecated, use '{}'", where_, keyPath(alias), key));
  return std::string(alias);
}

std::string StrictObject::text(const char* key) {
  const json& value = at(key);
  if (!value.is_string()) fail(key, "must be text", "a string", shown(value));
  return value.get<std::string>();
}

std::string StrictObject::text(const char* key, std::string_view fallback) {
  return has(key) ? text(key) : std::string(fallback);
}

bool StrictObject::flag(const char* key, bool fallback) {
  if (!has(key)) return fallback;
  const json& value = value_->at(key);
  if (!value.is_boolean()) fail(key, "must be true or false", "true or false", shown(value));
  return value.get<bool>();
}

double StrictObject::checkedNumber(const json& value, const char* key, double low, double high) const {
  if (!value.is_number()) fail(key, "must be a number", "a number", shown(value));
  const double number = value.get<double>();
  if (!(number >= low && number <= high))
    fail(key, "is out of range", fmt::format("{:g} to {:g}", low, high), shown(value));
  return number;
}

glm::dvec3 StrictObject::checkedVector(const json& value, const char* key, double low, double high) const {
  if (!value.is_array() || value.size() != 3) fail(key, "must be a vector", "a list of three numbers", shown(value));
  return {checkedNumber(value[0], key, low, high), checkedNumber(value[1], key, low, high),
          checkedNumber(value[2], key, low, high)};
}

double StrictObject::number(const char* key, double low, double high) { return checkedNumber(at(key), key, low, high); }

double StrictObject::number(const char* key, double low, double high, double fallback) {
  return has(key) ? number(key, low, high) : fallback;
}

std::uint32_t StrictObject::integer(const char* key, std::uint32_t low, std::uint32_t high) {
  const json& value = at(key);
  if (!value.is_number_integer()) fail(key, "must be a whole number", fmt::format("{} to {}", low, high), shown(value));
  return static_cast<std::uint32_t>(checkedNumber(value, key, low, high));
}

std::uint32_t StrictObject::integer(const char* key, std::uint32_t low, std::uint32_t high, std::uint32_t fallback) {
  return has(key) ? integer(key, low, high) : fallback;
}

glm::dvec3 StrictObject::vector(const char* key, double low, double high) {
  return checkedVector(at(key), key, low, high);
}

glm::dvec3 StrictObject::vector(const char* key, double low, double high, const glm::dvec3& fallback) {
  return has(key) ? vector(key, low, high) : fallback;
}

glm::dvec3 StrictObject::numberOrVector(const char* key, double low, double high) {
  const json& value = at(key);
  if (value.is_number()) return glm::dvec3(checkedNumber(value, key, low, high));
  return checkedVector(value, key, low, high);
}

glm::dvec3 StrictObject::numberOrVector(const char* key, double low, double high, const glm::dvec3& fallback) {
  return has(key) ? numberOrVector(key, low, high) : fallback;
}

void StrictObject::finish() {
  for (const auto& item : value_->items()) {
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    const std::string near = nearestName(item.key(), known_);
    const std::set<std::string> known(known_.begin(), known_.end());
    fail(item.key(), "unknown key",
         near.empty() ? fmt::format("one of '{}'", fmt::join(known, "', '")) : fmt::format("'{}'", near));
  }
}

}  // namespace malus::bake

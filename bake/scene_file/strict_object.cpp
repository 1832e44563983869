#include "bake/scene_file/strict_object.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;

namespace {

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearestName(std::string_view name, const std::vector<std::string>& names) {
  std::string best;
  std::size_t bestDistance = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const std::string& candidate : names) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < bestDistance) best = candidate, bestDistance = distance;
  }
  return best;
}

StrictObject::StrictObject(const json& value, std::string where, std::string path)
    : value_(&value), where_(std::move(where)), path_(std::move(path)) {
  if (!value.is_object()) throw Error(where_, path_.empty() ? "top level" : path_, "an object", shown(value));
}

std::string StrictObject::pathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void StrictObject::fail(std::string_view key, std::string_view problem, std::string_view expected,
                        std::string_view found) const {
  throw Error(where_, fmt::format("{}: {}", pathOf(key), problem), expected, found);
}

bool StrictObject::has(const char* key) {
  known_.emplace_back(key);
  return value_->contains(key);
}

const json& StrictObject::at(const char* key) {
  if (!has(key)) {
    // A misspelt key explains a missing one best.
    std::vector<std::string> present;
    for (const auto& item : value_->items()) present.push_back(item.key());
    const std::string near = nearestName(key, present);
    fail(key, "is missing", "it", near.empty() ? "" : fmt::format("'{}'", near));
  }
  return value_->at(key);
}

StrictObject StrictObject::object(const char* key) { return {at(key), where_, pathOf(key)}; }

std::string StrictObject::text(const char* key) {
  const json& value = at(key);
  if (!value.is_string()) fail(key, "is no text", "a string", shown(value));
  return value.get<std::string>();
}

std::string StrictObject::text(const char* key, std::string_view fallback) {
  return has(key) ? text(key) : std::string(fallback);
}

bool StrictObject::flag(const char* key, bool fallback) {
  if (!has(key)) return fallback;
  const json& value = value_->at(key);
  if (!value.is_boolean()) fail(key, "is no flag", "true or false", shown(value));
  return value.get<bool>();
}

double StrictObject::checkedNumber(const json& value, const char* key, double low, double high) const {
  if (!value.is_number()) fail(key, "is no number", "a number", shown(value));
  const double number = value.get<double>();
  if (!(number >= low && number <= high))
    fail(key, "is out of range", fmt::format("{:g} to {:g}", low, high), shown(value));
  return number;
}

glm::dvec3 StrictObject::checkedVector(const json& value, const char* key, double low, double high) const {
  if (!value.is_array() || value.size() != 3) fail(key, "is no vector", "a list of three numbers", shown(value));
  return {checkedNumber(value[0], key, low, high), checkedNumber(value[1], key, low, high),
          checkedNumber(value[2], key, low, high)};
}

double StrictObject::number(const char* key, double low, double high) { return checkedNumber(at(key), key, low, high); }

double StrictObject::number(const char* key, double low, double high, double fallback) {
  return has(key) ? number(key, low, high) : fallback;
}

std::uint32_t StrictObject::integer(const char* key, std::uint32_t low, std::uint32_t high) {
  const json& value = at(key);
  if (!value.is_number_integer()) fail(key, "is no whole number", fmt::format("{} to {}", low, high), shown(value));
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
    fail(item.key(), "unknown key", near.empty() ? "a key that bake/SCENE.md lists" : fmt::format("'{}'", near));
  }
}

}  // namespace malus::bake

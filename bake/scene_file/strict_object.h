// A JSON object whose every key must be asked for: what is left over is an error that names the key and
// the nearest known one. All errors carry the path inside the document ("camera.position").
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace malus::bake {

class StrictObject {
 public:
  // where: the file; path: position inside it, "" at the top. Throws Error if value is no object.
  StrictObject(const nlohmann::json& value, std::string where, std::string path);

  bool has(const char* key);
  const nlohmann::json& at(const char* key);  // throws Error where it is missing
  StrictObject object(const char* key);
  std::string text(const char* key);
  std::string text(const char* key, std::string_view fallback);
  bool flag(const char* key, bool fallback);
  double number(const char* key, double low, double high);
  double number(const char* key, double low, double high, double fallback);
  std::uint32_t integer(const char* key, std::uint32_t low, std::uint32_t high);
  std::uint32_t integer(const char* key, std::uint32_t low, std::uint32_t high, std::uint32_t fallback);
  glm::dvec3 vector(const char* key, double low, double high);
  glm::dvec3 vector(const char* key, double low, double high, const glm::dvec3& fallback);
  glm::dvec3 numberOrVector(const char* key, double low, double high);
  glm::dvec3 numberOrVector(const char* key, double low, double high, const glm::dvec3& fallback);

  // To be called last: throws Error for a key that nobody asked for.
  void finish();

  [[noreturn]] void fail(std::string_view key, std::string_view problem, std::string_view expected,
                         std::string_view found = {}) const;
  std::string pathOf(std::string_view key) const;

 private:
  double checkedNumber(const nlohmann::json& value, const char* key, double low, double high) const;
  glm::dvec3 checkedVector(const nlohmann::json& value, const char* key, double low, double high) const;

  const nlohmann::json* value_;
  std::string where_;
  std::string path_;
  std::vector<std::string> known_;
};

// The nearest of the names by edit distance; empty where none is near.
std::string nearestName(std::string_view name, const std::vector<std::string>& names);

}  // namespace malus::bake

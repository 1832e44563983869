// A JSON object of which every key must be read: finish() refuses the others and names the nearest known key, or all.
// All errors name the file and the path inside the document ("camera.position").
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
  // where: the file; path: position inside it, "" at the top; notes: receives a line per deprecated key, may be null.
  // Throws Error if the value is not an object.
  StrictObject(const nlohmann::json& value, std::string where, std::string path,
               std::vector<std::string>* notes = nullptr);

  // The name under which a key is present: its own, or its deprecated alias, which is noted. Throws Error if both are.
  std::string resolve(std::string_view key, std::string_view alias);

  bool has(const char* key);
  const nlohmann::json& at(const char* key);  // throws Error if it is missing
  StrictObject object(const char* key);
  // Number of elements of a list; expected: the list, for the error.
  std::size_t listSize(const char* key, std::string_view expected);
  StrictObject element(const char* key, std::size_t index);  // an object in a list
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

  // Call it last: throws Error for a key that was not read.
  void finish();

  [[noreturn]] void fail(std::string_view key, std::string_view problem, std::string_view expected,
                         std::string_view found = {}) const;

 private:
  double checkedNumber(const nlohmann::json& value, const char* key, double low, double high) const;
  glm::dvec3 checkedVector(const nlohmann::json& value, const char* key, double low, double high) const;

  const nlohmann::json* value_;
  std::string where_;
  std::string path_;
  std::string keyPath(std::string_view key) const;

  std::vector<std::string> known_;
  std::vector<std::string>* notes_;
};

}  // namespace malus::bake

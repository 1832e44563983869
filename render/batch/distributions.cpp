#include "render/batch/distributions.h"

#include <cmath>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {
using nlohmann::json;

namespace {

std::uint64_t splitMix(std::uint64_t state) {
  std::uint64_t z = state + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31u);
}

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

// Draws the values of one frame.
class Drawing {
 public:
  Drawing(std::uint64_t seed, std::uint64_t frame, const std::string& where)
      : seed_(seed), frame_(frame), where_(where) {}

  json draw(const json& value, const std::string& path) const {
    if (value.is_array()) {
      json list = json::array();
      for (std::size_t i = 0; i < value.size(); ++i) list.push_back(draw(value[i], fmt::format("{}[{}]", path, i)));
      return list;
    }
    if (!value.is_object()) return value;
    if (isDistribution(value)) return drawOne(value, path);
    json object = json::object();
    for (const auto& item : value.items())
      object[item.key()] = draw(item.value(), path.empty() ? item.key() : path + "." + item.key());
    return object;
  }

 private:
  static bool isDistribution(const json& object) {
    return object.contains("uniform") || object.contains("logUniform") || object.contains("list");
  }

  [[noreturn]] void fail(const std::string& path, const char* key, const char* problem, const char* expected,
                         const json& found) const {
    throw Error(where_, fmt::format("{}.{}: {}", path, key, problem), expected, found.dump());
  }

  json drawOne(const json& object, const std::string& path) const {
    const std::string key = object.begin().key();
    if (object.size() != 1)
      fail(path, key.c_str(), "a distribution has one key", "one of 'uniform', 'logUniform' and 'list'", object);
    const json& value = object.begin().value();
    if (key == "list") {
      if (!value.is_array() || value.empty()) fail(path, "list", "must be a list", "one or more values", value);
      const double size = static_cast<double>(value.size());
      return value[static_cast<std::size_t>(randomNumber(seed_, frame_, path) * size)];
    }
    const bool isLog = key == "logUniform";
    if (!value.is_array() || value.size() != 2)
      fail(path, key.c_str(), "must have two bounds", "a list [LOW, HIGH]", value);
    const json &low = value[0], &high = value[1];
    if (!low.is_array() && !high.is_array()) return between(low, high, isLog, path, path, key);
    if (!low.is_array() || !high.is_array() || low.size() != high.size())
      fail(path, key.c_str(), "has bounds of different sizes", "two numbers, or two lists of the same length", value);
    json vector = json::array();
    for (std::size_t i = 0; i < low.size(); ++i)
      vector.push_back(between(low[i], high[i], isLog, fmt::format("{}[{}]", path, i), path, key));
    return vector;
  }

  double between(const json& low, const json& high, bool isLog, const std::string& drawn, const std::string& path,
                 const std::string& key) const {
    if (!low.is_number() || !high.is_number())
      fail(path, key.c_str(), "has a bound that is not a number", "[LOW, HIGH]", json::array({low, high}));
    const double a = low.get<double>(), b = high.get<double>();
    if (!(a <= b))
      fail(path, key.c_str(), "has bounds in the wrong order", "LOW at most HIGH", json::array({low, high}));
    if (isLog && !(a > 0)) fail(path, key.c_str(), "has a bound without a logarithm", "LOW over 0", low);
    const double t = randomNumber(seed_, frame_, drawn);
    const double value = isLog ? std::exp(std::log(a) + t * (std::log(b) - std::log(a))) : a + t * (b - a);
    return std::fmin(std::fmax(value, a), b);  // rounding must not leave the interval
  }

  std::uint64_t seed_, frame_;
  const std::string& where_;
};

}  // namespace

std::uint64_t frameSeed(std::uint64_t seed, std::uint64_t frame) { return splitMix(splitMix(seed) ^ frame); }

double randomNumber(std::uint64_t seed, std::uint64_t frame, std::string_view path) {
  return static_cast<double>(splitMix(frameSeed(seed, frame) ^ fnv1a(path)) >> 11u) * 0x1p-53;
}

json drawValues(const json& value, std::uint64_t seed, std::uint64_t frame, const std::string& where) {
  return Drawing(seed, frame, where).draw(value, "");
}

}  // namespace malus::render

#include "bake/scene_file/json_file.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::bake {
using nlohmann::json;

namespace {
// More than any schema needs; deeper nesting would overflow the stack of recursive functions.
constexpr int kMaxNesting = 32;
}  // namespace

json readJsonFile(const std::filesystem::path& path, std::string_view schema) {
  const std::string text = readTextFile(path, std::size_t{1} << 26);
  std::vector<std::set<std::string>> keys;  // of the objects around the current value
  const auto check = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > kMaxNesting)
      throw Error(path.string(), "is nested too deeply", fmt::format("at most {} levels", kMaxNesting));
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Error(path.string(), fmt::format("key '{}' occurs twice in one object", value.get<std::string>()),
                  "each key once");
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::out_of_range& error) {  // a number such as 1e999
    throw Error(path.string(), "contains a number that does not fit a double", schema, error.what());
  } catch (const json::parse_error& error) {
    const auto line =
        1 +
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())), '\n');
    throw Error(fmt::format("{}:{}", path.string(), line), "is not JSON", schema, error.what());
  }
}

}  // namespace malus::bake

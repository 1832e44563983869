// JSON as text, in one form everywhere.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace malus {

// Never throws for texts that are not UTF-8: such bytes become U+FFFD. ASCII only, so that a name in it cannot control
// a terminal. indent: spaces per level; -1: one line. Without a trailing newline.
inline std::string jsonText(const nlohmann::json& value, int indent = 2) {
  return value.dump(indent, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace malus

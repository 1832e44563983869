#include "render/batch/shard.h"

#include <charconv>

namespace malus::render {

namespace {

std::optional<std::uint64_t> parseWhole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<Shard> parseShard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = parseWhole(text.substr(0, slash)), count = parseWhole(text.substr(slash + 1));
  if (!number || !count || *number < 1 || *number > *count || *count > 1'000'000) return std::nullopt;
  return Shard{*number - 1, *count};
}

}  // namespace malus::render

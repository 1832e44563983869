// A part of a batch: the frames of every N-th index, so that a part is the same whatever the others do.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace malus::render {

struct Shard {
  std::uint64_t number = 0, count = 1;  // from 0
  bool contains(std::uint64_t frame) const { return frame % count == number; }
};

// "K/N" with K from 1 to N; nothing for other text.
std::optional<Shard> parseShard(std::string_view text);

}  // namespace malus::render

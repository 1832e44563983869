// A counter-based random number generator: the numbers depend on a key and a counter only, so that every pixel has its
// stream whatever thread computes it and in which order.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace malus::render {

// Philox4x32-10: J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t kMultipliers[] = {0xD2511F53u, 0xCD9E8D57u};
  constexpr std::uint32_t kWeyl[] = {0x9E3779B9u, 0xBB67AE85u};
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t a = kMultipliers[0] * counter[0], b = kMultipliers[1] * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32u) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32u) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key = {key[0] + kWeyl[0], key[1] + kWeyl[1]};
  }
  return counter;
}

// The stream of one pixel of one frame, as a generator for the distributions of <random>.
class PhiloxStream {
 public:
  using result_type = std::uint32_t;
  PhiloxStream(std::uint64_t seed, std::uint32_t frame, std::uint32_t x, std::uint32_t y)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32u)}, counter_{0, x, y, frame} {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  result_type operator()() {
    if (used_ == block_.size()) {
      block_ = philox(counter_, key_);
      ++counter_[0];
      used_ = 0;
    }
    return block_[used_++];
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;  // number of the block, x, y, frame
  std::array<std::uint32_t, 4> block_{};
  std::size_t used_ = 4;
};

}  // namespace malus::render

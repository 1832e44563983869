// Values of a frame that are drawn at random. In place of any value a job may have an object with one of the keys
//   {"uniform": [LOW, HIGH]}      a number from LOW to HIGH, or a vector if both are lists, each component by itself
//   {"logUniform": [LOW, HIGH]}   the same, uniform in the logarithm; LOW over 0
//   {"list": [VALUE, ...]}        one of the values, each as likely
//
// A value depends on the seed, the index of the frame and the path of the key ("materials.gold.roughness") only: not on
// the other keys, nor on the order in which frames are expanded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace malus::render {

// A number in [0, 1), a multiple of 2^-53: SplitMix64 (G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number
// generators, OOPSLA 2014) of the seed, the index and the FNV-1a hash of the path (G. Fowler, L. C. Noll, K.-P. Vo).
double randomNumber(std::uint64_t seed, std::uint64_t frame, std::string_view path);

// The seed of a frame, for the manifest and for random numbers of its outputs.
std::uint64_t frameSeed(std::uint64_t seed, std::uint64_t frame);

// Returns the value with a number in place of each distribution. where: "FILE:LINE", for errors. Throws Error for a
// distribution with bad bounds or further keys.
nlohmann::json drawValues(const nlohmann::json& value, std::uint64_t seed, std::uint64_t frame,
                          const std::string& where);

}  // namespace malus::render

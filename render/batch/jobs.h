// The jobs of a batch: a file of JSON Lines (.jsonl) with an object per line, or a table (.csv) with a column per key.
// render/batch/BATCH.md describes both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::render {

// A line of the file, before its values are drawn.
struct JobLine {
  nlohmann::json value;  // an object
  std::string where;     // "FILE:LINE"
};

// Throws Error: another extension, not JSON, a key twice, a row with another number of fields than the header.
std::vector<JobLine> readJobLines(const std::filesystem::path& file);

// A frame, with a number in place of each distribution.
struct FrameJob {
  std::size_t index = 0;  // in the order of the file, from 0
  std::string name;       // unique; also that of its files
  std::uint64_t seed = 0;
  nlohmann::json settings;  // without the keys name and repeat
  std::string where;
};

// The frames of all lines. A line with "repeat": N is N frames NAME-0, NAME-1, ... with as many digits as N - 1 has; a
// line without a name is called frame-INDEX, with six digits.
class Jobs {
 public:
  // Throws Error for a name that is not of letters, digits, '-' and '_', or occurs twice.
  Jobs(std::vector<JobLine> lines, std::uint64_t seed);

  std::size_t size() const { return frames_.size(); }
  const std::string& name(std::size_t frame) const { return frames_[frame].name; }
  // Throws Error as drawValues().
  FrameJob draw(std::size_t frame) const;

 private:
  struct Frame {
    std::size_t line;
    std::string name;
  };
  std::vector<JobLine> lines_;
  std::uint64_t seed_;
  std::vector<Frame> frames_;
};

}  // namespace malus::render

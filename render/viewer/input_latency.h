// Time and frames from an event of the window to the presented frame that shows it. Pure: it sees times and numbers.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace malus::viewer {

struct LatencySample {
  double ms = 0;
  std::uint32_t frames = 0;  // presented after the event; 1: the next one shows it
};

class InputLatency {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // An event was received. Of several before the next submitted() or presented(), the first counts.
  void receive(Time now);
  // The images of this generation were requested. If it is a new one, it is that of the events so far.
  void submit(std::uint64_t generation);
  // A frame with the images of a generation was presented, in which all other changes are visible.
  void present(Time now, std::uint64_t generation);

  // The newest samples: of events that needed new images, and of the others, such as the turn of a polarizer.
  const std::vector<LatencySample>& rendered() const { return rendered_; }
  const std::vector<LatencySample>& displayOnly() const { return displayOnly_; }

 private:
  static constexpr std::size_t kKept = 1000;
  struct Event {
    Time time;
    std::uint64_t frame = 0;  // number of frames that were presented before
    std::uint64_t generation = 0;
  };
  void add(std::vector<LatencySample>& to, const Event& event, Time now) const;

  std::uint64_t frames_ = 0, generation_ = 0;
  std::optional<Event> received_;
  std::vector<Event> submitted_;
  std::vector<LatencySample> rendered_, displayOnly_;
};

}  // namespace malus::viewer

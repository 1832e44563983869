#include "render/viewer/input_latency.h"

#include <algorithm>

namespace malus::viewer {

void InputLatency::receive(Time now) {
  if (!received_) received_ = Event{now, frames_};
}

void InputLatency::submit(std::uint64_t generation) {
  if (generation == generation_) return;
  generation_ = generation;
  if (!received_) return;
  received_->generation = generation;
  submitted_.push_back(*received_);
  received_.reset();
}

void InputLatency::present(Time now, std::uint64_t generation) {
  ++frames_;
  std::erase_if(submitted_, [&](const Event& event) {
    if (event.generation > generation) return false;
    add(rendered_, event, now);
    return true;
  });
  if (received_) add(displayOnly_, *received_, now);
  received_.reset();
}

void InputLatency::add(std::vector<LatencySample>& to, const Event& event, Time now) const {
  if (to.size() == kKept) to.erase(to.begin());
  to.push_back({std::chrono::duration<double, std::milli>(now - event.time).count(),
                static_cast<std::uint32_t>(frames_ - event.frame)});
}

}  // namespace malus::viewer

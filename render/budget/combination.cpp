#include "render/budget/combination.h"

#include <algorithm>

namespace malus::render {

namespace {

using Kind = MeasuredChoice::Kind;

constexpr double kLeastSaving = 0.02;
constexpr double kNoError = 1e-9;  // below it an effect is left out for any saving

// The effects that save time, those that save most for their error first, with their shares of the time.
struct Saving {
  const MeasuredChoice* choice;
  double share;
};
std::vector<Saving> savings(const Measurements& measurements, double completeMs) {
  std::vector<Saving> list;
  for (const MeasuredChoice& choice : measurements.choices)
    if (choice.kind == Kind::effect && choice.milliseconds < (1 - kLeastSaving) * completeMs)
      list.push_back({&choice, choice.milliseconds / completeMs});
  const auto worth = [](const Saving& s) { return (1 - s.share) / std::max(s.choice->error, kNoError); };
  std::sort(list.begin(), list.end(), [&](const Saving& a, const Saving& b) { return worth(a) > worth(b); });
  return list;
}

// Adds a combination, and those that leave out effects too.
void addPath(std::vector<Combination>& list, Combination start, const std::vector<Saving>& effects) {
  list.push_back(start);
  for (const Saving& effect : effects) {
    start.off.push_back(effect.choice->name);
    start.error += effect.choice->error;
    start.milliseconds *= effect.share;
    list.push_back(start);
  }
}

// Every depth of a method, and without a depth the complete one.
void addDepths(std::vector<Combination>& list, const Combination& start, const Measurements& measurements,
               double completeMs, const std::vector<Saving>& effects) {
  addPath(list, start, effects);
  for (const MeasuredChoice& depth : measurements.choices) {
    if (depth.kind != Kind::depth || depth.milliseconds >= (1 - kLeastSaving) * completeMs) continue;
    Combination shorter = start;
    shorter.depth = depth.depth;
    shorter.error += depth.error;
    shorter.milliseconds *= depth.milliseconds / completeMs;
    addPath(list, shorter, effects);
  }
}

}  // namespace

const MeasuredChoice* Measurements::find(Kind kind, const std::string& name) const {
  for (const MeasuredChoice& choice : choices)
    if (choice.kind == kind && choice.name == name) return &choice;
  return nullptr;
}

std::vector<Combination> combinations(const Measurements& measurements, const std::string& complete) {
  std::vector<Combination> list;
  const MeasuredChoice* whole = measurements.find(Kind::method, complete);
  if (whole == nullptr) return list;
  const std::vector<Saving> effects = savings(measurements, whole->milliseconds);
  for (const MeasuredChoice& choice : measurements.choices) {
    if (choice.kind != Kind::method && choice.kind != Kind::tolerance) continue;
    const Combination start{choice.name, {}, measurements.depth, choice.tolerance, choice.error, choice.milliseconds};
    addDepths(list, start, measurements, whole->milliseconds, effects);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Combination& a, const Combination& b) { return a.milliseconds < b.milliseconds; });
  return list;
}

}  // namespace malus::render

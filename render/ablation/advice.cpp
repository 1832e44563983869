#include "render/ablation/advice.h"

#include <algorithm>

#include <fmt/format.h>

namespace malus::render {

namespace {

constexpr std::size_t kFewestRounds = 6;  // of a sign test at 5 %

std::string subject(const AblationRow& row) {
  if (row.kind != VariantKind::depth) return row.name;
  return fmt::format("bounces from {} on", row.depth + 1);
}

// Two significant digits without an exponent.
std::string percentText(double share) {
  const double percent = 100 * share;
  return percent >= 10 ? fmt::format("{:.0f} %", percent) : fmt::format("{:.2g} %", percent);
}

std::string lossText(const AblationRow& row) {
  const ImageError& error = row.error;
  if (error.maxAbs == 0) return "no difference here";
  if (isInvisible(error)) return fmt::format("no visible difference here (relative RMS {:.2g})", error.relRms);
  return fmt::format("{}, {} of the pixels change by more than 1 % (relative RMS {:.2g})",
                     row.kind == VariantKind::samples ? "with these alone" : "left out",
                     percentText(error.shareOver1Percent), error.relRms);
}

std::string costText(const AblationRow& row) {
  const char* renderer = backendInfo(row.backend).name;
  if (row.samplesMs.size() < kFewestRounds)
    return fmt::format("the time needs {} rounds, has {}", kFewestRounds, row.samplesMs.size());
  const double saved = savedShare(row);
  if (saved > 0 && row.kind == VariantKind::samples)
    return fmt::format("the others cost {} of the time on {}", percentText(saved), renderer);
  if (saved > 0) return fmt::format("costs {} of the time on {}", percentText(saved), renderer);
  if (saved < 0) return fmt::format("the image takes {} more time on {} without", percentText(-saved), renderer);
  return fmt::format("costs no significant time on {}", renderer);
}

std::string leaveOutText(const AblationRow& row) {
  if (row.kind == VariantKind::samples) return "take fewer by --light-samples";
  if (row.kind == VariantKind::depth) return fmt::format("leave out by --depth {}", row.depth);
  if (row.kind == VariantKind::polarization) return fmt::format("leave out by --method {}", row.method);
  return "leave out";
}

}  // namespace

bool isInvisible(const ImageError& error) {
  return error.relRms < kInvisibleRelRms && error.shareOver1Percent < kInvisibleShare &&
         error.perceptual < kInvisibleFlip;
}

double costPerError(double savedShare, const ImageError& error) {
  constexpr double kLeast = 1e-9;
  return savedShare / std::max(error.relRms, kLeast);
}

double savedShare(const AblationRow& row) { return row.differs ? 1 - row.ratioToComplete.median : 0; }

std::string advice(const AblationRow& row) {
  if (!row.ok()) return fmt::format("{}: {}", subject(row), row.status);
  const bool saves = savedShare(row) > 0, isTimed = row.samplesMs.size() >= kFewestRounds;
  std::string action = row.kind == VariantKind::samples ? "keep the others" : "keep";
  if (isInvisible(row.error)) action = saves || !isTimed ? leaveOutText(row) : "leaving it out gains nothing";
  return fmt::format("{}: {}; {}: {}", subject(row), lossText(row), costText(row), action);
}

}  // namespace malus::render

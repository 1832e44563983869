#include "render/ablation/results.h"

#include <algorithm>
#include <utility>

#include <commit.h>
#include <fmt/format.h>

#include "render/ablation/advice.h"
#include "render/compare/machine.h"

namespace malus::render {

using nlohmann::json;

namespace {

json toJson(const Spread& spread) { return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}}; }

json toJson(const ImageError& error) {
  return {{"meanAbs", error.meanAbs},       {"maxAbs", error.maxAbs},
          {"relRms", error.relRms},         {"shareOver1Percent", error.shareOver1Percent},
          {"perceptual", error.perceptual}, {"energyRatio", error.energyRatio}};
}

json toJson(const AblationRow& row) {
  json result = {{"scene", row.scene},
                 {"renderer", backendInfo(row.backend).name},
                 {"kind", variantKindName(row.kind)},
                 {"name", row.name},
                 {"method", row.method},
                 {"width", row.width},
                 {"height", row.height},
                 {"depth", row.depth},
                 {"status", row.status},
                 {"image", row.ok() ? json(fmt::format("images/{}", row.image)) : json()},
                 {"error", row.ok() ? toJson(row.error) : json()},
                 {"invisible", row.ok() && isInvisible(row.error)},
                 {"rays", row.rays},
                 {"savedRays", row.savedRays},
                 {"savedBytes", row.savedBytes},
                 {"samplesMs", row.samplesMs},
                 {"medianMs", row.samplesMs.empty() ? json() : json(row.time.median)},
                 {"ratioToComplete", row.samplesMs.empty() ? json() : toJson(row.ratioToComplete)},
                 {"differs", row.differs}};
  if (row.kind != VariantKind::complete) {
    result["costPerError"] = row.ok() ? json(costPerError(savedShare(row), row.error)) : json();
    result["advice"] = advice(row);
  }
  return result;
}

std::string rowText(const AblationRow& row) {
  const std::string name = row.kind == VariantKind::depth ? fmt::format("bounces from {} on", row.depth + 1) : row.name;
  if (!row.ok()) return fmt::format("  {:<24}failed: {}\n", name, row.status);
  const std::string time =
      row.samplesMs.empty() ? std::string("not timed")
                            : fmt::format("{:.3f} ({:.3f}-{:.3f}){}", row.ratioToComplete.median,
                                          row.ratioToComplete.low, row.ratioToComplete.high, row.differs ? "" : " ~");
  return fmt::format("  {:<24}{:>10.2e}{:>9.2f}%{:>9.4f}{:>11.2e}{:>9.4f}  {:<24}{:>12}{:>7}\n", name, row.error.relRms,
                     100 * row.error.shareOver1Percent, row.error.perceptual, row.error.maxAbs, row.error.energyRatio,
                     time, row.savedRays, row.savedBytes);
}

// The steps of the bounces, from the first.
std::string bouncesText(const Ablation& ablation, const AblationRow& complete) {
  std::string text;
  for (auto step = ablation.bounces.rbegin(); step != ablation.bounces.rend(); ++step) {
    const AblationRow &shorter = ablation.rows[step->shorter], &deeper = ablation.rows[step->deeper];
    if (shorter.scene != complete.scene || shorter.backend != complete.backend) continue;
    if (text.empty())
      text = fmt::format("\n  {:<24}{:>10}  {}\n", "bounce", "adds RMS", "time over that of the one before");
    const std::string name = shorter.depth + 1 == deeper.depth
                                 ? fmt::format("{}", deeper.depth)
                                 : fmt::format("{} to {}", shorter.depth + 1, deeper.depth);
    const std::string time = shorter.samplesMs.empty()
                                 ? std::string("not timed")
                                 : fmt::format("{:.3f} ({:.3f}-{:.3f}){}", step->timeRatio.median, step->timeRatio.low,
                                               step->timeRatio.high, step->differs ? "" : " ~");
    text += fmt::format("  {:<24}{:>10.2e}  {}\n", name, step->relRms, time);
  }
  return text;
}

std::string groupText(const Ablation& ablation, const AblationRow& complete) {
  std::string text = fmt::format("\n{}, {} x {}, depth {}, {} ({}): complete by {}", complete.scene, complete.width,
                                 complete.height, complete.depth, backendInfo(complete.backend).name,
                                 ablation.devices.contains(backendInfo(complete.backend).name)
                                     ? ablation.devices.at(backendInfo(complete.backend).name)
                                     : "not available",
                                 complete.method);
  if (!complete.ok()) return text + fmt::format(" failed: {}\n", complete.status);
  if (!complete.samplesMs.empty()) text += fmt::format(", {:.1f} ms", complete.time.median);
  text += fmt::format(", {} rays\n  {:<24}{:>10}{:>10}{:>9}{:>11}{:>9}  {:<24}{:>12}{:>7}\n", complete.rays, "without",
                      "rel RMS", "err >1%", "FLIP", "max", "energy", "time over complete", "saved rays", "bytes");
  const std::vector<std::size_t> rows = sortedRows(ablation, complete);
  for (const std::size_t i : rows) text += rowText(ablation.rows[i]);
  text += "\n";
  for (const std::size_t i : rows) text += fmt::format("  {}\n", advice(ablation.rows[i]));
  return text + bouncesText(ablation, complete);
}

}  // namespace

std::vector<std::size_t> sortedRows(const Ablation& ablation, const AblationRow& complete) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < ablation.rows.size(); ++i) {
    const AblationRow& row = ablation.rows[i];
    if (row.kind != VariantKind::complete && row.scene == complete.scene && row.backend == complete.backend)
      rows.push_back(i);
  }
  const auto worth = [&](std::size_t i) {
    const AblationRow& row = ablation.rows[i];
    return std::pair(costPerError(savedShare(row), row.error), -row.error.relRms);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return worth(a) > worth(b); });
  return rows;
}

json toJson(const Ablation& ablation, const AblationSettings& settings) {
  json scenes = json::object(), rows = json::array(), bounces = json::array(), backends = json::array();
  for (const Backend b : settings.backends) backends.push_back(backendInfo(b).name);
  for (const auto& [name, pack] : ablation.packs)
    scenes[name] = {{"title", pack.scene.title},
                    {"packHash", fmt::format("{:016x}", pack.hash)},
                    {"exposureEv", pack.scene.exposureEv}};
  for (const AblationRow& row : ablation.rows) rows.push_back(toJson(row));
  for (const BounceStep& step : ablation.bounces) {
    const AblationRow &shorter = ablation.rows[step.shorter], &deeper = ablation.rows[step.deeper];
    bounces.push_back({{"scene", shorter.scene},
                       {"renderer", backendInfo(shorter.backend).name},
                       {"fromDepth", shorter.depth},
                       {"toDepth", deeper.depth},
                       {"relRms", step.relRms},
                       {"timeRatio", shorter.samplesMs.empty() ? json() : toJson(step.timeRatio)},
                       {"differs", step.differs}});
  }
  return {{"malus", MALUS_VERSION},
          {"commit", MALUS_COMMIT},
          {"date", ablation.date},
          {"machine", machineJson()},
          {"devices", ablation.devices},
          {"settings",
           {{"rounds", ablation.rounds},
            {"roundsAsked", settings.rounds},
            {"minutes", settings.minutes},
            {"leftOut", ablation.leftOut},
            {"interrupted", ablation.interrupted},
            {"timeIsOver", ablation.timeIsOver},
            {"backends", backends},
            {"threads", settings.image.threads}}},
          {"scenes", scenes},
          {"ablation", rows},
          {"bounces", bounces}};
}

std::string toTable(const Ablation& ablation) {
  std::string text;
  for (const AblationRow& row : ablation.rows)
    if (row.kind == VariantKind::complete) text += groupText(ablation, row);
  return text.empty() ? text : text + "\n~: no significant difference in time\n";
}

}  // namespace malus::render

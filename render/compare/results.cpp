#include "render/compare/results.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include <commit.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/pack/instances.h"
#include "render/compare/machine.h"
#include "render/scene/methods.h"

namespace malus::render {
using nlohmann::json;

namespace {

// JSON has no infinity.
json number(double value) { return std::isfinite(value) ? json(value) : json(); }

double median(const std::vector<double>& values) { return values.empty() ? 0 : computeSpread(values).median; }

// Image that the error of the method relates to.
std::string errorAgainst(const ComparisonRow& row) {
  return row.precision ? completeRecursiveMethod().name : backendInfo(Backend::reference).name;
}

json toJson(const ImageError& error) {
  return {{"meanAbs", number(error.meanAbs)}, {"maxAbs", number(error.maxAbs)},
          {"relRms", number(error.relRms)},   {"shareOver1Percent", error.shareOver1Percent},
          {"perceptual", error.perceptual},   {"energyRatio", number(error.energyRatio)}};
}

json toJson(const ComparisonRow& row) {
  json result = {{"scene", row.scene},           {"renderer", backendInfo(row.backend).name},
                 {"method", row.method},         {"effects", row.everyEffect ? "all" : "auto"},
                 {"width", row.width},           {"height", row.height},
                 {"depth", row.depth},           {"payloadBytes", row.payloadBytes},
                 {"stateBytes", row.stateBytes}, {"status", row.status}};
  const bool rendered = row.ok(), timed = rendered && !row.samplesMs.empty();
  const auto when = [](bool known, json value) { return known ? std::move(value) : json(); };
  const auto orNull = [](bool known, std::string text) { return known ? json(std::move(text)) : json(); };
  result["vulkanPath"] = orNull(row.vulkanPath != VulkanPath::automatic, vulkanPathName(row.vulkanPath));
  result["embreePath"] = orNull(row.embreePath != EmbreePath::automatic, embreePathName(row.embreePath));
  result["withoutRecursion"] = orNull(!row.withoutRecursion.empty(), row.withoutRecursion);
  result["rays"] = when(rendered, row.rays);
  result["samplesMs"] = row.samplesMs;
  result["medianMs"] = when(timed, row.time.median);
  result["quartilesMs"] = when(timed, {row.time.low, row.time.high});
  result["wallMs"] = when(timed, median(row.wallMs));
  result["cpuMs"] = when(timed, median(row.cpuMs));
  result["readBackMs"] = when(timed, median(row.readBackMs));
  result["buildMs"] = when(rendered, row.buildMs);
  result["uploadMs"] = when(rendered, row.uploadMs);
  result["compileMs"] = when(rendered, row.compileMs);
  result["raysPerSecond"] = when(timed, timed ? static_cast<double>(row.rays) / row.time.median * 1e3 : 0);
  result["ratioToSchlick"] =
      when(timed && row.ratioToSchlick.median > 0,
           {{"median", row.ratioToSchlick.median}, {"low", row.ratioToSchlick.low}, {"high", row.ratioToSchlick.high}});
  result["noSignificantDifference"] = row.noSignificantDifference;
  result["error"] = when(rendered, toJson(row.error));
  result["errorAgainst"] = orNull(rendered, errorAgainst(row));
  result["precision"] = row.precision && rendered ? toJson(*row.precision) : json();
  result["errorToReference"] = when(rendered, toJson(row.errorToReference));
  result["image"] = when(rendered && !row.image.empty(), fmt::format("images/{}", row.image));
  return result;
}

// A row of a choice of --max-error.
json choiceJson(const ComparisonRow& row) {
  json result = toJson(row);
  result["maxErrors"] = row.choice->maxErrors;
  result["parts"] = row.choice->parts;
  result["tracedDepth"] = row.choice->parameters.depth;
  result["tolerance"] = row.choice->parameters.tolerance;
  result["displayRelRms"] = row.ok() ? number(row.choice->displayError) : json();
  return result;
}

json spreadJson(const Spread& s) {
  return s.median > 0 ? json{{"median", s.median}, {"low", s.low}, {"high", s.high}} : json();
}

// One row of the table of effects. Repeats the rows that it consists of, so that it can be read alone.
json toJson(const EffectsComparison& e, const Comparison& comparison) {
  const auto rowJson = [&](std::size_t i) {
    if (i == EffectsComparison::kNoRow) return json();
    const ComparisonRow& r = comparison.rows[i];
    return json{{"method", r.method},
                {"medianMs", r.samplesMs.empty() ? json() : json(r.time.median)},
                {"rays", r.rays},
                {"payloadBytes", r.payloadBytes},
                {"stateBytes", r.stateBytes}};
  };
  const ComparisonRow& all = comparison.rows[e.all];
  json automatic = rowJson(e.automatic), importance = rowJson(e.importance);
  if (!automatic.is_null()) {
    automatic["ratioToAll"] = spreadJson(e.automaticToAll);
    automatic["largestDifference"] = number(e.automaticDifference);
    automatic["why"] = e.why;
  }
  if (!importance.is_null()) {
    importance["ratioToAll"] = spreadJson(e.importanceToAll);
    importance["largestDifference"] = number(e.importanceDifference);
  }
  return {{"scene", all.scene},      {"renderer", backendInfo(all.backend).name},
          {"width", all.width},      {"height", all.height},
          {"depth", all.depth},      {"all", rowJson(e.all)},
          {"auto", automatic},       {"importance", importance},
          {"brightest", e.brightest}};
}

// A method by both paths. Repeats both rows, so that it can be read alone.
json toJson(const PathComparison& e, const Comparison& comparison) {
  const auto rowJson = [&](const ComparisonRow& r) {
    return json{{"medianMs", r.samplesMs.empty() ? json() : json(r.time.median)},
                {"ratioToSchlick", spreadJson(r.ratioToSchlick)},
                {"payloadBytes", r.payloadBytes},
                {"stateBytes", r.stateBytes}};
  };
  const ComparisonRow &first = comparison.rows[e.first], &second = comparison.rows[e.second];
  return {{"scene", first.scene},
          {"renderer", backendInfo(first.backend).name},
          {"width", first.width},
          {"height", first.height},
          {"depth", first.depth},
          {"method", first.method},
          {pathName(first), rowJson(first)},
          {pathName(second), rowJson(second)},
          {first.backend == Backend::embree ? "scalarToPacket" : "pipelineToQuery", spreadJson(e.secondToFirst)},
          {"differs", e.differs},
          {"largestDifference", number(e.largestDifference)}};
}

// "-" if a row was not timed.
std::string ratioText(const Spread& s) {
  return s.median > 0 ? fmt::format("{:.3f} ({:.3f}-{:.3f})", s.median, s.low, s.high) : "-";
}

// The rows of a group that ran without recursion: "sp stokes: reason"; empty if there is none.
std::string withoutRecursionLine(const std::vector<const ComparisonRow*>& rows) {
  std::string names, reason;
  for (const ComparisonRow* r : rows) {
    if (r->withoutRecursion.empty()) continue;
    names += " " + r->method;
    reason = r->withoutRecursion;
  }
  return names.empty() ? names : fmt::format("  without recursion:{} ({})\n", names, reason);
}

// The error of the precision, which the rows of one renderer and view share.
std::string precisionLine(const ComparisonRow& r) {
  if (!r.precision) return {};
  return fmt::format(
      "  error of the precision ({} against the reference): relative RMS {:.2g}, {:.2f}% of pixels > 1%\n",
      completeRecursiveMethod().name, r.precision->relRms, 100 * r.precision->shareOver1Percent);
}

// Title and column heads of the rows of one renderer and view. Errors of the rows are those of the method.
std::string groupHeading(const ComparisonRow& r, const Comparison& comparison) {
  const std::string renderer = backendInfo(r.backend).name;
  return fmt::format("\n{}, {} x {}, depth {}, {} ({})\n  {:<18}{:>6}{:>13}{:>10}  {:<22}{:>9}{:>10}{:>9}{:>9}  {}\n",
                     r.scene, r.width, r.height, r.depth, renderer,
                     comparison.devices.count(renderer) ? comparison.devices.at(renderer) : "no device", "method",
                     "bytes", "rays", "ms", "ratio to schlick", "Mray/s", "rel RMS", "err >1%", "energy",
                     "no significant difference");
}

std::string rowText(const ComparisonRow& r) {
  if (!r.ok()) return fmt::format("  {:<18}{:>6}  failed: {}\n", r.method, r.payloadBytes, r.status);
  const bool timed = !r.samplesMs.empty();
  return fmt::format("  {:<18}{:>6}{:>13}{:>10}  {:<22}{:>9}{:>10.4f}{:>8.2f}%{:>9.4f}  {}\n", r.method, r.payloadBytes,
                     r.rays, timed ? fmt::format("{:.1f}", r.time.median) : "-", ratioText(r.ratioToSchlick),
                     timed ? fmt::format("{:.1f}", static_cast<double>(r.rays) / r.time.median * 1e-3) : "-",
                     r.error.relRms, 100 * r.error.shareOver1Percent, r.error.energyRatio,
                     fmt::join(r.noSignificantDifference, " "));
}

// Lines behind the rows of a group.
std::string groupEnd(const std::vector<const ComparisonRow*>& rows) {
  const auto known = std::find_if(rows.begin(), rows.end(), [](const auto* r) { return r->precision.has_value(); });
  return withoutRecursionLine(rows) + (known == rows.end() ? std::string() : precisionLine(**known));
}

std::string effectsTable(const Comparison& comparison) {
  if (comparison.effects.empty()) return {};
  std::string text = fmt::format(
      "\nexact intensity by stokes with all effects, with the effects that the image needs, and by importance\n"
      "  {:<34}{:>10}  {:<42}{}\n",
      "", "all, ms", "auto: time over all, largest difference", "importance: time over all, largest difference");
  for (const EffectsComparison& e : comparison.effects) {
    const ComparisonRow& all = comparison.rows[e.all];
    const auto cell = [&](std::size_t i, const Spread& ratio, double difference) {
      if (i == EffectsComparison::kNoRow) return std::string("-");
      return fmt::format("{} {:.3f} ({:.3f}-{:.3f}) {:.1e}", comparison.rows[i].method, ratio.median, ratio.low,
                         ratio.high, difference);
    };
    text += fmt::format("  {:<34}{:>10.1f}  {:<42}{}\n",
                        fmt::format("{} {} x {}, {}", all.scene, all.width, all.height, backendInfo(all.backend).name),
                        all.time.median, cell(e.automatic, e.automaticToAll, e.automaticDifference),
                        cell(e.importance, e.importanceToAll, e.importanceDifference));
  }
  return text;
}

// "0.1 %, 1 %"
std::string errorList(const std::vector<double>& errors) {
  std::vector<std::string> texts;
  for (const double e : errors) texts.push_back(fmt::format("{:g} %", 100 * e));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string choicesTable(const Comparison& comparison) {
  std::string text;
  for (const ComparisonRow& r : comparison.rows) {
    if (!r.choice) continue;
    if (text.empty())
      text = fmt::format(
          "\nchosen by --max-error: relative RMS error of the displayed image against the exact one\n"
          "  {:<34}{:<16}{:>10}{:>10}  {:<22}{}\n",
          "", "error at most", "rel RMS", "ms", "ratio to schlick", "choice");
    text += fmt::format("  {:<34}{:<16}{:>10.2g}{:>10}  {:<22}{}\n",
                        fmt::format("{} {} x {}, {}", r.scene, r.width, r.height, backendInfo(r.backend).name),
                        errorList(r.choice->maxErrors), r.choice->displayError,
                        r.samplesMs.empty() ? "-" : fmt::format("{:.1f}", r.time.median), ratioText(r.ratioToSchlick),
                        r.choice->parts.empty() ? "the exact method with every effect"
                                                : fmt::format("{}", fmt::join(r.choice->parts, ", ")));
  }
  return text;
}

std::string pathsTable(const Comparison& comparison, Backend backend, const std::string& title) {
  std::string text;
  for (const PathComparison& e : comparison.paths) {
    const ComparisonRow &first = comparison.rows[e.first], &second = comparison.rows[e.second];
    if (first.backend != backend) continue;
    if (text.empty())
      text = fmt::format("\n{}\n  {:<34}{:<18}{:>10}{:>14}  {:<26}{:<26}{:<26}{}\n", title, "", "method",
                         fmt::format("{}, ms", pathName(first)), fmt::format("{}, ms", pathName(second)),
                         fmt::format("{} / {}", pathName(second), pathName(first)),
                         fmt::format("{} to schlick", pathName(first)), fmt::format("{} to schlick", pathName(second)),
                         "largest difference");
    text += fmt::format("  {:<34}{:<18}{:>10.1f}{:>14.1f}  {:<26}{:<26}{:<26}{:.1e}\n",
                        fmt::format("{} {} x {}", first.scene, first.width, first.height), first.method,
                        first.time.median, second.time.median, ratioText(e.secondToFirst),
                        ratioText(first.ratioToSchlick), ratioText(second.ratioToSchlick), e.largestDifference);
  }
  return text;
}

std::string pathsTables(const Comparison& comparison) {
  return pathsTable(
             comparison, Backend::vulkan,
             fmt::format("iterative methods by ray queries and by pipelines whose rays return a hit record of {} "
                         "bytes",
                         kHitRecordBytes)) +
         pathsTable(comparison, Backend::embree, "methods by packets of rays and by single rays");
}

}  // namespace

json toJson(const Comparison& comparison, const ComparisonSettings& settings) {
  json backends = json::array();
  for (const Backend b : settings.backends) backends.push_back(backendInfo(b).name);
  json scenes = json::object(), references = json::array(), rows = json::array(), everything = json::array(),
       secondPath = json::array(), choices = json::array(), effects = json::array(), paths = json::array(),
       exposure = json::object();
  for (const auto& [name, pack] : comparison.packs) {
    const pack::InstanceCounts instances = pack::countInstances(pack.scene);
    scenes[name] = {{"title", pack.scene.title},
                    {"vertices", pack.scene.vertexCount()},
                    {"triangles", pack.scene.triangleCount()},
                    {"placedTriangles", instances.placedTriangles},
                    {"instances", instances.placements},
                    {"packHash", fmt::format("{:016x}", pack.hash)},
                    {"exposureEv", pack.scene.exposureEv}};
    exposure[name] = pack.scene.exposureEv;
  }
  for (const ComparisonReference& r : comparison.references)
    references.push_back({{"scene", r.scene},
                          {"width", r.width},
                          {"height", r.height},
                          {"depth", r.depth},
                          {"image", fmt::format("images/{}", r.image)}});
  for (const ComparisonRow& row : comparison.rows)
    if (row.choice)
      choices.push_back(choiceJson(row));
    else
      (row.everyEffect ? everything : row.isSecondPath ? secondPath : rows).push_back(toJson(row));
  for (const EffectsComparison& e : comparison.effects) effects.push_back(toJson(e, comparison));
  for (const PathComparison& e : comparison.paths) paths.push_back(toJson(e, comparison));
  return {{"malus", MALUS_VERSION},
          {"commit", MALUS_COMMIT},
          {"compiler", fmt::format("{} {}", MALUS_COMPILER, __VERSION__)},
          {"date", comparison.date},
          {"machine", machineJson()},
          {"devices", comparison.devices},
          {"deviceInfo", comparison.deviceInfo},
          {"settings",
           {{"rounds", comparison.rounds},
            {"roundsAsked", settings.rounds},
            {"interrupted", comparison.interrupted},
            {"minutes", settings.minutes},
            {"timeIsOver", comparison.timeIsOver},
            {"widths", settings.widths},
            {"heights", settings.heights},
            {"scale", settings.scale},
            {"depths", settings.depths},
            {"methods", settings.methods},
            {"backends", backends},
            {"threads", settings.threads},
            {"vulkanPath", vulkanPathName(settings.vulkanPath)},
            {"embreePath", embreePathName(settings.embreePath)},
            {"effects", "auto"},
            {"exposureEv", exposure},
            {"polarizerDegrees", settings.polarizerDegrees ? json(*settings.polarizerDegrees) : json()}}},
          {"scenes", scenes},
          {"references", references},
          {"rows", rows},
          {"rowsWithAllEffects", everything},
          {"rowsOnSecondPath", secondPath},
          {"rowsWithinError", choices},
          {"effects", effects},
          {"paths", paths},
          {"gpuModel", comparison.gpuModel}};
}

namespace {

// Letters, digits and '-', as the names of scenes that malus baked.
bool isPlain(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; });
}

// A field of CSV (RFC 4180): quotes are doubled.
std::string csvText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted.push_back('"');
    quoted.push_back(c);
  }
  return quoted + '"';
}

// The column `effects`: a choice of --max-error lists what it leaves out.
std::string effectsText(const ComparisonRow& row) {
  if (row.choice) return csvText(fmt::format("{}", fmt::join(row.choice->parts, ", ")));
  return row.everyEffect ? "all" : "auto";
}

}  // namespace

std::string toCsv(const Comparison& comparison) {
  std::string text =
      "scene,renderer,method,effects,width,height,depth,payloadBytes,stateBytes,rays,medianMs,lowMs,highMs,wallMs,"
      "cpuMs,buildMs,uploadMs,"
      "compileMs,readBackMs,ratioToSchlick,ratioLow,ratioHigh,meanAbs,maxAbs,relRms,shareOver1Percent,perceptual,"
      "energyRatio,precisionRelRms,precisionShareOver1Percent,referenceRelRms,referenceShareOver1Percent,vulkanPath,"
      "embreePath,status\n";
  for (const ComparisonRow& r : comparison.rows) {
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
        isPlain(r.scene) ? r.scene : csvText(r.scene), backendInfo(r.backend).name, r.method, effectsText(r), r.width,
        r.height, r.depth, r.payloadBytes, r.stateBytes, r.rays, r.time.median, r.time.low, r.time.high,
        median(r.wallMs), median(r.cpuMs), r.buildMs, r.uploadMs, r.compileMs, median(r.readBackMs),
        r.ratioToSchlick.median, r.ratioToSchlick.low, r.ratioToSchlick.high, r.error.meanAbs, r.error.maxAbs,
        r.error.relRms, r.error.shareOver1Percent, r.error.perceptual, r.error.energyRatio,
        r.precision ? fmt::format("{}", r.precision->relRms) : "",
        r.precision ? fmt::format("{}", r.precision->shareOver1Percent) : "", r.errorToReference.relRms,
        r.errorToReference.shareOver1Percent, r.vulkanPath == VulkanPath::automatic ? "" : vulkanPathName(r.vulkanPath),
        r.embreePath == EmbreePath::automatic ? "" : embreePathName(r.embreePath), csvText(r.status));
  }
  return text;
}

std::string toTable(const Comparison& comparison) {
  std::string text, heading;
  std::vector<const ComparisonRow*> group;
  for (const ComparisonRow& r : comparison.rows) {
    if (!r.isMain()) continue;
    if (const std::string title = groupHeading(r, comparison); title != heading) {
      text += groupEnd(group) + title;
      heading = title;
      group.clear();
    }
    group.push_back(&r);
    text += rowText(r);
  }
  return text + groupEnd(group) + choicesTable(comparison) + effectsTable(comparison) + pathsTables(comparison);
}

}  // namespace malus::render

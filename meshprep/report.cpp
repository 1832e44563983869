#include "meshprep/report.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/text.h"
#include "meshprep/read/polygons.h"

namespace malus::prep {

namespace {

double bytesPerTriangle(const Report& report) {
  return static_cast<double>(report.compression.bytes) /
         static_cast<double>(std::max<std::uint64_t>(report.output.triangles, 1));
}

}  // namespace

std::uint64_t Report::count(std::string_view step) const {
  const auto found = std::find_if(steps.begin(), steps.end(), [&](const Step& s) { return s.name == step; });
  return found == steps.end() ? 0 : found->count;
}

namespace {

nlohmann::json findingJson(const Finding& finding) {
  nlohmann::json json{{"at", {finding.at.x, finding.at.y, finding.at.z}}};
  if (!finding.vertices.empty()) json["vertices"] = finding.vertices;
  if (!finding.faces.empty()) json["faces"] = finding.faces;
  if (!finding.what.empty()) json["what"] = finding.what;
  if (!finding.sourceLocation.empty()) json["sourceLocation"] = finding.sourceLocation;
  return json;
}

}  // namespace

nlohmann::json toJson(const Report& report) {
  nlohmann::json json;
  json["source"] = report.source;
  json["notes"] = report.notes;
  json["input"] = {{"vertices", report.input.vertices}, {"faces", report.input.faces}};
  json["output"] = {{"vertices", report.output.vertices}, {"triangles", report.output.triangles}};
  json["steps"] = nlohmann::json::array();
  for (const Step& step : report.steps) {
    nlohmann::json entry{{"name", step.name}, {"count", step.count}};
    for (const Finding& finding : step.findings) entry["findings"].push_back(findingJson(finding));
    json["steps"].push_back(std::move(entry));
  }
  json["components"] = nlohmann::json::array();
  for (const Component& c : report.components)
    json["components"].push_back({{"triangles", c.triangles},
                                  {"closed", c.closed},
                                  {"orientable", c.orientable},
                                  {"flipped", c.flipped},
                                  {"signedVolume", c.signedVolume},
                                  {"hasVolume", c.hasVolume},
                                  {"at", {c.at.x, c.at.y, c.at.z}},
                                  {"firstFace", c.firstFace}});
  if (report.simplification.applied) {
    const Simplification& s = report.simplification;
    json["simplification"] = {{"trianglesBefore", s.trianglesBefore},
                              {"trianglesAfter", s.trianglesAfter},
                              {"maxDeviation", s.maxDeviation},
                              {"maxNormalDegrees", s.maxNormalDegrees},
                              {"warnings", s.warnings}};
  }
  if (report.certificate.checked) {
    json["certificate"] = {{"granted", report.certificate.isGranted()}, {"problems", nlohmann::json::array()}};
    for (const Problem& p : report.certificate.problems)
      json["certificate"]["problems"].push_back(
          {{"component", p.component}, {"what", p.what}, {"where", p.where}, {"repair", p.repair}});
  }
  if (report.compression.bytes > 0) {
    json["errors"] = {{"positionMax", report.errors.positionMax},
                      {"normalMaxDegrees", report.errors.normalMaxDegrees},
                      {"tiltMaxDegrees", report.errors.tiltMaxDegrees},
                      {"tilted", report.errors.tilted},
                      {"tiltedArea", report.errors.tiltedArea},
                      {"flipped", report.errors.flipped},
                      {"degenerate", report.errors.degenerate},
                      {"uvMaxTexels", report.errors.uvMaxTexels},
                      {"tangentMaxDegrees", report.errors.tangentMaxDegrees}};
    json["compression"] = {
        {"method", report.compression.method},
        {"sequentialReason", report.compression.sequentialReason},
        {"bytes", report.compression.bytes},
        {"bytesPerTriangle", bytesPerTriangle(report)},
        {"positionBits", report.compression.positionBits},
        {"origin", {report.compression.origin.x, report.compression.origin.y, report.compression.origin.z}},
        {"step", report.compression.step},
        {"normalBits", report.compression.normalBits},
        {"encodeMs", report.compression.encodeMs},
        {"decodeMs", report.compression.decodeMs},
        {"warnings", report.compression.warnings}};
  }
  return json;
}

std::string toText(const Report& report) {
  // Print the counts before and after.
  std::string text = fmt::format("{}\n", printable(report.source));
  text += fmt::format("  {:<34}{:>12}{:>12}\n", "", "before", "after");
  text += fmt::format("  {:<34}{:>12}{:>12}\n", "vertices", report.input.vertices, report.output.vertices);
  text += fmt::format("  {:<34}{:>12}{:>12}\n", "faces, triangles", report.input.faces, report.output.triangles);

  // Print steps with findings.
  for (const Step& step : report.steps)
    if (step.count > 0)
      text += fmt::format("  {:<34}{:>12}{}\n", step.name, step.count,
                          step.findings.empty() ? ""
                                                : fmt::format("  {}{}", step.count > 1 ? "first: " : "",
                                                              describe(step.findings.front())));
  for (const std::string& note : report.notes)
    text += fmt::format("  {}{}\n", note.starts_with(kAcceptedNote) ? "" : "ignored: ", printable(note));

  // Print the numbers of components.
  const auto count = [&](auto which) {
    return std::count_if(report.components.begin(), report.components.end(), which);
  };
  text += fmt::format("  {:<34}{:>12}\n", "components", report.components.size());
  text += fmt::format("  {:<34}{:>12}\n", "  closed", count([](const Component& c) { return c.closed; }));
  text += fmt::format("  {:<34}{:>12}\n", "  with flipped triangles",
                      count([](const Component& c) { return c.flipped > 0; }));

  // Print simplification.
  if (report.simplification.applied) {
    const Simplification& s = report.simplification;
    text += fmt::format("  {:<34}{:>12}{:>12}\n", "triangles simplified", s.trianglesBefore, s.trianglesAfter);
    text += fmt::format("  {:<34}{:>12.3g} m\n", "  deviation, at most", s.maxDeviation);
    text += fmt::format("  {:<34}{:>12.3g} degrees\n", "  normal deviation, at most", s.maxNormalDegrees);
    for (const std::string& warning : s.warnings) text += fmt::format("  warning: {}\n", warning);
  }

  // Print the certificate.
  if (report.certificate.checked) {
    text += fmt::format("  {:<34}{:>12}\n", "certificate", report.certificate.isGranted() ? "granted" : "refused");
    for (const Problem& p : report.certificate.problems)
      text += fmt::format("    component {}: {}; {}; {}\n", p.component, p.what, p.where, p.repair);
  }

  // Print compression.
  if (report.compression.bytes > 0) {
    const auto& c = report.compression;
    text += fmt::format("  {:<34}{:>12} bytes, {:.2f} per triangle\n", "compressed", c.bytes, bytesPerTriangle(report));
    text += fmt::format("  {:<34}{:>12}{}{}\n", "  method", c.method, c.sequentialReason.empty() ? "" : ": ",
                        c.sequentialReason);
    text += fmt::format("  {:<34}{:>12} positions, {} normals\n", "  bits", c.positionBits, c.normalBits);
    text += fmt::format("  {:<34}{:>12.1f} ms to encode, {:.1f} ms to decode\n", "  time", c.encodeMs, c.decodeMs);
    text += fmt::format("  {:<34}{:>12.3g} m\n", "position error, at most", report.errors.positionMax);
    text += fmt::format("  {:<34}{:>12.3g} degrees\n", "normal error, at most", report.errors.normalMaxDegrees);
    if (report.errors.uvMaxTexels > 0)
      text += fmt::format("  {:<34}{:>12.3g} texels\n", "texture coordinates, at most", report.errors.uvMaxTexels);
    text += fmt::format("  {:<34}{:>12.3g} degrees\n", "tilt of a face, at most", report.errors.tiltMaxDegrees);
    for (const std::string& warning : c.warnings) text += fmt::format("  warning: {}\n", warning);
  }
  return text;
}

}  // namespace malus::prep

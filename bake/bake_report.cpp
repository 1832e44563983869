#include "bake/bake_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "bake/pack/instances.h"
#include "meshprep/base/text.h"

namespace malus::bake {
using nlohmann::json;

namespace {

double perTriangle(std::size_t bytes, std::uint64_t triangles) {
  return static_cast<double>(bytes) / static_cast<double>(std::max<std::uint64_t>(triangles, 1));
}

// Over all meshes.
struct Totals {
  std::size_t geometryBytes = 0, reencoded = 0;
  compress::Deviation worst;
};

Totals addUp(const pack::Written& written) {
  Totals totals;
  for (const pack::MeshCompression& m : written.meshes) {
    totals.geometryBytes += m.sizeBytes;
    totals.reencoded += m.reused ? 0 : 1;
    totals.worst.positionMax = std::max(totals.worst.positionMax, m.deviation.positionMax);
    totals.worst.normalMaxDegrees = std::max(totals.worst.normalMaxDegrees, m.deviation.normalMaxDegrees);
    totals.worst.tiltMaxDegrees = std::max(totals.worst.tiltMaxDegrees, m.deviation.tiltMaxDegrees);
  }
  return totals;
}

json lightBeyondJson(const Baked& baked) {
  if (!baked.probe) return nullptr;
  return {{"share", shareBeyond(baked.scene.lightBeyond, baked.scene.depth)},
          {"rays", baked.probe->rays},
          {"unfollowedPaths", baked.probe->unfollowed},
          {"milliseconds", baked.probe->milliseconds}};
}

}  // namespace

json bakeJson(const Baked& baked, const pack::Written& written, const std::string& output) {
  const Totals totals = addUp(written);
  json meshes = json::array();
  for (std::size_t i = 0; i < written.meshes.size(); ++i) {
    const pack::MeshCompression& m = written.meshes[i];
    const pack::Mesh& mesh = baked.scene.meshes[i];
    meshes.push_back({{"name", mesh.name},
                      {"encoding", m.method},
                      {"sequentialReason", m.sequentialReason},
                      {"triangles", mesh.triangles.size()},
                      {"sizeBytes", m.sizeBytes},
                      {"bytesPerTriangle", perTriangle(m.sizeBytes, mesh.triangles.size())},
                      {"positionBits", m.positionBits},
                      {"normalBits", m.normalBits},
                      {"reused", m.reused},
                      {"encodeMs", m.encodeMs},
                      {"decodeMs", m.decodeMs},
                      {"errors",
                       {{"positionMax", m.deviation.positionMax},
                        {"normalMaxDegrees", m.deviation.normalMaxDegrees},
                        {"tiltMaxDegrees", m.deviation.tiltMaxDegrees},
                        {"uvMaxTexels", m.texture.deviation.uvTexels},
                        {"tangentMaxDegrees", m.texture.deviation.tangentDegrees},
                        {"tilted", m.deviation.tilted},
                        {"tiltedArea", m.deviation.tiltedArea},
                        {"flipped", m.deviation.flipped},
                        {"degenerate", m.deviation.newDegenerate}}}});
  }
  const pack::InstanceCounts counts = pack::countInstances(baked.scene);
  json preparation = json::array();
  for (const prep::Report& report : baked.reports) preparation.push_back(prep::toJson(report));
  return {{"name", baked.scene.name},
          {"output", output},
          {"upToDate", false},
          {"sizeBytes", written.bytes.size()},
          {"vertices", baked.scene.vertexCount()},
          {"triangles", baked.scene.triangleCount()},
          {"placedTriangles", counts.placedTriangles},
          {"instances", counts.placements},
          {"bytesPerTriangle", perTriangle(totals.geometryBytes, baked.scene.triangleCount())},
          {"positionBits", written.positionBits},
          {"reencoded", totals.reencoded},
          {"fullRebakeReason", written.fullRebakeReason},
          {"meshes", meshes},
          {"preparation", preparation},
          {"errors",
           {{"positionMax", totals.worst.positionMax},
            {"normalMaxDegrees", totals.worst.normalMaxDegrees},
            {"tiltMaxDegrees", totals.worst.tiltMaxDegrees}}},
          {"lightBeyondDepth", lightBeyondJson(baked)},
          {"choices", baked.choices},
          {"notes", baked.notes},
          {"warnings", written.warnings}};
}

std::string bakeText(const Baked& baked, const pack::Written& written, const std::string& output, bool rebaked) {
  // Step 1: all of it.
  const Totals totals = addUp(written);
  std::string text = fmt::format(
      "{}: {} meshes, {} vertices, {} -> {} ({} bytes, geometry {:.1f} bytes per triangle,\n"
      "  positions of {} bits within {:.3g} m, normals within {:.3g} degrees, faces tilted by at most {:.3g} "
      "degrees)\n",
      baked.scene.name, baked.scene.meshes.size(), baked.scene.vertexCount(), pack::triangleText(baked.scene),
      printable(output), written.bytes.size(), perTriangle(totals.geometryBytes, baked.scene.triangleCount()),
      written.positionBits, totals.worst.positionMax, totals.worst.normalMaxDegrees, totals.worst.tiltMaxDegrees);
  if (rebaked)
    text += fmt::format("  {} of {} meshes re-encoded{}{}\n", totals.reencoded, written.meshes.size(),
                        written.fullRebakeReason.empty() ? "" : ": ", written.fullRebakeReason);

  // Step 2: mesh by mesh.
  text += fmt::format("  {:<24}{:>10}{:>12}{:>6}{:>11}{:>11}{:>11}{:>10}{:>10}  {}\n", "mesh", "triangles",
                      "bytes/tri.", "bits", "error m", "normals", "tilt", "encode ms", "decode ms", "method");
  for (std::size_t i = 0; i < written.meshes.size(); ++i) {
    const pack::MeshCompression& m = written.meshes[i];
    const pack::Mesh& mesh = baked.scene.meshes[i];
    text += fmt::format("  {:<24}{:>10}{:>12.2f}{:>6}{:>11.2g}{:>11.2g}{:>11.2g}{:>10.1f}{:>10.1f}  {}{}{}{}\n",
                        printable(mesh.name), mesh.triangles.size(), perTriangle(m.sizeBytes, mesh.triangles.size()),
                        m.normalBits, m.deviation.positionMax, m.deviation.normalMaxDegrees, m.deviation.tiltMaxDegrees,
                        m.encodeMs, m.decodeMs, m.method, m.reused ? ", reused" : "",
                        m.sequentialReason.empty() ? "" : ": ", m.sequentialReason);
  }

  std::size_t textured = 0;
  double uvTexels = 0;
  for (const pack::MeshCompression& m : written.meshes) {
    textured += m.texture.grids.any() ? 1 : 0;
    uvTexels = std::max(uvTexels, m.texture.deviation.uvTexels);
  }
  if (textured > 0)
    text += fmt::format("  {} with texture coordinates, within {:.3g} texels\n",
                        textured == 1 ? "1 mesh" : fmt::format("{} meshes", textured), uvTexels);
  for (const std::string& choice : baked.choices) text += fmt::format("  {}\n", printable(choice));
  if (baked.probe)
    text += fmt::format("  light beyond depth {}: {:.3g} %, measured by {} rays in {:.0f} ms\n", baked.scene.depth,
                        100 * shareBeyond(baked.scene.lightBeyond, baked.scene.depth), baked.probe->rays,
                        baked.probe->milliseconds);

  // Step 3: simplified files and parts.
  for (const prep::Report& report : baked.reports) {
    const prep::Simplification& s = report.simplification;
    if (!s.applied) continue;
    text +=
        fmt::format("  simplified {}: {} -> {} triangles, within {:.3g} m and {:.3g} degrees\n",
                    printable(report.source), s.trianglesBefore, s.trianglesAfter, s.maxDeviation, s.maxNormalDegrees);
  }
  return text;
}

}  // namespace malus::bake

#include "bake/info.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "bake/depth_probe.h"
#include "bake/effects/deepest_bounce.h"
#include "bake/effects/effects.h"
#include "bake/effects/polarization_bound.h"
#include "bake/pack/instances.h"
#include "bake/scene_json.h"
#include "meshprep/base/error.h"
#include "meshprep/base/text.h"

namespace malus::bake {
using nlohmann::json;

namespace {
std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

glm::dvec3 errorBound(const pack::Scene& scene) {
  ImageRequest request;
  request.depth = scene.depth;
  return polarizationErrorBound(scene, request);
}

// Measures the difference that polarization makes if the bound is too large.
std::optional<PolarizationProbe> probe(const pack::Scene& scene, const glm::dvec3& bound,
                                       const MeasurePolarization& measure) {
  if (!measure || isUseful(bound)) return std::nullopt;
  try {
    return measure(scene);
  } catch (const Error&) {  // a scene that cannot be rendered has contents all the same
    return std::nullopt;
  }
}

json toJson(const std::optional<PolarizationProbe>& probed) {
  if (!probed) return {};
  return {{"width", probed->width},
          {"height", probed->height},
          {"relRms", probed->relRms},
          {"shareOver1Percent", probed->shareOver1Percent}};
}

std::string polarizationText(const pack::Scene& scene, const MeasurePolarization& measure) {
  const glm::dvec3 bound = errorBound(scene);
  if (bound == glm::dvec3(0.0)) return "  the unpolarized intensity without a filter is exact\n";
  if (isUseful(bound))
    return fmt::format(
        "  without polarization the relative error of the intensity is at most {:.3g}, {:.3g}, {:.3g} (r, g, b)\n",
        bound.x, bound.y, bound.z);
  std::string text = "  without polarization: no useful bound of the error";
  if (const std::optional<PolarizationProbe> probed = probe(scene, bound, measure))
    text +=
        fmt::format("; measured at {} x {} pixels: relative RMS {:.2g}, {:.3g} % of the pixels off by more than 1 %",
                    probed->width, probed->height, probed->relRms, 100 * probed->shareOver1Percent);
  return text + "\n";
}

// The number of interactions after which at most a share of the light of the bake's small image arrives; none if the
// bake measured no light.
std::optional<std::size_t> measuredDeepest(const pack::Scene& scene, double tolerance) {
  if (scene.lightBeyond.empty()) return std::nullopt;
  std::size_t depth = 0;
  while (depth < scene.depth && shareBeyond(scene.lightBeyond, depth) > tolerance) ++depth;
  return depth;
}

std::string depthText(const pack::Scene& scene, double tolerance) {
  const std::uint32_t bound = deepestBounce(scene, scene.depth, tolerance);
  std::string text =
      fmt::format("  deepest bounce that can change a pixel by more than {:g} of its radiance: {}\n", tolerance,
                  bound < scene.depth ? fmt::format("{}", bound) : fmt::format("no bound below the depth, {}", bound));
  if (const std::optional<std::size_t> deepest = measuredDeepest(scene, tolerance))
    text += fmt::format("  measured on a small image: {:.3g} % of the light arrives after more than {} bounces\n",
                        100 * shareBeyond(scene.lightBeyond, *deepest), *deepest);
  if (!scene.lightBeyond.empty())
    text += fmt::format("  light beyond the depth: {:.3g} %\n", 100 * shareBeyond(scene.lightBeyond, scene.depth));
  return text;
}

// Of each mesh.
std::vector<std::size_t> countPlaces(const pack::Scene& scene) {
  std::vector<std::size_t> places(scene.meshes.size(), 1);
  for (const pack::Instance& instance : scene.instances) ++places[instance.mesh];
  return places;
}

json errorsJson(const compress::Deviation& deviation) {
  return {{"positionMax", deviation.positionMax},
          {"normalMaxDegrees", deviation.normalMaxDegrees},
          {"tiltMaxDegrees", deviation.tiltMaxDegrees}};
}

// Texture attributes of a mesh: null without any.
json textureJson(const pack::Pack& pack, std::size_t mesh) {
  const pack::Mesh& m = pack.scene.meshes[mesh];
  if (!m.hasTextureAttributes()) return {};
  const pack::TextureEncoding& texture = pack.textures[mesh];
  return {{"sets", (m.textureCoordinates[0].empty() ? 0 : 1) + (m.textureCoordinates[1].empty() ? 0 : 1)},
          {"steps", {texture.grids.sets[0].step, texture.grids.sets[1].step}},
          {"tangentBits", texture.grids.tangentBits},
          {"texels", texture.texels},
          {"uvMaxTexels", texture.deviation.uvTexels},
          {"tangentMaxDegrees", texture.deviation.tangentDegrees}};
}

// Number of meshes with texture coordinates and their largest error; empty without any.
std::string textureText(const pack::Pack& pack) {
  std::size_t meshes = 0;
  double worst = 0;
  for (const pack::TextureEncoding& texture : pack.textures) {
    meshes += texture.grids.any() ? 1 : 0;
    worst = std::max(worst, texture.deviation.uvTexels);
  }
  if (meshes == 0) return {};
  return fmt::format("  texture coordinates of {} within {:.3g} texels\n",
                     meshes == 1 ? "1 mesh" : fmt::format("{} meshes", meshes), worst);
}

// Bits and the largest errors over all meshes, if the pack has ENCD.
std::string encodingText(const pack::Pack& pack) {
  std::string text;
  if (pack.encodings.known()) {
    compress::Deviation worst;
    for (const pack::MeshEncoding& m : pack.encodings.meshes) {
      worst.positionMax = std::max(worst.positionMax, m.deviation.positionMax);
      worst.normalMaxDegrees = std::max(worst.normalMaxDegrees, m.deviation.normalMaxDegrees);
      worst.tiltMaxDegrees = std::max(worst.tiltMaxDegrees, m.deviation.tiltMaxDegrees);
    }
    text += fmt::format(
        "  positions of {} bits within {:.3g} m, normals within {:.3g} degrees, faces tilted by at most {:.3g} "
        "degrees\n",
        pack.encodings.positionBits(), worst.positionMax, worst.normalMaxDegrees, worst.tiltMaxDegrees);
  }
  text += textureText(pack);
  if (pack.hasSourceMap()) text += "  the map to the source's vertices and faces is kept\n";
  return text;
}

// The pack's effects by their current names. If the pack is older than some effects, all are determined again.
std::vector<pack::Effect> currentEffects(const pack::Scene& scene) {
  std::vector<std::string> missing = effectNames();
  const std::size_t known = missing.size();
  std::vector<pack::Effect> effects = scene.effects;
  for (pack::Effect& e : effects) {
    if (const auto effect = shaders::effectNamed(e.name)) e.name = shaders::effectName(*effect);
    std::erase(missing, e.name);
  }
  const bool older = !missing.empty() && missing.size() + effects.size() == known;
  return older ? findEffects(scene) : effects;
}
}  // namespace

json infoJson(const pack::Pack& pack, double tolerance, const MeasurePolarization& measure) {
  const pack::Scene& scene = pack.scene;
  const std::vector<std::size_t> places = countPlaces(scene);
  json meshes = json::array(), materials = json::array(), sections = json::array();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const pack::Mesh& m = scene.meshes[i];
    meshes.push_back({{"name", m.name},
                      {"vertices", m.positions.size()},
                      {"triangles", m.triangles.size()},
                      {"material", scene.materials[m.material].name},
                      {"openSurface", m.openSurface},
                      {"placements", places[i]},
                      {"encoding", pack.compression[i]},
                      {"positionBits", pack.encodings.known() ? json(pack.encodings.meshes[i].positionBits) : json()},
                      {"origin", {m.origin.x, m.origin.y, m.origin.z}},
                      {"normalBits", pack.encodings.known() ? json(pack.encodings.meshes[i].normalBits) : json()},
                      {"textureCoordinates", textureJson(pack, i)},
                      {"errors", pack.encodings.known() ? errorsJson(pack.encodings.meshes[i].deviation) : json()}});
  }
  for (const pack::Material& m : scene.materials) materials.push_back(materialJson(m));
  for (const pack::Section& s : pack.sections)
    sections.push_back({{"id", s.id},
                        {"version", s.version},
                        {"offset", s.offset},
                        {"sizeBytes", s.sizeBytes},
                        {"hash", hex(s.hash)}});
  const glm::dvec3 bound = errorBound(scene);
  const std::optional<std::size_t> deepest = measuredDeepest(scene, tolerance);
  const pack::InstanceCounts counts = pack::countInstances(scene);
  const json provenance = provenanceJson(pack.scene);
  return {{"formatVersion", pack.formatVersion},
          {"hash", hex(pack.hash)},
          {"name", scene.name},
          {"title", scene.title},
          {"resolution", {scene.width, scene.height}},
          {"depth", scene.depth},
          {"vertices", scene.vertexCount()},
          {"triangles", scene.triangleCount()},
          {"placedTriangles", counts.placedTriangles},
          {"instances", counts.placements},
          {"geometryHash", hex(pack::canonicalGeometryHash(scene))},
          {"positionBits", pack.encodings.known() ? json(pack.encodings.positionBits()) : json()},
          {"sourceMap", pack.hasSourceMap()},
          {"meshes", meshes},
          {"materials", materials},
          {"lights", scene.lights.size()},
          {"effects", effectsJson(currentEffects(scene))},
          {"polarizationErrorBound", {bound.x, bound.y, bound.z}},
          {"withoutPolarization", toJson(probe(scene, bound, measure))},
          {"deepestBounce",
           {{"tolerance", tolerance},
            {"bounce", deepestBounce(scene, scene.depth, tolerance)},
            {"measured", deepest ? json(*deepest) : json()}}},
          {"lightBeyondDepth", scene.lightBeyond.empty() ? json() : json(shareBeyond(scene.lightBeyond, scene.depth))},
          {"sections", sections},
          {"warnings", bakeWarnings(scene)},
          {"provenance", provenance}};
}

std::string infoText(const pack::Pack& pack, double tolerance, const MeasurePolarization& measure) {
  const pack::Scene& scene = pack.scene;
  std::string text =
      fmt::format("{}  {}\n{} vertices, {}, {} lights, {} x {} pixels, depth {}\npack {} (format {})\n",
                  printable(scene.name), printable(scene.title), scene.vertexCount(), pack::triangleText(scene),
                  scene.lights.size(), scene.width, scene.height, scene.depth, hex(pack.hash), pack.formatVersion);
  if (const std::vector<std::string> warnings = bakeWarnings(scene); !warnings.empty()) {
    text += "\nwarnings of the bake\n";
    for (const std::string& warning : warnings) text += fmt::format("  {}\n", printable(warning));
  }
  text += "\nmeshes\n";
  const std::vector<std::size_t> places = countPlaces(scene);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const pack::Mesh& m = scene.meshes[i];
    text += fmt::format("  {:<24} {:>8} vertices {:>8} triangles  {}{}, {}{}\n", printable(m.name), m.positions.size(),
                        m.triangles.size(), printable(scene.materials[m.material].name),
                        m.openSurface ? " (open surface)" : "", pack.compression[i],
                        places[i] > 1 ? fmt::format(", placed {} times", places[i]) : "");
  }
  text += encodingText(pack);
  text += "\nmaterials\n";
  for (const pack::Material& m : scene.materials)
    text += fmt::format("  {:<24} {:<13} eta {:.4f} {:.4f} {:.4f}  k {:.4f} {:.4f} {:.4f}\n", printable(m.name),
                        pack::materialKindName(m.kind), m.eta.x, m.eta.y, m.eta.z, m.k.x, m.k.y, m.k.z);
  text += "\neffects\n";
  for (const pack::Effect& e : currentEffects(scene))
    text += fmt::format("  {:<3} {:<22} {}\n", e.on ? "on" : "off", printable(e.name), printable(e.reason));
  text += polarizationText(scene, measure);
  text += depthText(scene, tolerance);
  text += "\nsections\n";
  for (const pack::Section& s : pack.sections)
    text +=
        fmt::format("  {} version {}  {:>9} bytes at {:>9}  {}\n", s.id, s.version, s.sizeBytes, s.offset, hex(s.hash));
  return text;
}

}  // namespace malus::bake

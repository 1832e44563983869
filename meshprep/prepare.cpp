#include "meshprep/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/certify/glass.h"
#include "meshprep/clean/fixed_point.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/junctions.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/triangulate.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/instances.h"
#include "meshprep/normals/authored_normals.h"
#include "meshprep/normals/crease_normals.h"
#include "meshprep/normals/smoothing_normals.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/read/source_scene.h"
#include "meshprep/simplify/simplify.h"
#include "meshprep/textures/texture_vertices.h"

namespace malus::prep {

namespace {

// where: location of a conflict of options.
void checkOptions(const Options& options, const std::string& where) {
  if (!(options.creaseDegrees >= 0 && options.creaseDegrees <= 180))
    throw Error("prep", "crease angle out of range", "0 to 180 degrees", fmt::to_string(options.creaseDegrees));
  const double tolerance = options.steps.weldTolerance;
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Error("prep", "weld tolerance out of range", "0 metres or more", fmt::to_string(tolerance));
  if (!(options.weldRelative >= 0 && options.weldRelative <= 1))
    throw Error("prep", "relative weld tolerance out of range", "0 to 1", fmt::to_string(options.weldRelative));
  checkSimplifyBounds(options.simplify);
  if (const auto conflict = findSimplifyConflict(options))
    throw Error(where, conflict->problem, conflict->expected, conflict->found);
}

// The material of each face of the file, as a number; empty if all faces have the same.
std::vector<std::uint32_t> faceMaterials(const Polygons& polygons) {
  std::map<std::string_view, std::uint32_t> ids;
  for (const Part& part : polygons.parts) ids.emplace(part.material, static_cast<std::uint32_t>(ids.size()));
  if (ids.size() < 2) return {};
  std::vector<std::uint32_t> materials;
  materials.reserve(polygons.partOf.size());
  for (const std::uint32_t part : polygons.partOf) materials.push_back(ids.at(polygons.parts[part].material));
  return materials;
}

// Returns the normals of the file, normalized.
std::vector<glm::vec3> authoredNormals(const Polygons& polygons, const std::string& source) {
  if (polygons.normals.empty())
    throw Error(source, "file has no normals", "nx, ny, nz in a PLY file, or \"flat\": true");
  std::vector<glm::vec3> normals;
  for (std::size_t i = 0; i < polygons.normals.size(); ++i) {
    const glm::dvec3 n(polygons.normals[i]);
    const double length = glm::length(n);
    if (!(length > 0) || !std::isfinite(length))
      throw Error(source, fmt::format("normal of vertex {} has no length", i), "a direction");
    normals.emplace_back(n / length);
  }
  return normals;
}

// Runs the steps and fills the report.
class Preparation {
 public:
  // faceMaterials: of the faces of the source; empty if they all have the same.
  Preparation(Mesh mesh, const Options& options, std::vector<std::uint32_t> faceMaterials, Report& report)
      : mesh_(std::move(mesh)), options_(options), faceMaterials_(std::move(faceMaterials)), report_(report) {}

  Mesh run() {
    setSources();
    cleanMesh();
    inspect();
    addNormals();
    addTextures();
    report_.output.vertices = mesh_.positions.size();
    report_.output.triangles = mesh_.triangles.size();
    return std::move(mesh_);
  }

 private:
  void step(std::string name, std::uint64_t count) { report_.steps.push_back({std::move(name), count, {}}); }
  void step(std::string name, Findings findings) {
    report_.steps.push_back({std::move(name), findings.count, std::move(findings.first)});
  }

  // Sets the sources of a mesh in memory, which is its own source.
  void setSources() {
    if (mesh_.sourceVertices.empty()) {
      mesh_.sourceVertices.resize(mesh_.positions.size());
      std::iota(mesh_.sourceVertices.begin(), mesh_.sourceVertices.end(), 0u);
    }
    if (mesh_.sourceFaces.empty()) {
      mesh_.sourceFaces.resize(mesh_.triangles.size());
      std::iota(mesh_.sourceFaces.begin(), mesh_.sourceFaces.end(), 0u);
    }
    mesh_.sourceCorners.clear();
    mesh_.sourceCorners.reserve(mesh_.triangles.size());
    for (const glm::uvec3& t : mesh_.triangles)
      mesh_.sourceCorners.emplace_back(mesh_.sourceVertices[t.x], mesh_.sourceVertices[t.y], mesh_.sourceVertices[t.z]);
    mesh_.flipped.assign(mesh_.triangles.size(), 0);
  }

  double weldTolerance() const {
    if (options_.weldRelative == 0 || mesh_.triangles.empty()) return options_.steps.weldTolerance;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const glm::uvec3& t : mesh_.triangles)  // ignore unused vertices
      for (int k = 0; k < 3; ++k)
        low = glm::min(low, mesh_.positions[t[k]]), high = glm::max(high, mesh_.positions[t[k]]);
    return std::max(options_.steps.weldTolerance, options_.weldRelative * glm::distance(low, high));
  }

  void cleanMesh() {
    Cleaning steps = options_.steps;
    steps.openSurface = options_.openSurface;
    if (!report_.source.empty()) steps.where = report_.source;
    steps.weldTolerance = weldTolerance();
    Cleaned done = cleanToFixedPoint(mesh_, steps);
    if (mesh_.triangles.empty())
      throw Error(report_.source.empty() ? "mesh" : report_.source, "no triangle is left after cleaning",
                  "a triangle with area");
    step("vertices-welded", std::move(done.welded.joined));
    step("welds-refused", std::move(done.welded.refused));
    step("faces-dropped-repeated-corner", std::move(done.degenerate.repeatedCorner));
    step("faces-dropped-zero-area", std::move(done.degenerate.zeroArea));
    step("edges-collapsed", std::move(done.degenerate.edgesCollapsed));
    step("faces-cut-beside-zero-area", std::move(done.degenerate.neighboursCut));
    step("faces-dropped-duplicate", std::move(done.duplicates.same));
    step("faces-kept-walls", std::move(done.duplicates.walls));
    step(steps.dropOpposite ? "faces-dropped-opposite" : "faces-opposite", std::move(done.duplicates.opposite));
    step("vertices-dropped-unreferenced", std::move(done.unreferenced));
    step("edges-separated", std::move(done.fans.edges));
    step("vertices-split", std::move(done.fans.vertices));
    step("edges-cut", done.fans.cutEdges);
    step("holes", std::move(done.holes));
    step("holes-filled", std::move(done.filled.filled));
    step("holes-left", std::move(done.filled.left));
    step("cleaning-not-converged", done.converged ? 0 : 1);
    orientation_ = std::move(done.orientation);
    if (options_.simplify.any()) simplifyMesh();
    reportOrientation();
  }

  void simplifyMesh() {
    SimplifyLines lines;
    if (!options_.flat && options_.normals == Normals::crease) lines.creaseDegrees = options_.creaseDegrees;
    lines.smoothingGroups = !options_.flat && options_.normals == Normals::smoothing && !mesh_.smoothingGroups.empty();
    std::vector<std::uint32_t> materials;
    if (!faceMaterials_.empty())
      for (const std::uint32_t face : mesh_.sourceFaces) materials.push_back(faceMaterials_[face]);
    lines.materials = materials;
    if (orientation_.notOrientable > 0) {
      report_.simplification = {true, mesh_.triangles.size(), mesh_.triangles.size(), 0, 0, {}};
      report_.simplification.warnings.emplace_back(
          "the mesh is unchanged: a component has one side only; cut it where it twists");
      return;
    }
    if (options_.certifyGlass) unsimplified_ = mesh_;
    report_.simplification = simplify(mesh_, options_.simplify, lines);
    orientation_ = orient(mesh_, options_.openSurface);
  }

  // Problems of a mesh that would be certified without simplification need another repair.
  void blameSimplification() {
    const Simplification& s = report_.simplification;
    if (report_.certificate.isGranted() || s.trianglesAfter == s.trianglesBefore) return;
    const OrientResult sides = orient(unsimplified_, options_.openSurface);
    Intersections intersections;
    if (!options_.openSurface) intersections = findIntersections(unsimplified_);
    if (!certifyGlass(unsimplified_, options_.openSurface, {sides, intersections}).isGranted()) return;
    for (Problem& problem : report_.certificate.problems)
      problem.repair =
          "simplify less, because the mesh is certified without simplification: lower --simplify-error or "
          "--simplify-normal, or raise --simplify-triangles (keys of a scene: simplifyError, simplifyNormal, "
          "simplifyTriangles)";
  }

  void reportOrientation() {
    step("edges-boundary", orientation_.boundaryEdges);
    step("edges-non-manifold", orientation_.nonManifoldEdges);
    step("components-not-orientable", orientation_.notOrientable);
    step("components-without-volume", orientation_.withoutVolume);
    step("components-nested", orientation_.nested);
    step("components-kept-doubled", orientation_.keptDoubled);
    step("components-oriented-by-visibility", orientation_.orientedByVisibility);
    step("components-oriented-by-majority", orientation_.orientedByMajority);
    step("components-nesting-unchecked", orientation_.nestingUnchecked);
    Findings flipped;
    for (Component& c : orientation_.components) c.flipped = 0;
    for (std::size_t i = 0; i < mesh_.flipped.size(); ++i) {
      if (mesh_.flipped[i] == 0) continue;
      flipped.add([&] { return findingAt(mesh_, centroid(mesh_, i), {i}); });
      ++orientation_.components[orientation_.componentOf[i]].flipped;
    }
    step("faces-flipped", std::move(flipped));
    report_.components = orientation_.components;
  }

  // Reports defects that are not repaired.
  void inspect() {
    if (options_.findJunctions) {
      Junctions junctions;  // of boundary edges only
      if (orientation_.boundaryEdges > 0) junctions = findJunctions(mesh_);
      step("t-junctions", std::move(junctions.found));
      step("t-junctions-unchecked", junctions.complete ? 0 : 1);
    }
    Intersections intersections;
    if (options_.findIntersections || (options_.certifyGlass && !options_.openSurface)) {
      intersections = findIntersections(mesh_);
      step("faces-crossing", describePairs(mesh_, intersections.crossing));
      step("faces-coincident", describePairs(mesh_, intersections.coincident));
      step("faces-crossing-unchecked", intersections.complete ? 0 : 1);
    }
    if (!options_.certifyGlass) return;
    report_.certificate = certifyGlass(mesh_, options_.openSurface, {orientation_, intersections});
    blameSimplification();
  }

  void addNormals() {
    NormalCounts counts;
    Findings against;
    std::uint64_t missing = 0;
    if (options_.flat) {
      mesh_.normals.clear();
    } else if (options_.normals == Normals::authored) {
      if (mesh_.cornerNormals.empty())
        throw Error(report_.source, "file has no normals", "normals in the file, or --normals crease");
      AuthoredNormals authored = addAuthoredNormals(mesh_, options_.creaseDegrees);
      counts = authored.counts;
      against = std::move(authored.against);
      missing = authored.missing;
    } else if (options_.normals == Normals::smoothing) {
      if (mesh_.smoothingGroups.empty())
        throw Error(report_.source, "file has no smoothing groups", "'s' statements, or --normals crease");
      counts = addSmoothingNormals(mesh_);
    } else {
      counts = addCreaseNormals(mesh_, options_.creaseDegrees);
    }
    step("vertices-added-at-creases", counts.added);
    step("normals-undefined", counts.undefined);
    step("normals-missing", missing);
    step("normals-against-their-face", std::move(against));
  }

  void addTextures() {
    if (mesh_.cornerTextures.empty()) return;
    const TextureVertexCounts counts = addTextureVertices(mesh_);
    step("vertices-added-at-seams", counts.added);
    step("texture-corners-filled", counts.filled);
    step("tangents-undefined", counts.tangents);
  }

  Mesh mesh_;
  const Options& options_;
  std::vector<std::uint32_t> faceMaterials_;
  Mesh unsimplified_;  // kept for a certificate
  Report& report_;
  OrientResult orientation_;
};

// Sets the locations of the findings in the file.
void addLocations(const Polygons& polygons, Report& report) {
  const auto locate = [&](const std::vector<std::uint64_t>& locations,
                          const std::vector<std::uint32_t>& ids) -> std::string {
    if (ids.empty() || ids.front() >= locations.size()) return {};
    return polygons.locationsAreBytes ? fmt::format("{}, byte {}", report.source, locations[ids.front()])
                                      : fmt::format("{}:{}", report.source, locations[ids.front()]);
  };
  for (Step& step : report.steps)
    for (Finding& finding : step.findings) {
      finding.sourceLocation = locate(polygons.faceLocations, finding.faces);
      if (finding.sourceLocation.empty()) finding.sourceLocation = locate(polygons.vertexLocations, finding.vertices);
    }
}

}  // namespace

std::optional<OptionConflict> findSimplifyConflict(const Options& options) {
  if (!options.simplify.any()) return std::nullopt;
  if (options.asIs) return OptionConflict{"simplification needs a cleaned mesh", "\"asIs\": false", "\"asIs\": true"};
  const Cleaning& steps = options.steps;
  if (!steps.degenerate || !steps.duplicates || !steps.orient || !steps.fans)
    return OptionConflict{"simplification needs an oriented manifold",
                          "the steps degenerate, duplicates, orient and fans (option --skip, key 'skip')",
                          "one of them skipped"};
  if (!options.flat && options.normals == Normals::authored)
    return OptionConflict{"the file's normals do not fit a simplified mesh",
                          "crease or smoothing (option --normals, key 'normals'), or flat", "authored"};
  return std::nullopt;
}

Mesh clean(Mesh mesh, const Options& options, Report& report) {
  checkOptions(options, "prep");
  return Preparation(std::move(mesh), options, {}, report).run();
}

Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report) {
  checkOptions(options, source.string());
  const KeepTextures textures = options.keepTextures ? KeepTextures::all : KeepTextures::none;
  if (isGltf(source))
    return prepareInstances(readSourceScene(source, options.strict, false, textures), source.string(), options, report);
  Polygons polygons = readMesh(source, options.strict);
  keepTextureCoordinates(polygons, options.keepTextures);
  return prepare(polygons, source.string(), options, report);
}

Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report) {
  checkOptions(options, source);
  report = {};
  report.source = source;
  report.notes = polygons.notes;
  report.input.vertices = polygons.positions.size();
  report.input.faces = polygons.faceCount();

  // Triangulate.
  TriangulateCounts counts;
  Mesh mesh;
  try {
    mesh = triangulate(polygons, counts);
  } catch (const Error& error) {  // names only the face
    throw Error(source, error.what());
  }
  std::vector<char> isUsed(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) isUsed[t.x] = isUsed[t.y] = isUsed[t.z] = 1;
  std::vector<glm::dvec3> used;
  for (std::size_t v = 0; v < isUsed.size(); ++v)
    if (isUsed[v] != 0) used.push_back(mesh.positions[v]);
  compress::requireAcceptedSize(used, source);
  report.steps.push_back({"polygons-triangulated", counts.polygons, {}});
  report.steps.push_back({"polygons-concave", counts.concave, {}});
  report.steps.push_back({"polygons-non-planar", counts.nonPlanar, {}});
  report.steps.push_back({"polygons-self-crossing", counts.crossing, {}});
  report.steps.push_back({"polygon-corners-repeated", counts.repeatedCorners, {}});
  report.steps.push_back({"polygons-recut", counts.recut, {}});
  report.steps.push_back({"faces-dropped-few-corners", counts.fewCorners, {}});
  if (mesh.triangles.empty()) throw Error(source, "no face has three corners", "a triangle with area");

  // Clean, unless the mesh is used unchanged.
  if (options.asIs) {
    if (!options.flat) mesh.normals = authoredNormals(polygons, report.source);
    if (!mesh.cornerTextures.empty())
      report.steps.push_back({"vertices-added-at-seams", addTextureVertices(mesh).added, {}});
    report.output.vertices = mesh.positions.size();
    report.output.triangles = mesh.triangles.size();
    return mesh;
  }
  mesh = Preparation(std::move(mesh), options, faceMaterials(polygons), report).run();
  addLocations(polygons, report);
  return mesh;
}

}  // namespace malus::prep

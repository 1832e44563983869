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
#include "meshprep/clean/intersections.h"
#include "meshprep/clean/junctions.h"
#include "meshprep/clean/rounds.h"
#include "meshprep/clean/select.h"
#include "meshprep/clean/triangulate.h"
#include "meshprep/normals/authored_normals.h"
#include "meshprep/normals/crease_normals.h"
#include "meshprep/normals/smoothing_normals.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/simplify/simplify.h"

namespace malus::prep {

namespace {

void checkOptions(const Options& options) {
  if (!(options.creaseDegrees >= 0 && options.creaseDegrees <= 180))
    throw Error("prep", "a crease angle out of bounds", "0 to 180 degrees", fmt::to_string(options.creaseDegrees));
  const double tolerance = options.steps.weldTolerance;
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Error("prep", "a weld tolerance out of bounds", "0 or more metres", fmt::to_string(tolerance));
  if (!(options.weldRelative >= 0 && options.weldRelative <= 1))
    throw Error("prep", "a relative weld tolerance out of bounds", "0 to 1", fmt::to_string(options.weldRelative));
  checkSimplifyBounds(options.simplify);
  if (!options.simplify.any()) return;
  if (options.asIs)
    throw Error("prep --simplify", "simplification needs a cleaned mesh", "a mesh that is not taken as it is");
  const Cleaning& steps = options.steps;
  if (!steps.degenerate || !steps.duplicates || !steps.orient || !steps.fans)
    throw Error("prep --simplify", "simplification needs an oriented manifold",
                "cleaning with the steps degenerate, duplicates, orient and fans", "--skip of one of them");
  if (!options.flat && options.normals == Normals::authored)
    throw Error("prep --simplify", "the file's normals do not fit a simplified mesh",
                "--normals crease or --normals smoothing", "--normals authored");
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

// The file's own normals, made unit.
std::vector<glm::vec3> authoredNormals(const Polygons& polygons, const std::string& source) {
  if (polygons.normals.empty()) throw Error(source, "has no normals", "nx, ny, nz in a PLY file, or a flat mesh");
  std::vector<glm::vec3> normals;
  for (std::size_t i = 0; i < polygons.normals.size(); ++i) {
    const glm::dvec3 n(polygons.normals[i]);
    const double length = glm::length(n);
    if (!(length > 0) || !std::isfinite(length))
      throw Error(source, fmt::format("the normal of vertex {} has no length", i), "a direction");
    normals.emplace_back(n / length);
  }
  return normals;
}

// The steps, each with its entry in the report.
class Preparation {
 public:
  // faceMaterials: of the faces of the source; empty if they all have the same.
  Preparation(Mesh mesh, const Options& options, std::vector<std::uint32_t> faceMaterials, Report& report)
      : mesh_(std::move(mesh)), options_(options), faceMaterials_(std::move(faceMaterials)), report_(report) {}

  Mesh run() {
    nameSources();
    cleanUp();
    look();
    addNormals();
    report_.output.vertices = mesh_.positions.size();
    report_.output.triangles = mesh_.triangles.size();
    return std::move(mesh_);
  }

 private:
  void step(std::string name, std::uint64_t count) { report_.steps.push_back({std::move(name), count, {}}); }
  void step(std::string name, Findings findings) {
    report_.steps.push_back({std::move(name), findings.count, std::move(findings.first)});
  }

  // A mesh in memory is its own source.
  void nameSources() {
    if (mesh_.sourceVertices.empty()) {
      mesh_.sourceVertices.resize(mesh_.positions.size());
      std::iota(mesh_.sourceVertices.begin(), mesh_.sourceVertices.end(), 0u);
    }
    if (mesh_.sourceFaces.empty()) {
      mesh_.sourceFaces.resize(mesh_.triangles.size());
      std::iota(mesh_.sourceFaces.begin(), mesh_.sourceFaces.end(), 0u);
    }
    mesh_.sourceCorners.clear();
    for (const glm::uvec3& t : mesh_.triangles)
      mesh_.sourceCorners.emplace_back(mesh_.sourceVertices[t.x], mesh_.sourceVertices[t.y], mesh_.sourceVertices[t.z]);
    mesh_.turned.assign(mesh_.triangles.size(), 0);
  }

  double weldTolerance() const {
    if (options_.weldRelative == 0 || mesh_.triangles.empty()) return options_.steps.weldTolerance;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const glm::uvec3& t : mesh_.triangles)  // what no face names may lie anywhere
      for (int k = 0; k < 3; ++k)
        low = glm::min(low, mesh_.positions[t[k]]), high = glm::max(high, mesh_.positions[t[k]]);
    return std::max(options_.steps.weldTolerance, options_.weldRelative * glm::distance(low, high));
  }

  void cleanUp() {
    Cleaning steps = options_.steps;
    steps.sheet = options_.sheet;
    if (!report_.source.empty()) steps.where = report_.source;
    steps.weldTolerance = weldTolerance();
    Cleaned done = cleanInRounds(mesh_, steps);
    if (mesh_.triangles.empty())
      throw Error(report_.source.empty() ? "mesh" : report_.source, "nothing is left after cleaning",
                  "a triangle with area");
    step("vertices-welded", std::move(done.welded.joined));
    step("welds-refused", std::move(done.welded.refused));
    step("faces-dropped-repeated-corner", std::move(done.degenerate.repeatedCorner));
    step("faces-dropped-zero-area", std::move(done.degenerate.zeroArea));
    step("edges-collapsed", std::move(done.degenerate.edgesCollapsed));
    step("faces-cut-beside-zero-area", std::move(done.degenerate.neighboursCut));
    step("faces-dropped-duplicate", std::move(done.duplicates.same));
    step(steps.dropOpposite ? "faces-dropped-opposite" : "faces-opposite", std::move(done.duplicates.opposite));
    step("vertices-dropped-unreferenced", std::move(done.unreferenced));
    step("edges-taken-apart", std::move(done.fans.edges));
    step("vertices-split", std::move(done.fans.vertices));
    step("edges-cut", done.fans.cutEdges);
    step("holes", std::move(done.holes));
    step("holes-filled", std::move(done.filled.filled));
    step("holes-left", std::move(done.filled.left));
    step("rounds-ran-out", done.settled ? 0 : 1);
    sides_ = std::move(done.sides);
    if (options_.simplify.any()) simplifyMesh();
    tellSides();
  }

  void simplifyMesh() {
    SimplifyLines lines;
    if (!options_.flat && options_.normals == Normals::crease) lines.creaseDegrees = options_.creaseDegrees;
    lines.smoothingGroups = !options_.flat && options_.normals == Normals::smoothing && !mesh_.smoothingGroups.empty();
    std::vector<std::uint32_t> materials;
    if (!faceMaterials_.empty())
      for (const std::uint32_t face : mesh_.sourceFaces) materials.push_back(faceMaterials_[face]);
    lines.materials = materials;
    if (sides_.notOrientable > 0) {
      report_.simplification = {true, mesh_.triangles.size(), mesh_.triangles.size(), 0, 0, {}};
      report_.simplification.warnings.emplace_back(
          "the mesh is unchanged: a component has one side only; cut it where it twists");
      return;
    }
    if (options_.certifyGlass) unsimplified_ = mesh_;
    report_.simplification = simplify(mesh_, options_.simplify, lines);
    sides_ = orient(mesh_, options_.sheet);
  }

  // Problems of a mesh that would be certified without simplification need another repair.
  void blameSimplification() {
    const Simplification& s = report_.simplification;
    if (report_.certificate.holds() || s.trianglesAfter == s.trianglesBefore) return;
    const OrientResult sides = orient(unsimplified_, options_.sheet);
    Intersections intersections;
    if (!options_.sheet) intersections = findIntersections(unsimplified_);
    if (!certifyGlass(unsimplified_, options_.sheet, {sides, intersections}).holds()) return;
    for (Problem& problem : report_.certificate.problems)
      problem.repair =
          "simplify less, because the mesh is certified without simplification: lower --simplify-error or "
          "--simplify-normal, or raise --simplify-triangles";
  }

  void tellSides() {
    step("edges-boundary", sides_.boundaryEdges);
    step("edges-non-manifold", sides_.nonManifoldEdges);
    step("components-not-orientable", sides_.notOrientable);
    step("components-without-volume", sides_.withoutVolume);
    step("components-nested", sides_.nested);
    step("components-nesting-unchecked", sides_.nestingUnchecked);
    Findings flipped;
    for (Component& c : sides_.components) c.flipped = 0;
    for (std::size_t i = 0; i < mesh_.turned.size(); ++i) {
      if (mesh_.turned[i] == 0) continue;
      flipped.add([&] { return findingAt(mesh_, centroid(mesh_, i), {i}); });
      ++sides_.components[sides_.componentOf[i]].flipped;
    }
    step("faces-turned-over", std::move(flipped));
    report_.components = sides_.components;
  }

  // What is told and left.
  void look() {
    if (options_.findJunctions) {
      Junctions junctions = findJunctions(mesh_);
      step("t-junctions", std::move(junctions.found));
      step("t-junctions-unchecked", junctions.complete ? 0 : 1);
    }
    Intersections intersections;
    if (options_.findIntersections || (options_.certifyGlass && !options_.sheet)) {
      intersections = findIntersections(mesh_);
      step("faces-crossing", describePairs(mesh_, intersections.crossing));
      step("faces-coincident", describePairs(mesh_, intersections.coincident));
      step("faces-crossing-unchecked", intersections.complete ? 0 : 1);
    }
    if (!options_.certifyGlass) return;
    report_.certificate = certifyGlass(mesh_, options_.sheet, {sides_, intersections});
    blameSimplification();
  }

  void addNormals() {
    NormalCounts counts;
    Findings against;
    std::uint64_t missing = 0;
    if (options_.flat) {
      mesh_.normals.clear();
    } else if (options_.normals == Normals::authored) {
      if (mesh_.cornerNormals.empty()) throw Error(report_.source, "has no normals", "normals, or --normals crease");
      AuthoredNormals authored = addAuthoredNormals(mesh_, options_.creaseDegrees);
      counts = authored.counts;
      against = std::move(authored.against);
      missing = authored.missing;
    } else if (options_.normals == Normals::smoothing) {
      if (mesh_.smoothingGroups.empty())
        throw Error(report_.source, "has no smoothing groups", "'s' statements, or --normals crease");
      counts = addSmoothingNormals(mesh_);
    } else {
      counts = addCreaseNormals(mesh_, options_.creaseDegrees);
    }
    step("vertices-added-at-creases", counts.added);
    step("normals-undefined", counts.undefined);
    step("normals-missing", missing);
    step("normals-against-their-face", std::move(against));
  }

  Mesh mesh_;
  const Options& options_;
  std::vector<std::uint32_t> faceMaterials_;
  Mesh unsimplified_;  // kept for a certificate
  Report& report_;
  OrientResult sides_;
};

// Where in the file the findings are.
void addPlaces(const Polygons& polygons, Report& report) {
  const auto place = [&](const std::vector<std::uint64_t>& places,
                         const std::vector<std::uint32_t>& ids) -> std::string {
    if (ids.empty() || ids.front() >= places.size()) return {};
    return polygons.locationsAreBytes ? fmt::format("{}, byte {}", report.source, places[ids.front()])
                                      : fmt::format("{}:{}", report.source, places[ids.front()]);
  };
  for (Step& step : report.steps)
    for (Finding& finding : step.findings) {
      finding.place = place(polygons.faceLocations, finding.faces);
      if (finding.place.empty()) finding.place = place(polygons.vertexLocations, finding.vertices);
    }
}

}  // namespace

Mesh clean(Mesh mesh, const Options& options, Report& report) {
  checkOptions(options);
  return Preparation(std::move(mesh), options, {}, report).run();
}

Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report) {
  checkOptions(options);
  return prepare(readMesh(source), source.string(), options, report);
}

Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report) {
  checkOptions(options);
  report = {};
  report.source = source;
  report.notes = polygons.notes;
  report.input.vertices = polygons.positions.size();
  report.input.faces = polygons.faceCount();

  // Step 1: triangles.
  TriangulateCounts counts;
  Mesh mesh;
  try {
    mesh = triangulate(polygons, counts);
  } catch (const Error& error) {  // which names the face alone
    throw Error(source, error.what());
  }
  report.steps.push_back({"polygons-triangulated", counts.polygons, {}});
  report.steps.push_back({"polygons-concave", counts.concave, {}});
  report.steps.push_back({"polygons-non-planar", counts.nonPlanar, {}});
  report.steps.push_back({"polygons-self-crossing", counts.crossing, {}});
  report.steps.push_back({"polygon-corners-repeated", counts.repeatedCorners, {}});

  // Step 2: everything else, or nothing.
  if (options.asIs) {
    if (!options.flat) mesh.normals = authoredNormals(polygons, report.source);
    report.output.vertices = mesh.positions.size();
    report.output.triangles = mesh.triangles.size();
    return mesh;
  }
  mesh = Preparation(std::move(mesh), options, faceMaterials(polygons), report).run();
  addPlaces(polygons, report);
  return mesh;
}

}  // namespace malus::prep

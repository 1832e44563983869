#include "meshprep/prepare.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/duplicate_faces.h"
#include "meshprep/clean/orient.h"
#include "meshprep/clean/triangulate.h"
#include "meshprep/clean/unreferenced_vertices.h"
#include "meshprep/clean/weld.h"
#include "meshprep/normals/crease_normals.h"
#include "meshprep/read/read_mesh.h"

namespace malus::prep {

namespace {

void checkOptions(const Options& options) {
  if (!(options.creaseDegrees >= 0 && options.creaseDegrees <= 180))
    throw Error("prep", "a crease angle out of bounds", "0 to 180 degrees", fmt::to_string(options.creaseDegrees));
  if (!(options.weldTolerance >= 0) || !std::isfinite(options.weldTolerance))
    throw Error("prep", "a weld tolerance out of bounds", "0 or more metres", fmt::to_string(options.weldTolerance));
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

}  // namespace

Mesh clean(Mesh mesh, const Options& options, Report& report) {
  checkOptions(options);
  const auto step = [&](std::string name, std::uint64_t count) { report.steps.push_back({std::move(name), count}); };

  // Step 1: one vertex a place, then triangles that cover something, once.
  step("vertices-welded", weld(mesh, options.weldTolerance));
  const DegenerateCounts degenerate = dropDegenerateFaces(mesh);
  step("faces-dropped-repeated-corner", degenerate.repeatedCorner);
  step("faces-dropped-zero-area", degenerate.zeroArea);
  const DuplicateCounts duplicate = dropDuplicateFaces(mesh, options.sheet);
  step("faces-dropped-duplicate", duplicate.same);
  step("faces-dropped-opposite", duplicate.opposite);
  step("vertices-dropped-unreferenced", dropUnreferencedVertices(mesh));
  if (mesh.triangles.empty())
    throw Error(report.source.empty() ? "mesh" : report.source, "nothing is left after cleaning",
                "a triangle with area");

  // Step 2: sides.
  const OrientResult sides = orient(mesh, options.sheet);
  step("edges-boundary", sides.boundaryEdges);
  step("edges-non-manifold", sides.nonManifoldEdges);
  step("components-not-orientable", sides.notOrientable);
  step("components-without-volume", sides.withoutVolume);
  step("components-nested", sides.nested);
  step("components-nesting-unchecked", sides.nestingUnchecked);
  step("faces-turned-over", sides.flipped);
  report.components = sides.components;

  // Step 3: normals.
  NormalCounts normals;
  if (!options.flat) normals = addCreaseNormals(mesh, options.creaseDegrees);
  step("vertices-added-at-creases", normals.added);
  step("normals-undefined", normals.undefined);

  report.output.vertices = mesh.positions.size();
  report.output.triangles = mesh.triangles.size();
  return mesh;
}

Mesh prepare(const std::filesystem::path& source, const Options& options, Report& report) {
  checkOptions(options);
  return prepare(readMesh(source), source.string(), options, report);
}

Mesh prepare(const Polygons& polygons, const std::string& source, const Options& options, Report& report) {
  checkOptions(options);

  // Step 1: what there is.
  report = {};
  report.source = source;
  report.input.vertices = polygons.positions.size();
  report.input.faces = polygons.faceCount();

  // Step 2: triangles.
  TriangulateCounts counts;
  Mesh mesh = triangulate(polygons, counts);
  report.steps.push_back({"polygons-triangulated", counts.polygons});
  report.steps.push_back({"polygons-concave", counts.concave});
  report.steps.push_back({"polygons-non-planar", counts.nonPlanar});
  report.steps.push_back({"polygons-self-crossing", counts.crossing});
  report.steps.push_back({"polygon-corners-repeated", counts.repeatedCorners});

  // Step 3: everything else, or nothing.
  if (options.asIs) {
    if (!options.flat) mesh.normals = authoredNormals(polygons, report.source);
    report.output.vertices = mesh.positions.size();
    report.output.triangles = mesh.triangles.size();
    return mesh;
  }
  return clean(std::move(mesh), options, report);
}

}  // namespace malus::prep

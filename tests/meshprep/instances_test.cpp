// Meshes that a glTF file places several times: the result is that of the merged file.
#include "meshprep/instances.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::GltfFile;
using test::TemporaryFile;

SourceScene readScene(const GltfFile& gltf) {
  const TemporaryFile file(".glb", gltf.glb());
  return readSourceScene(file.path());
}

// A mesh at nodes with these transforms.
SourceScene placedAt(const Mesh& mesh, const std::vector<json>& nodes) {
  GltfFile gltf;
  gltf.addMesh(mesh, "mesh");
  for (json node : nodes) {
    node["mesh"] = 0;
    gltf.addNode(node);
  }
  return readScene(gltf);
}

// Every face has its own vertices, as an exporter writes them for a mesh with seams.
Mesh withSeams(const Mesh& mesh) {
  Mesh result;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const std::uint32_t v : {t.x, t.y, t.z}) result.positions.push_back(mesh.positions[v]);
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

// Triangles by the positions and normals of their corners, from the smallest corner on, sorted.
using Corner = std::array<double, 3>;
struct Faces {
  std::vector<std::array<Corner, 3>> positions;
  std::vector<std::array<Corner, 3>> normals;
};
Faces listFaces(const Mesh& mesh) {
  std::vector<std::pair<std::array<Corner, 3>, std::array<Corner, 3>>> faces;
  for (const glm::uvec3& t : mesh.triangles) {
    std::array<Corner, 3> p{}, n{};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& at = mesh.positions[t[k]];
      p[static_cast<std::size_t>(k)] = {at.x, at.y, at.z};
      if (mesh.normals.empty()) continue;
      const glm::vec3& normal = mesh.normals[t[k]];
      n[static_cast<std::size_t>(k)] = {normal.x, normal.y, normal.z};
    }
    const auto first = std::min_element(p.begin(), p.end()) - p.begin();
    std::rotate(p.begin(), p.begin() + first, p.end());
    std::rotate(n.begin(), n.begin() + first, n.end());
    faces.emplace_back(p, n);
  }
  std::sort(faces.begin(), faces.end());
  Faces result;
  for (const auto& [p, n] : faces) {
    result.positions.push_back(p);
    result.normals.push_back(n);
  }
  return result;
}

// Compares with the merged file. Returns true if the meshes were prepared in pieces.
bool expectAsMerged(const SourceScene& scene, const Options& options, const std::string& what) {
  Report merged, report;
  const Polygons polygons = mergeInstances(scene);
  const Mesh expected = prepare(polygons, "file", options, merged);
  const Mesh mesh = prepareInstances(scene, "file", options, report);
  const Faces a = listFaces(expected), b = listFaces(mesh);
  EXPECT_EQ(a.positions, b.positions) << what;
  for (std::size_t i = 0; i < a.normals.size() && i < b.normals.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(a.normals[i][k][axis], b.normals[i][k][axis], 1e-6) << what << ", face " << i;
  EXPECT_EQ(report.input.vertices, merged.input.vertices) << what;
  EXPECT_EQ(report.input.faces, merged.input.faces) << what;
  EXPECT_EQ(report.output.vertices, merged.output.vertices) << what;
  EXPECT_EQ(report.notes, merged.notes) << what;
  EXPECT_EQ(report.steps.size(), merged.steps.size()) << what;
  for (const Step& step : merged.steps) {
    EXPECT_EQ(report.count(step.name), step.count) << what << ": " << step.name;
    const auto found = std::find_if(report.steps.begin(), report.steps.end(),
                                    [&](const Step& other) { return other.name == step.name; });
    if (found == report.steps.end()) {
      ADD_FAILURE() << what << ": no step " << step.name;
      continue;
    }
    // The same vertices and faces, in another order.
    const auto keys = [](const std::vector<Finding>& findings) {
      std::vector<std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>> list;
      for (Finding finding : findings) {
        std::sort(finding.vertices.begin(), finding.vertices.end());
        list.emplace_back(finding.vertices, finding.faces);
      }
      std::sort(list.begin(), list.end());
      return list;
    };
    EXPECT_EQ(keys(found->findings), keys(step.findings)) << what << ": " << step.name;
  }
  EXPECT_EQ(report.components.size(), merged.components.size()) << what;
  double volume = 0, mergedVolume = 0;
  for (const Component& component : report.components) volume += component.signedVolume;
  for (const Component& component : merged.components) mergedVolume += component.signedVolume;
  EXPECT_NEAR(volume, mergedVolume, 1e-9 * std::max(1.0, std::abs(volume))) << what;
  EXPECT_EQ(report.certificate.isGranted(), merged.certificate.isGranted()) << what;

  // Sources are numbers of the merged file.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t number = mesh.sourceVertices[v];
    if (number == kNoSource) continue;
    EXPECT_EQ(mesh.positions[v], polygons.positions[number]) << what << ", vertex " << v;
  }
  for (const std::uint32_t f : mesh.sourceFaces) EXPECT_LT(f, polygons.faceCount()) << what;
  return mesh.sourceCorners.empty();
}

const std::vector<json> kApart = {json::object(),
                                  {{"translation", {5, 0.1, 0}}},
                                  {{"translation", {0, 7, 0}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}},
                                  {{"translation", {0, 0, 9}}, {"scale", {2, 2, 2}}},
                                  {{"translation", {-9, 0, 0}}, {"scale", {-1, 1, 1}}},
                                  {{"translation", {0, -9, 0}}, {"scale", {1, 2, 3}}}};

TEST(Instances, ApartGiveTheMergedMesh) {
  Options certified;
  certified.certifyGlass = true;
  certified.findIntersections = true;
  EXPECT_TRUE(expectAsMerged(placedAt(test::cube(), kApart), certified, "cubes"));
  EXPECT_TRUE(expectAsMerged(placedAt(withSeams(test::sphere(7, 12)), kApart), certified, "spheres with seams"));
  EXPECT_TRUE(expectAsMerged(placedAt(test::flipped(test::sphere(7, 12)), kApart), certified, "inside out"));
}

TEST(Instances, NotesAreThoseOfTheMergedMesh) {
  SourceScene scene = placedAt(test::cube(), kApart);
  scene.notes = {"textures (2)"};
  scene.cameras.emplace_back().name = "side";
  EXPECT_TRUE(expectAsMerged(scene, {}, "cubes and a camera"));
}

TEST(Instances, FindingsAreThoseOfTheMergedMesh) {
  Mesh open = withSeams(test::cube());
  open.triangles.resize(10);
  open.triangles.push_back(open.triangles[2]);  // a duplicate
  open.triangles.emplace_back(0, 1, 1);
  Options options;
  EXPECT_TRUE(expectAsMerged(placedAt(open, kApart), options, "open boxes"));
  options.steps.fillHoles = 4;
  options.flat = true;
  EXPECT_TRUE(expectAsMerged(placedAt(open, kApart), options, "filled boxes"));
  options.steps.weldTolerance = 0.01;
  EXPECT_TRUE(expectAsMerged(placedAt(open, kApart), options, "welded boxes"));
}

// Steps see the faces of both: a common wall, a body in a body, crossing bodies, a T-junction.
TEST(Instances, TouchingOrNestedOnesAreSeenTogether) {
  Options options;
  options.certifyGlass = true;
  options.findIntersections = true;
  struct Case {
    const char* what;
    json second;
    bool isRefused;
  };
  const std::vector<Case> kCases = {{"a common wall", {{"translation", {1, 0, 0}}}, true},
                                    {"a common edge", {{"translation", {1, 1, 0}}}, false},
                                    {"nested", {{"translation", {0.25, 0.25, 0.25}}, {"scale", {0.5, 0.5, 0.5}}}, true},
                                    {"crossing", {{"translation", {0.5, 0.25, 0.25}}}, true},
                                    {"the same place", json::object(), false}};  // duplicates
  for (const auto& [what, second, isRefused] : kCases) {
    // Beside two that are apart.
    const SourceScene scene =
        placedAt(test::cube(), {json::object(), second, {{"translation", {0, 0, 8}}}, {{"translation", {0, 0, 16}}}});
    expectAsMerged(scene, options, what);
    Report report;
    prepareInstances(scene, "file", options, report);
    EXPECT_EQ(report.certificate.isGranted(), !isRefused) << what;
    Options uncertified;
    EXPECT_TRUE(expectAsMerged(scene, uncertified, what)) << what;
  }
}

TEST(Instances, SeveralMeshesAndTransformsOfParents) {
  GltfFile gltf;
  gltf.addMesh(test::cube(), "cube");
  gltf.addMesh(test::sphere(5, 8), "sphere");
  for (int i = 0; i < 3; ++i) {
    const int cube = gltf.add("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    const int sphere = gltf.add("nodes", {{"mesh", 1}, {"translation", {0.5, 3, 0}}});
    gltf.addNode({{"children", {cube, sphere}}, {"translation", {0.1, 0, 10 * i}}, {"rotation", {0, 0, 0.6, 0.8}}});
  }
  Options options;
  options.certifyGlass = true;
  EXPECT_TRUE(expectAsMerged(readScene(gltf), options, "three pairs"));
}

TEST(Instances, AreMergedWhereMeshesElsewhereMatter) {
  Options simplified;
  simplified.simplify.triangles = 100;
  const SourceScene spheres = placedAt(test::sphere(7, 12), {json::object(), {{"translation", {5, 0, 0}}}});
  EXPECT_FALSE(expectAsMerged(spheres, simplified, "simplified"));
  Options relative;
  relative.weldRelative = 1e-3;
  EXPECT_FALSE(expectAsMerged(spheres, relative, "relative tolerance"));
  Options asIs;
  asIs.asIs = asIs.flat = true;
  Report report;
  EXPECT_EQ(prepareInstances(spheres, "file", asIs, report).triangles.size(), 2 * test::sphere(7, 12).triangles.size());

  // The faces of an open box contradict each other: the other one may hide it.
  Mesh contradictory = test::cube();
  contradictory.triangles.resize(10);
  std::swap(contradictory.triangles[0].y, contradictory.triangles[0].z);
  EXPECT_FALSE(expectAsMerged(placedAt(contradictory, {json::object(), {{"translation", {2, 0, 0}}}}), {}, "open"));
}

TEST(Instances, CornersThatRoundingMakesEqualAreWelded) {
  // The tip is 1e-9 m high, of which double resolves nothing 2e8 m away.
  Mesh spike = test::cube();
  spike.positions.emplace_back(0, 0, 1e-9);
  spike.triangles.emplace_back(0, 1, 8);
  const SourceScene scene = placedAt(spike, {json::object(), {{"translation", {0, 0, 2e8}}}});
  Report merged, report;
  const Mesh expected = prepare(mergeInstances(scene), "file", {}, merged);
  EXPECT_EQ(prepareInstances(scene, "file", {}, report).triangles.size(), expected.triangles.size());
}

TEST(Instances, ErrorsAreThoseOfTheMergedMesh) {
  Mesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  Report report;
  EXPECT_CONTAINS(
      test::errorMessage([&] {
        prepareInstances(placedAt(flat, {json::object(), {{"translation", {9, 0, 0}}}}), "file", {}, report);
      }),
      "no triangle is left");
  Options options;
  options.certifyGlass = true;
  Mesh open = test::cube();
  open.triangles.resize(10);
  prepareInstances(placedAt(open, kApart), "file", options, report);
  EXPECT_FALSE(report.certificate.isGranted());
  EXPECT_EQ(report.certificate.problems.size(), kApart.size());
}

}  // namespace
}  // namespace malus::prep

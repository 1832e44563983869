// Baking a description into a scene: transforms, orientation, origin, rejected inputs.
#include "bake/bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/bake_report.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "meshprep/base/image.h"
#include "meshprep/prepare.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/shapes.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;
using test::TemporaryFolder;

constexpr auto kSilent = [](std::string_view) {};

class Bake : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("cube.obj", test::kCubeObj);
    folder_.write("square.obj", test::kSquareObj);
    scene_ = json::parse(R"({
      "malus": 1, "name": "test",
      "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"gold": {"type": "metal", "preset": "gold"}, "glass": {"type": "glass", "preset": "bk7"}},
      "meshes": [{"name": "cube", "file": "cube.obj", "material": "gold"}]})");
  }
  pack::Scene baked() {
    const SceneDescription description = readSceneFile(folder_.write("scene.json", scene_.dump()));
    return bake(description, {}, kSilent).scene;
  }
  std::string error() {
    return errorMessage([&] { baked(); });
  }
  void instances(const char* list) { scene_["meshes"][0]["instances"] = json::parse(list); }

  TemporaryFolder folder_;
  json scene_;
};

// Six times the volume that the triangles enclose; positive if they face outward.
double volume6(const pack::Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles)
    sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
  return sum;
}

glm::dvec3 centre(const pack::Mesh& mesh) {
  glm::dvec3 low = mesh.positions[0], high = low;
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return (low + high) * 0.5;
}

glm::dvec3 extent(const pack::Mesh& mesh) {
  glm::dvec3 low = mesh.positions[0], high = low;
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return high - low;
}

void expectOutward(const pack::Mesh& mesh) {
  EXPECT_GT(volume6(mesh), 0) << mesh.name;
  const glm::dvec3 middle = centre(mesh);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    EXPECT_GT(glm::dot(glm::dvec3(mesh.normals[i]), mesh.positions[i] - middle), 0) << mesh.name << ", vertex " << i;
    EXPECT_NEAR(glm::length(mesh.normals[i]), 1, 1e-6);
  }
  // Each vertex normal is that of its faces, because the meshes are cubes.
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 face = glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    for (const std::uint32_t v : {t.x, t.y, t.z}) EXPECT_GT(glm::dot(mesh.normals[v], face), 0.999f) << mesh.name;
  }
}

TEST_F(Bake, UntransformedCube) {
  const pack::Scene scene = baked();
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "cube");
  EXPECT_EQ(scene.vertexCount(), 24u);
  EXPECT_EQ(scene.triangleCount(), 12u);
  EXPECT_EQ(scene.origin, glm::dvec3(0));
  EXPECT_EQ(scene.meshes[0].material, 1u);  // sorted by name: glass, gold
  expectOutward(scene.meshes[0]);
  EXPECT_NEAR(volume6(scene.meshes[0]), 6, 1e-6);
}

TEST_F(Bake, InstancesBecomeMeshesInWorldSpace) {
  scene_["origin"] = {0, 0, 0};
  instances(R"([{}, {"translate": [3, 0, 0]}, {"scale": [1, 2, 3], "translate": [0, 10, 0]}])");
  const pack::Scene scene = baked();
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[0].name, "cube.1");
  EXPECT_EQ(scene.meshes[2].name, "cube.3");
  EXPECT_EQ(scene.vertexCount(), 72u);
  EXPECT_EQ(centre(scene.meshes[1]), glm::dvec3(3, 0, 0));
  EXPECT_EQ(centre(scene.meshes[2]), glm::dvec3(0, 10, 0));
  EXPECT_EQ(extent(scene.meshes[2]), glm::dvec3(1, 2, 3));
  for (const pack::Mesh& mesh : scene.meshes) expectOutward(mesh);
}

TEST_F(Bake, MeshNamesAreUnique) {
  instances(R"([{}, {"translate": [3, 0, 0]}])");
  scene_["meshes"].push_back({{"name", "cube.1"}, {"file", "cube.obj"}, {"material", "gold"}});
  std::set<std::string> names;
  for (const pack::Mesh& mesh : baked().meshes) names.insert(mesh.name);
  EXPECT_EQ(names.size(), 3u);
  EXPECT_EQ(names.count("cube.1"), 1u);
}

TEST_F(Bake, MirroringScalesKeepOrientation) {
  instances(R"([{"scale": [-1, 1, 1]}, {"scale": [1, -2, 1], "translate": [5, 0, 0]},
                {"scale": -1, "translate": [10, 0, 0]}, {"scale": [-1, -1, 1], "translate": [15, 0, 0]},
                {"scale": [-1, 2, 3], "rotateDegrees": [20, 30, 40], "translate": [20, 0, 0]}])");
  for (const pack::Mesh& mesh : baked().meshes) expectOutward(mesh);
}

TEST_F(Bake, TransformsAreScaleThenRotationsAboutXYZThenTranslation) {
  // Returns the transformed corners of a flat, asymmetric mesh.
  folder_.write("flag.obj", "v 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\n");
  scene_["meshes"][0] = {{"name", "flag"}, {"file", "flag.obj"}, {"material", "gold"}, {"flat", true}};
  scene_["origin"] = {0, 0, 0};
  const auto moved = [&](const char* list) {
    instances(list);
    return baked().meshes[0].positions;
  };
  using Points = std::vector<glm::dvec3>;
  EXPECT_EQ(moved("[{}]"), (Points{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}));
  // Counter-clockwise about each axis, seen from its tip; quarter turns are exact.
  EXPECT_EQ(moved(R"([{"rotateDegrees": [90, 0, 0]}])"), (Points{{1, 0, 0}, {0, 0, 2}, {0, -3, 0}}));
  EXPECT_EQ(moved(R"([{"rotateDegrees": [0, 90, 0]}])"), (Points{{0, 0, -1}, {0, 2, 0}, {3, 0, 0}}));
  EXPECT_EQ(moved(R"([{"rotateDegrees": [0, 0, 90]}])"), (Points{{0, 1, 0}, {-2, 0, 0}, {0, 0, 3}}));
  EXPECT_EQ(moved(R"([{"rotateDegrees": [90, 0, 90]}])"), (Points{{0, 1, 0}, {0, 0, 2}, {3, 0, 0}}));  // x first
  EXPECT_EQ(moved(R"([{"scale": [2, 1, 1], "rotateDegrees": [0, 0, 90], "translate": [0, 0, 7]}])"),
            (Points{{0, 2, 7}, {-2, 0, 7}, {0, 0, 10}}));
}

TEST_F(Bake, TheOriginIsTheCentreUnlessGiven) {
  instances(R"([{"translate": [10, 20, 30]}])");
  pack::Scene scene = baked();
  EXPECT_EQ(scene.origin, glm::dvec3(10, 20, 30));
  EXPECT_EQ(centre(scene.meshes[0]), glm::dvec3(0));
  EXPECT_EQ(scene.camera.position, glm::dvec3(-10, -19, -25));
  scene_["origin"] = {10, 20, 29};
  scene_["lights"] = json::parse(R"([{"type": "point", "position": [10, 21, 29], "intensity": [1, 2, 3]}])");
  scene = baked();
  EXPECT_EQ(centre(scene.meshes[0]), glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.lights.at(0).position, glm::dvec3(0, 1, 0));
}

TEST_F(Bake, CamerasByIntrinsics) {
  scene_["camera"].erase("verticalFovDegrees");
  scene_["camera"]["intrinsics"] = {{"fx", 80}, {"fy", 60}, {"cx", 20}, {"cy", 30}};
  const pack::Camera camera = baked().camera;
  // The direction of the point (52, 6) of the image is ((52 - 20) / 80, (30 - 6) / 60, 1) along right, up and forward.
  const double tanY = std::tan(camera.verticalFovDegrees * std::numbers::pi / 360);
  const double x = tanY * (2 * camera.middleX + (2 * 52 / 64.0 - 1) * camera.pixelAspect * 64 / 48),
               y = tanY * (2 * camera.middleY + (1 - 2 * 6 / 48.0));
  EXPECT_NEAR(x, 0.4, 1e-12);
  EXPECT_NEAR(y, 0.4, 1e-12);
  scene_["camera"]["intrinsics"]["fy"] = 1e-3;
  EXPECT_CONTAINS(error(), "camera.intrinsics.fy", "field of view");
  scene_["camera"]["intrinsics"] = {{"fx", 1e5}, {"fy", 60}, {"cx", 0}, {"cy", 0}};
  EXPECT_CONTAINS(error(), "camera.intrinsics.fx");
}

TEST_F(Bake, LargeTranslationsKeepPrecision) {
  // Floats at 1e5 m are 8 mm apart; the cube is 10 cm wide.
  instances(R"([{"scale": 0.1, "translate": [100000.37, -70000.11, 50000.73]}])");
  scene_["camera"]["position"] = {100000.37, -70000.11, 50001.73};
  scene_["camera"]["target"] = {100000.37, -70000.11, 50000.73};
  const pack::Scene scene = baked();
  EXPECT_NEAR(scene.origin.x, 100000.37, 1e-9);
  EXPECT_LT(glm::distance(extent(scene.meshes[0]), glm::dvec3(0.1)), 1e-6);
  EXPECT_LT(glm::distance(scene.camera.position, glm::dvec3(0, 0, 1)), 1e-9);
  expectOutward(scene.meshes[0]);
  const pack::Pack pack = pack::parse(pack::serialize(scene, {}).bytes, "test");
  EXPECT_LT(glm::distance(extent(pack.scene.meshes[0]), glm::dvec3(0.1)), 1e-6);
}

TEST_F(Bake, GlassMustBeCertified) {
  scene_["meshes"][0] = {{"name", "pane"}, {"file", "square.obj"}, {"material", "glass"}};
  const std::string message = error();
  EXPECT_TRUE(contains(message, "square.obj", "pane", "certified", "4 open edges")) << message;
  EXPECT_TRUE(contains(message, "openSurface")) << message;
  scene_["meshes"][0]["fillHoles"] = 4;  // a fold without thickness is not a closed solid
  EXPECT_TRUE(contains(error(), "not certified as glass")) << error();
  scene_["meshes"][0] = {{"name", "cube"}, {"file", "cube.obj"}, {"material", "glass"}};
  EXPECT_EQ(error(), "");
  scene_["meshes"][0] = {{"name", "plate"}, {"file", "square.obj"}, {"material", "gold"}};
  EXPECT_EQ(error(), "");
}

TEST_F(Bake, SingleSidedGlassIsRejected) {
  scene_["meshes"][0] = {{"name", "pane"}, {"file", "square.obj"}, {"material", "glass"}, {"openSurface", true}};
  EXPECT_TRUE(contains(error(), "opposite")) << error();
  folder_.write("slab.obj", std::string(test::kSquareObj) +
                                "v -0.5 -0.1 -0.5\nv 0.5 -0.1 -0.5\nv 0.5 -0.1 0.5\nv -0.5 -0.1 0.5\nf 5 6 7 8\n");
  scene_["meshes"][0]["file"] = "slab.obj";
  EXPECT_EQ(error(), "");
  EXPECT_TRUE(baked().meshes[0].openSurface);
}

TEST_F(Bake, AllowedOpenGlassIsReported) {
  scene_["meshes"][0] = {{"name", "pane"}, {"file", "square.obj"}, {"material", "glass"}};
  const SceneDescription description = readSceneFile(folder_.write("scene.json", scene_.dump()));
  const Baked result = bake(description, {}, kSilent, {true});
  EXPECT_EQ(result.scene.meshes.size(), 1u);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_TRUE(contains(result.notes[0], "pane", "certified")) << result.notes[0];
  // A pack baked with open glass allowed is out of date when it is not allowed.
  EXPECT_NE(makeProvenance(description, {}, {true}), makeProvenance(description, {}, {false}));
}

TEST_F(Bake, SceneSelectsCleaningSteps) {
  folder_.write("groups.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nvn 0 0 1\ns 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
  const auto vertices = [&](const json& more) {
    scene_["meshes"][0] = {{"name", "m"}, {"file", "groups.obj"}, {"material", "gold"}, {"creaseDegrees", 0}};
    scene_["meshes"][0].update(more);
    return baked().meshes[0].positions.size();
  };
  EXPECT_EQ(vertices(json::object()), 6u);
  EXPECT_EQ(vertices({{"normals", "smoothing"}}), 4u);
  EXPECT_EQ(vertices({{"normals", "authored"}}), 4u);
  EXPECT_EQ(baked().meshes[0].normals[2], glm::vec3(0, 0, 1));
  folder_.write("twice.obj", std::string(test::kSquareObj) + "f 4 3 2 1\nf 1 2 3 4\n");
  const auto triangles = [&](const json& more) {
    scene_["meshes"][0] = {{"name", "m"}, {"file", "twice.obj"}, {"material", "gold"}};
    scene_["meshes"][0].update(more);
    return baked().meshes[0].triangles.size();
  };
  EXPECT_EQ(triangles({{"skip", {"duplicates", "fans"}}}), 6u);
  EXPECT_EQ(triangles({{"skip", json::array()}}), 4u);
  scene_["meshes"][0]["skip"] = {"welding"};
  EXPECT_TRUE(contains(error(), "meshes[0].skip", "step", "weld, degenerate")) << error();
  scene_["meshes"][0].erase("skip");
  scene_["meshes"][0]["normals"] = "none";
  EXPECT_TRUE(contains(error(), "'crease', 'smoothing' or 'authored'")) << error();
}

TEST_F(Bake, SimplificationStaysWithinItsBoundAndIsReported) {
  constexpr double kBound = 0.01;
  const prep::Mesh ball = prep::test::sphere(24, 32);
  folder_.write("ball.obj", prep::test::objText(ball));
  scene_["meshes"][0].update({{"file", "ball.obj"}, {"flat", true}, {"simplifyError", kBound}});
  scene_["origin"] = {0, 0, 0};
  const auto bakeBall = [&] { return bake(readSceneFile(folder_.write("scene.json", scene_.dump())), {}, kSilent); };
  const Baked result = bakeBall();

  // The deviation is measured and within the bound; it equals that of `malus prep`.
  ASSERT_EQ(result.reports.size(), 1u);
  const prep::Simplification& s = result.reports[0].simplification;
  const pack::Mesh& mesh = result.scene.meshes[0];
  EXPECT_TRUE(s.applied);
  EXPECT_EQ(s.trianglesBefore, ball.triangles.size());
  EXPECT_EQ(s.trianglesAfter, mesh.triangles.size());
  EXPECT_LT(s.trianglesAfter, s.trianglesBefore * 9 / 10);
  EXPECT_GT(s.maxDeviation, 0);
  EXPECT_LE(s.maxDeviation, kBound);
  EXPECT_GT(s.maxNormalDegrees, 0);
  prep::Options options;
  options.flat = true;
  options.simplify.maxError = kBound;
  prep::Report report;
  prep::prepare(folder_.path() / "ball.obj", options, report);
  EXPECT_EQ(report.simplification.maxDeviation, s.maxDeviation);

  // The centre of a face is as far from the sphere as the bound and the faces of the source permit.
  const auto depth = [](const auto& positions, const glm::uvec3& t) {
    return 1 - glm::length(glm::dvec3(positions[t.x]) + glm::dvec3(positions[t.y]) + glm::dvec3(positions[t.z])) / 3;
  };
  double sourceDepth = 0;
  for (const glm::uvec3& t : ball.triangles) sourceDepth = std::max(sourceDepth, depth(ball.positions, t));
  for (const glm::uvec3& t : mesh.triangles) EXPECT_LT(depth(mesh.positions, t), kBound + 2 * sourceDepth);

  // Text and JSON have it.
  const pack::Written written = pack::serialize(result.scene, {});
  EXPECT_TRUE(contains(bakeText(result, written, "ball.pack", false), "simplified")) << "text";
  const json entry = bakeJson(result, written, "ball.pack").at("preparation").at(0).at("simplification");
  EXPECT_EQ(entry.at("maxDeviation"), s.maxDeviation);
  EXPECT_EQ(entry.at("trianglesAfter"), s.trianglesAfter);
  EXPECT_TRUE(result.notes.empty());

  // A bound that no collapse keeps is a warning.
  scene_["meshes"][0]["simplifyError"] = 1e-12;
  const Baked unchanged = bakeBall();
  EXPECT_EQ(unchanged.scene.meshes[0].triangles.size(), ball.triangles.size());
  ASSERT_EQ(unchanged.notes.size(), 1u);
  EXPECT_TRUE(contains(unchanged.notes[0], "ball.obj") && contains(unchanged.notes[0], "simplify")) << "warning";
}

TEST_F(Bake, FlatMeshesKeepTheirVertices) {
  scene_["meshes"][0]["flat"] = true;
  const pack::Scene scene = baked();
  EXPECT_EQ(scene.vertexCount(), 8u);
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_GT(volume6(scene.meshes[0]), 0);
}

TEST_F(Bake, CameraAxes) {
  scene_["origin"] = {0, 0, 0};
  scene_["camera"]["position"] = {0, 0, 5};
  pack::Camera camera = baked().camera;
  EXPECT_EQ(camera.forward, glm::dvec3(0, 0, -1));
  EXPECT_EQ(camera.right, glm::dvec3(1, 0, 0));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  scene_["camera"]["target"] = {0, 0, 5};
  EXPECT_TRUE(contains(error(), "camera.target"));
  scene_["camera"]["target"] = {0, -3, 5};
  EXPECT_TRUE(contains(error(), "camera.up: is parallel"));
  scene_["camera"]["up"] = {0, 0, 0};
  EXPECT_TRUE(contains(error(), "camera.up"));
}

TEST_F(Bake, EnvironmentImage) {
  image::Image sky;
  sky.width = 8;
  sky.height = 4;
  sky.channels = {"R", "G", "B"};
  sky.pixels.assign(8 * 4 * 3, 0.5f);
  image::writeExr(folder_.path() / "sky.exr", sky);
  scene_["environment"] = {{"image", "sky.exr"}, {"scale", 3}, {"ambientIrradiance", 0.5}};
  const pack::Scene scene = baked();
  EXPECT_EQ(scene.environment.size, 64u);
  EXPECT_EQ(scene.environment.texels.at(0), glm::vec3(1.5f));
  EXPECT_EQ(scene.environment.ambientIrradiance, 0.5);
  scene_["environment"]["image"] = "missing.exr";
  EXPECT_TRUE(contains(error(), "missing.exr: cannot open")) << error();
  scene_["environment"]["image"] = "scene.json";
  EXPECT_TRUE(contains(error(), "scene.json", "image")) << error();
}

TEST_F(Bake, BadMeshesNameTheirFile) {
  scene_["meshes"][0]["file"] = "missing.obj";
  EXPECT_TRUE(contains(error(), "missing.obj")) << error();
  folder_.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  scene_["meshes"][0]["file"] = "nan.obj";
  EXPECT_TRUE(contains(error(), "nan.obj")) << error();
  folder_.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  scene_["meshes"][0]["file"] = "empty.obj";
  EXPECT_TRUE(contains(error(), "empty.obj")) << error();
}

TEST_F(Bake, ProvenanceListsSourcesAndSettings) {
  pack::Scene scene = baked();
  const json provenance = json::parse(scene.provenance);
  ASSERT_EQ(provenance.at("sources").size(), 2u);
  EXPECT_EQ(provenance["sources"][0]["file"], "scene.json");
  EXPECT_EQ(provenance["sources"][1]["file"], "cube.obj");
  EXPECT_TRUE(provenance["settings"]["positionBits"].is_null());
  EXPECT_TRUE(provenance["settings"]["maxError"].is_null());
  EXPECT_EQ(provenance["settings"]["keepMap"], false);
  const std::string before = provenance["sources"][1]["xxh3"];
  EXPECT_EQ(before.size(), 16u);
  folder_.write("cube.obj", std::string(test::kCubeObj) + "# changed\n");
  EXPECT_NE(json::parse(baked().provenance)["sources"][1]["xxh3"], before);
}

TEST_F(Bake, TheSameSourcesGiveTheSameBytes) {
  instances(R"([{"rotateDegrees": [20, 30, 40], "translate": [0.3, 0, 0]}, {"scale": [-1, 1, 1]}])");
  const pack::Written a = pack::serialize(baked(), {}), b = pack::serialize(baked(), {});
  EXPECT_TRUE(a.bytes == b.bytes);
}

TEST_F(Bake, ReportsProgress) {
  const SceneDescription description = readSceneFile(folder_.write("scene.json", scene_.dump()));
  std::vector<std::string> messages;
  const Baked result = bake(description, {}, [&](std::string_view text) { messages.emplace_back(text); });
  EXPECT_EQ(messages, std::vector<std::string>{"preparing cube"});
  ASSERT_EQ(result.reports.size(), 1u);
  EXPECT_EQ(result.reports[0].input.vertices, 8u);
}

TEST_F(Bake, AsIsKeepsDegenerateAndDuplicateTriangles) {
  folder_.write("bad.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "property float nx\nproperty float ny\nproperty float nz\nelement face 3\n"
                "property list uchar int vertex_indices\nend_header\n"
                "0 0 0 0 0 1\n1 0 0 0 0 -1\n0 1 0 1 0 0\n3 0 1 2\n3 0 1 2\n3 0 1 0\n");
  scene_["meshes"][0]["file"] = "bad.ply";
  scene_["meshes"][0]["asIs"] = true;
  const pack::Scene scene = baked();
  const pack::Pack pack = pack::parse(pack::serialize(scene, {}).bytes, "bad");
  ASSERT_EQ(pack.scene.meshes[0].triangles.size(), 3u);
  EXPECT_EQ(pack.scene.meshes[0].triangles, scene.meshes[0].triangles);
  EXPECT_LT(pack.scene.meshes[0].normals[1].z, -0.999f);
  scene_["meshes"][0]["material"] = "glass";
  EXPECT_CONTAINS(error(), "asIs");
  scene_["meshes"][0]["openSurface"] = true;
  EXPECT_EQ(error(), "");
}

TEST_F(Bake, FaintLightIsAWarning) {
  const auto notes = [&] { return bake(readSceneFile(folder_.write("scene.json", scene_.dump())), {}, kSilent).notes; };
  scene_["environment"] = {{"radiance", {1e-40, 0, 0}}};
  ASSERT_EQ(notes().size(), 1u);
  EXPECT_CONTAINS(notes()[0], "environment", "1e-40", "1.2e-38");
  scene_["environment"] = {{"radiance", {1e-25, 0, 1e-40}}};
  EXPECT_TRUE(notes().empty());
  scene_["lights"] = {{{"type", "point"}, {"position", {0, 3, 0}}, {"intensity", {1e-39, 1e-39, 1e-39}}}};
  scene_["materials"]["lamp"] = {{"type", "emitter"}, {"radiance", {0, 1e-35, 0}}};
  scene_["meshes"][0]["material"] = "lamp";
  ASSERT_EQ(notes().size(), 2u);
  EXPECT_CONTAINS(notes()[0], "'lamp'", "1e-35");
  EXPECT_CONTAINS(notes()[1], "light 0", "1e-39");
  scene_["materials"]["lamp"]["radiance"] = {0, 0, 0};
  scene_["lights"] = json::array();
  EXPECT_TRUE(notes().empty());
  // An image: by its mean, after 'scale'.
  image::Image sky{2, 1, {"R", "G", "B"}, {3e-39f, 3e-39f, 3e-39f, 3e-39f, 3e-39f, 3e-39f}, {}, {}};
  image::writeExr(folder_.path() / "sky.exr", sky);
  scene_["environment"] = {{"image", "sky.exr"}};
  ASSERT_EQ(notes().size(), 1u);
  EXPECT_CONTAINS(notes()[0], "environment", "scale");
  scene_["environment"]["scale"] = 1e9;
  EXPECT_TRUE(notes().empty());
}

}  // namespace
}  // namespace malus::bake

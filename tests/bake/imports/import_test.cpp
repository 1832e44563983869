// Imports of whole files: glTF with all features, OBJ with materials.
#include "bake/imports/import.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;

constexpr auto kSilent = [](std::string_view) {};

// A cube from 0 to 1, facing outward.
prep::Mesh unitCube() {
  prep::Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

class Import : public testing::Test {
 protected:
  void SetUp() override {
    // Metal, glass, an emitter; the metal mesh twice, once mirrored, below a translated parent.
    gltf_.document["materials"] = {
        {{"name", "steel"},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"roughnessFactor", 0.0}}}},
        {{"name", "water"},
         {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.0}}},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 1.0}, {"attenuationDistance", 2.0}, {"attenuationColor", {0.25, 1, 1}}}}}}},
        {{"name", "lamp"},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}}}}}};
    gltf_.document["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume",
                                        "KHR_materials_emissive_strength"};
    for (const int material : {0, 1, 2})
      gltf_.addMesh(unitCube(), ("mesh" + std::to_string(material)).c_str(), material);
    const int left = gltf_.add("nodes", {{"name", "left"}, {"mesh", 0}});
    const int right =
        gltf_.add("nodes", {{"name", "right"}, {"mesh", 0}, {"scale", {-1, 1, 1}}, {"translation", {5, 0, 0}}});
    gltf_.addNode({{"name", "group"}, {"children", {left, right}}, {"translation", {0, 10, 0}}});
    gltf_.addNode({{"name", "pool"}, {"mesh", 1}, {"translation", {0, 0, 8}}});
    gltf_.addNode({{"name", "bulb"}, {"mesh", 2}, {"translation", {0, 0, -8}}});
    folder_.write("model.glb", gltf_.glb());
    scene_ = json::parse(R"({
      "malus": 1, "name": "test", "origin": [0, 0, 0],
      "camera": {"position": [0, 1, 50], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"gold": {"type": "metal", "preset": "gold"}},
      "imports": [{"file": "model.glb"}]})");
  }
  SceneDescription description() { return readSceneFile(folder_.write("scene.json", scene_.dump())); }
  Baked baked(const BakeOptions& options = {}) { return bake(description(), {}, kSilent, options); }
  std::string error() {
    return errorMessage([&] { baked(); });
  }

  test::TemporaryFolder folder_;
  prep::test::GltfFile gltf_;
  json scene_;
};

const pack::Mesh& named(const pack::Scene& scene, std::string_view name) {
  return *std::find_if(scene.meshes.begin(), scene.meshes.end(), [&](const pack::Mesh& m) { return m.name == name; });
}

double volume(const pack::Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles)
    sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
  return sum;
}

std::pair<glm::dvec3, glm::dvec3> box(const pack::Mesh& mesh) {
  glm::dvec3 low = mesh.positions[0], high = low;
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return {low, high};
}

TEST_F(Import, InstancesAndMaterials) {
  const Baked result = baked();
  const pack::Scene& scene = result.scene;
  ASSERT_EQ(scene.meshes.size(), 4u);
  EXPECT_EQ(box(named(scene, "left")), std::pair(glm::dvec3(0, 10, 0), glm::dvec3(1, 11, 1)));
  EXPECT_EQ(box(named(scene, "right")), std::pair(glm::dvec3(4, 10, 0), glm::dvec3(5, 11, 1)));
  EXPECT_EQ(box(named(scene, "pool")), std::pair(glm::dvec3(0, 0, 8), glm::dvec3(1, 1, 9)));
  for (const pack::Mesh& mesh : scene.meshes) EXPECT_NEAR(volume(mesh), 1, 1e-4) << mesh.name;  // faces outward
  ASSERT_EQ(scene.materials.size(), 4u);
  EXPECT_EQ(scene.materials[0].name, "gold");
  const auto material = [&](std::string_view mesh) { return scene.materials[named(scene, mesh).material]; };
  EXPECT_EQ(material("left").name, "steel");
  EXPECT_EQ(material("right").name, "steel");
  EXPECT_EQ(material("left").kind, pack::MaterialKind::metal);
  EXPECT_EQ(material("pool").kind, pack::MaterialKind::glass);
  EXPECT_EQ(material("pool").eta, glm::dvec3(1.33));
  EXPECT_NEAR(material("pool").absorption.x, std::log(4.0) / 2, 1e-6);
  EXPECT_EQ(material("bulb").kind, pack::MaterialKind::emitter);
  EXPECT_EQ(material("bulb").radiance, glm::dvec3(8, 4, 0));
  EXPECT_EQ(result.reports.size(), 3u);  // one per part
  // A pack stores the whole import.
  const pack::Pack again = pack::parse(pack::serialize(scene, {}).bytes, "test");
  EXPECT_EQ(again.scene.meshes.size(), 4u);
}

TEST_F(Import, SurfacesWithoutAlphaAreNotDrawn) {
  json& steel = gltf_.document["materials"][0];
  steel["alphaMode"] = "MASK";
  steel["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 0.25};
  folder_.write("model.glb", gltf_.glb());
  const Baked result = baked();
  EXPECT_EQ(result.scene.meshes.size(), 2u);
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(),
                          [](const std::string& note) { return contains(note, "invisible", "(2)"); }));
  // The scene's own material is drawn.
  scene_["imports"][0]["materials"] = {{"steel", "gold"}};
  EXPECT_EQ(baked().scene.meshes.size(), 4u);
  scene_["imports"][0].erase("materials");
  for (json& material : gltf_.document["materials"])
    material.update({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0}}}}});
  folder_.write("model.glb", gltf_.glb());
  EXPECT_CONTAINS(error(), "model.glb", "invisible");
}

TEST_F(Import, AppliesMaterialsAndTransformOfTheScene) {
  scene_["imports"][0]["materials"] = {{"steel", "gold"}};
  scene_["imports"][0]["transform"] = {{"scale", 2}, {"translate", {0, 0, 1}}};
  const pack::Scene scene = baked().scene;
  EXPECT_EQ(scene.materials[named(scene, "left").material].name, "gold");
  EXPECT_EQ(box(named(scene, "left")), std::pair(glm::dvec3(0, 20, 1), glm::dvec3(2, 22, 3)));
  scene_["imports"][0]["materials"] = {{"stel", "gold"}};
  EXPECT_TRUE(contains(error(), "model.glb", "material 'stel'")) << error();
  scene_["imports"][0]["materials"] = {{"steel", "glod"}};
  EXPECT_TRUE(contains(error(), "imports[0].materials.steel", "'glod'", "'gold'")) << error();
}

TEST_F(Import, NamesAreUnique) {
  scene_["materials"]["steel"] = {{"type", "metal"}, {"preset", "chromium"}};
  scene_["imports"].push_back({{"file", "model.glb"}});
  const pack::Scene scene = baked({true}).scene;  // the glass is given twice
  EXPECT_EQ(scene.meshes.size(), 8u);
  EXPECT_EQ(scene.materials[named(scene, "left").material].name, "steel.2");
  EXPECT_EQ(scene.materials[named(scene, "left.2").material].name, "steel.3");
}

TEST_F(Import, GlassMustBeCertified) {
  prep::Mesh open = unitCube();
  open.triangles.pop_back();
  gltf_.addMesh(open, "open", 1);
  gltf_.addNode({{"name", "broken"}, {"mesh", 3}, {"translation", {20, 0, 0}}});
  folder_.write("model.glb", gltf_.glb());
  EXPECT_TRUE(contains(error(), "'broken'", "certified", "3 open edges")) << error();
  EXPECT_EQ(baked({true}).notes.size(), 1u);
  scene_["imports"][0]["openSurfaces"] = {"brocken"};
  EXPECT_TRUE(contains(error(), "'brocken'")) << error();
  scene_["imports"][0]["materials"] = {{"water", "gold"}};
  scene_["imports"][0].erase("openSurfaces");
  EXPECT_EQ(error(), "");
}

TEST_F(Import, KeepsNormalsOfTheFile) {
  prep::test::GltfFile gltf;
  prep::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  gltf.addMesh(mesh, "tilted");
  const glm::vec3 tilted(0.6f, 0, 0.8f);
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = gltf.addVectors({tilted, tilted, tilted});
  gltf.addNode({{"mesh", 0}});
  folder_.write("model.glb", gltf.glb());
  EXPECT_EQ(baked().scene.meshes[0].normals[1], tilted);
  scene_["imports"][0]["normals"] = "crease";
  EXPECT_EQ(baked().scene.meshes[0].normals[1], glm::vec3(0, 0, 1));
  scene_["imports"][0]["flat"] = true;
  EXPECT_TRUE(baked().scene.meshes[0].normals.empty());
}

TEST_F(Import, ObjReadsItsMaterialFile) {
  folder_.write("two parts.obj",
                "mtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl mirror\nf 1 2 3\nusemtl "
                "l\xc3\xa4mpchen 1\nf 1 2 4\n");
  folder_.write("my materials.mtl",
                "newmtl mirror\nKd 0 0 0\nKs 0.9 0.9 0.9\nNs 100000\nnewmtl l\xc3\xa4mpchen 1\nKe 3 2 1\n");
  scene_["imports"][0] = {{"file", "two parts.obj"}};
  const Baked result = baked();
  ASSERT_EQ(result.scene.meshes.size(), 2u);
  EXPECT_EQ(result.scene.materials[named(result.scene, "mirror").material].kind, pack::MaterialKind::metal);
  EXPECT_EQ(result.scene.materials[named(result.scene, "l\xc3\xa4mpchen 1").material].radiance, glm::dvec3(3, 2, 1));
  EXPECT_TRUE(result.notes.empty());

  // Source indices refer to the file, not to the part.
  pack::WriteSettings keep;
  keep.keepMap = true;
  const pack::Scene mapped = bake(description(), keep, kSilent).scene;
  EXPECT_EQ(named(mapped, "mirror").sourceFaces, std::vector<std::uint32_t>{0});
  EXPECT_EQ(named(mapped, "l\xc3\xa4mpchen 1").sourceFaces, std::vector<std::uint32_t>{1});
  EXPECT_EQ(named(mapped, "l\xc3\xa4mpchen 1").sourceVertices, (std::vector<std::uint32_t>{0, 1, 3}));

  // Referenced files are listed as sources.
  const std::string before = makeProvenance(description(), {});
  folder_.write("my materials.mtl", "newmtl mirror\nKd 0.5 0.5 0.5\n");
  EXPECT_NE(makeProvenance(description(), {}), before);
  EXPECT_EQ(baked().notes.size(), 1u);  // a material without a description
}

TEST_F(Import, ReadsObjWithHabitsOfExporters) {
  // CR line ends, comments, a backslash in a file name, empty slots, a face of two corners, d against Tr.
  std::filesystem::create_directories(folder_.path() / "sub");
  folder_.write("sub/in.mtl", "newmtl grey # matt\rKd 0.25 0.25 0.25#\rd 1.0\rTr 1.0\r");
  folder_.write("habits.obj",
                "mtllib sub\\in.mtl # colours\rusemtl grey#1\rv 0 0 0 .5 .5 .5 1 # a\rv 1 0 0\rv 0 1 0\rv 1 1 0\r"
                "f 1/ 2/ 3//#b\rf 1 2\rf 2 4 3");
  scene_["imports"][0] = {{"file", "habits.obj"}};
  const Baked result = baked();
  ASSERT_EQ(result.scene.meshes.size(), 1u);
  EXPECT_EQ(result.scene.meshes[0].triangles.size(), 2u);
  const pack::Material& material = result.scene.materials[result.scene.meshes[0].material];
  EXPECT_EQ(material.kind, pack::MaterialKind::lambert);
  EXPECT_EQ(material.albedo, glm::dvec3(0.25));
  for (const char* part : {"CR line ends", "comments", "backslashes", "empty slots", "fewer than three", "contradicts",
                           "colours of vertices", "described as"})
    EXPECT_EQ(std::count_if(result.notes.begin(), result.notes.end(),
                            [&](const std::string& note) { return contains(note, part); }),
              1)
        << part;
}

TEST_F(Import, PrintsNotesBeforeAnError) {
  // "d 0" and "Tr 0" contradict each other. The open face is glass by d, and not certified.
  folder_.write("a.mtl", "newmtl a\nd 0\nTr 0\n");
  folder_.write("a.obj", "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  scene_["imports"][0] = {{"file", "a.obj"}};
  testing::internal::CaptureStderr();
  EXPECT_CONTAINS(error(), "not certified");
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "warning", "contradicts");
}

TEST_F(Import, SimplifiesEveryPart) {
  const prep::Mesh ball = prep::test::sphere(15, 20);
  std::string text = prep::test::objText(ball);
  text.insert(text.find("f "), "usemtl a\n");
  const auto offset = ball.positions.size();
  for (const glm::dvec3& p : ball.positions) text += fmt::format("v {} {} {}\n", p.x + 3, p.y, p.z);
  text += "usemtl b\n";
  for (const glm::uvec3& t : ball.triangles)
    text += fmt::format("f {} {} {}\n", t.x + offset + 1, t.y + offset + 1, t.z + offset + 1);
  folder_.write("balls.obj", text);
  scene_["imports"][0] = {
      {"file", "balls.obj"}, {"materials", {{"a", "gold"}, {"b", "gold"}}}, {"simplifyTriangles", 400}};
  const Baked result = baked();
  ASSERT_EQ(result.scene.meshes.size(), 2u);
  for (const pack::Mesh& mesh : result.scene.meshes) {
    EXPECT_LE(mesh.triangles.size(), 400u) << mesh.name;
    EXPECT_GT(mesh.triangles.size(), 300u) << mesh.name;
  }
  for (const prep::Report& report : result.reports) EXPECT_GT(report.simplification.maxDeviation, 0);

  // The normals of a file do not fit a simplified mesh.
  scene_["imports"][0] = {{"file", "tilted.ply"}, {"simplifyTriangles", 1}};
  folder_.write("tilted.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
                "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  EXPECT_TRUE(contains(error(), "tilted.ply") && contains(error(), "normals")) << error();
  scene_["imports"][0]["normals"] = "crease";
  EXPECT_EQ(error(), "");
}

TEST_F(Import, LeavesOutPartsThatCannotBePrepared) {
  // A mesh of points, placed twice, and a primitive with an invalid index.
  prep::Mesh dot;
  dot.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  dot.triangles = {{0, 1, 2}};
  const int mesh = gltf_.addMesh(dot, "dot", 0);
  gltf_.addNode({{"name", "dot a"}, {"mesh", mesh}});
  gltf_.addNode({{"name", "dot b"}, {"mesh", mesh}});
  const int broken = gltf_.addMesh(unitCube(), "broken", 0);
  gltf_.document["meshes"][broken]["primitives"][0]["indices"] = 99;
  gltf_.addNode({{"name", "broken"}, {"mesh", broken}});
  folder_.write("model.glb", gltf_.glb());
  const Baked result = baked();
  EXPECT_EQ(result.scene.meshes.size(), 4u);
  const auto count = [&](std::string_view part) {
    return std::count_if(result.notes.begin(), result.notes.end(),
                         [&](const std::string& note) { return contains(note, "left out") && contains(note, part); });
  };
  EXPECT_EQ(count("part 'dot': no triangle is left"), 1);
  EXPECT_EQ(count("accessors[99]"), 1);
  EXPECT_CONTAINS(errorMessage([&] { baked({.strict = true}); }), "accessors[99]");
  gltf_.document["nodes"].back()["mesh"] = 0;
  folder_.write("model.glb", gltf_.glb());
  EXPECT_CONTAINS(errorMessage([&] { baked({.strict = true}); }), "part 'dot'", "no triangle is left");

  // It is an error if nothing is left.
  gltf_.document["scenes"] = {{{"nodes", {gltf_.document["nodes"].size() - 3}}}};
  folder_.write("model.glb", gltf_.glb());
  EXPECT_CONTAINS(error(), "part 'dot'", "no triangle is left");
}

TEST_F(Import, UnsupportedFeaturesAreReported) {
  gltf_.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  gltf_.addNode({{"name", "lens"}, {"camera", 0}});
  gltf_.document["animations"] = {{{"name", "run"}, {"channels", json::array()}, {"samplers", json::array()}}};
  folder_.write("model.glb", gltf_.glb());
  const std::vector<std::string> notes = baked().notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& n) {
    return contains(n, "left out: anim", "(1: 'run'", "cameras (1: 'lens')");
  })) << notes[0];
}

TEST_F(Import, ASceneNeedsMeshesOrImports) {
  scene_.erase("imports");
  EXPECT_TRUE(contains(error(), "meshes")) << error();
  scene_["meshes"] = {{{"name", "all"}, {"file", "model.glb"}, {"material", "gold"}}};
  const pack::Scene scene = baked().scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_NEAR(volume(scene.meshes[0]), 4, 1e-4);
}

}  // namespace
}  // namespace malus::bake

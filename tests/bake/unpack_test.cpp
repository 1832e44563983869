// Unpacking: the files contain the numbers of the pack.
#include "bake/unpack.h"

#include <cstring>

#include "bake/pack/writer.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/image.h"
#include "meshprep/read/read_mesh.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;

TEST(Unpack, WritesTheContentsOfThePack) {
  const test::TemporaryFolder folder;
  const pack::Pack pack = pack::parse(pack::serialize(test::smallScene(), {}).bytes, "small");
  const json document = unpack(pack, folder.path() / "out");
  EXPECT_EQ(json::parse(readTextFile(folder.path() / "out/scene.json")), document);

  const pack::Scene& scene = pack.scene;
  EXPECT_EQ(document.at("origin"), json({1e5, -2, 3.25}));
  EXPECT_EQ(document.at("camera").at("mediumEta"), 1.33);
  EXPECT_EQ(document.at("lights").size(), 2u);
  EXPECT_EQ(document.at("materials")[1].at("highlight").at("exponent"), 200);
  EXPECT_TRUE(document.at("materials")[0].at("highlight").is_null());
  EXPECT_EQ(document.at("environment").at("size"), 2);

  const image::Image sky = image::read(folder.path() / "out/environment.exr");
  ASSERT_EQ(sky.width, 4);
  ASSERT_EQ(sky.height, 4);
  for (std::size_t i = 0; i < scene.environment.texels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(sky.pixels[i * 3 + c], scene.environment.texels[i][static_cast<int>(c)]);

  // The PLY files, read by meshprep.
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const pack::Mesh& mesh = scene.meshes[i];
    const json& entry = document.at("meshes")[i];
    EXPECT_EQ(entry.at("material"), scene.materials[mesh.material].name);
    const prep::Polygons read = prep::readMesh(folder.path() / "out" / entry.at("file").get<std::string>());
    ASSERT_EQ(read.positions.size(), mesh.positions.size());
    ASSERT_EQ(read.normals.size(), mesh.normals.size());
    ASSERT_EQ(read.faceCount(), mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) EXPECT_EQ(read.positions[v], mesh.positions[v]);
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) EXPECT_EQ(read.normals[v], mesh.normals[v]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(read.face(t)[static_cast<std::size_t>(k)], mesh.triangles[t][k]);
  }
}

TEST(Unpack, WritesTextureCoordinatesAndTangents) {
  const test::TemporaryFolder folder;
  const pack::Pack pack = pack::parse(pack::serialize(test::unusualScene(), {}).bytes, "unusual");
  unpack(pack, folder.path() / "out");
  const pack::Mesh& mesh = pack.scene.meshes[0];
  const std::string text = readTextFile(folder.path() / "out/meshes/000.ply"), end = "end_header\n";
  EXPECT_CONTAINS(text, "float s\n", "float t1\n", "float tw\n");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    float numbers[14];  // x y z, nx ny nz, s t, s1 t1, tx ty tz tw
    std::memcpy(numbers, text.data() + text.find(end) + end.size() + v * sizeof numbers, sizeof numbers);
    EXPECT_EQ(numbers[3], mesh.normals[v].x);
    EXPECT_EQ(glm::vec2(numbers[6], numbers[7]), mesh.textureCoordinates[0][v]);
    EXPECT_EQ(glm::vec2(numbers[8], numbers[9]), mesh.textureCoordinates[1][v]);
    EXPECT_EQ(glm::vec4(numbers[10], numbers[11], numbers[12], numbers[13]), mesh.tangents[v]);
  }
  EXPECT_EQ(prep::readMesh(folder.path() / "out/meshes/000.ply").positions, mesh.positions);
}

TEST(Unpack, WritesTheMapsOfMaterials) {
  const test::TemporaryFolder folder;
  const pack::Pack pack = pack::parse(pack::serialize(test::mappedScene(), {}).bytes, "mapped");
  const json document = unpack(pack, folder.path() / "out");
  for (std::size_t i = 0; i < pack.scene.materials.size(); ++i)
    EXPECT_EQ(document.at("materials")[i].contains("meshMaps"), pack.scene.materials[i].meshMaps.any());
  const json maps = document.at("materials")[1].at("meshMaps");
  EXPECT_EQ(maps.at("albedo"), json({{"texture", 0},
                                     {"set", 1},
                                     {"wrapU", "clamp"},
                                     {"wrapV", "mirror"},
                                     {"u", {1.0, 2.0, 3.0}},
                                     {"v", {-4.0, 5.0, 6.0}}}));
  EXPECT_EQ(maps.at("normal").at("wrapU"), "repeat");
  EXPECT_EQ(maps.at("normalScale"), -2);
  EXPECT_EQ(maps.at("cutoff"), 0.25);
  EXPECT_FALSE(maps.contains("roughness"));  // no map
}

TEST(Unpack, WritesTheSourceMapIfStored) {
  const test::TemporaryFolder folder;
  pack::WriteSettings settings;
  settings.keepMap = true;
  const pack::Pack pack = pack::parse(pack::serialize(test::smallScene(), settings).bytes, "small");
  const json document = unpack(pack, folder.path() / "out");
  for (std::size_t i = 0; i < 2; ++i) {
    const json map = json::parse(readTextFile(folder.path() / "out" / document.at("meshes")[i].at("map")));
    EXPECT_EQ(map.at("vertices"), json(pack.scene.meshes[i].sourceVertices));
    EXPECT_EQ(map.at("triangles"), json(pack.scene.meshes[i].sourceFaces));
    EXPECT_EQ(map.at("vertices").size(), 4u);
  }
}

TEST(Unpack, InvalidFolderIsNamed) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("taken", "");
  const pack::Pack pack = pack::parse(pack::serialize(test::smallScene(), {}).bytes, "small");
  EXPECT_CONTAINS(test::errorMessage([&] { unpack(pack, file); }), "taken");
}

}  // namespace
}  // namespace malus::bake

// Scenes of model files: OBJ grouped by material, other formats as one part.
#include "meshprep/read/source_scene.h"

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::TemporaryFile;

// Two triangles of "red", one of "blue" between them, one of no material; the last vertex is of no face.
Polygons fourFaces() {
  Polygons p;
  for (int i = 0; i < 7; ++i) p.positions.emplace_back(i, i * i, 0);
  p.corners = {0, 1, 2, 1, 2, 3, 3, 4, 5, 0, 2, 4, 5};
  p.firstCorner = {0, 3, 6, 9, 13};
  p.parts = {{"body", "red"}, {"", "blue"}, {"cover", "red"}, {"cover", ""}};
  p.partOf = {0, 1, 2, 3};
  p.smoothingGroups = {1, 2, 3, 4};
  for (std::size_t c = 0; c < p.corners.size(); ++c) p.cornerNormals.emplace_back(c, 0, 1);
  p.faceLocations = {10, 20, 30, 40};
  p.vertexLocations = {1, 2, 3, 4, 5, 6, 7};
  p.notes = {"lines"};
  return p;
}

TEST(SourceScene, GroupsFacesByMaterial) {
  const SourceScene scene = splitByMaterial(fourFaces());
  ASSERT_EQ(scene.parts.size(), 3u);
  ASSERT_EQ(scene.instances.size(), 3u);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "red");
  EXPECT_EQ(scene.notes, std::vector<std::string>{"lines"});
  const Polygons& red = scene.parts[0].polygons;
  EXPECT_EQ(scene.parts[0].name, "red");
  EXPECT_EQ(scene.parts[0].material, 0u);
  EXPECT_EQ(red.positions.size(), 6u);
  EXPECT_EQ(red.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(red.smoothingGroups, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(red.faceLocations, (std::vector<std::uint64_t>{10, 30}));
  EXPECT_EQ(red.cornerNormals[3], glm::vec3(6, 0, 1));
  const Polygons& blue = scene.parts[1].polygons;
  EXPECT_EQ(blue.positions, (std::vector<glm::dvec3>{{1, 1, 0}, {2, 4, 0}, {3, 9, 0}}));
  EXPECT_EQ(blue.vertexLocations, (std::vector<std::uint64_t>{2, 3, 4}));
  EXPECT_FALSE(scene.parts[2].material.has_value());
  EXPECT_EQ(scene.parts[2].polygons.face(0).size(), 4u);
}

TEST(SourceScene, KeepsPolygonsOfASinglePart) {
  Polygons p = fourFaces();
  p.parts = {{"a", "red"}, {"b", "red"}};
  p.partOf = {0, 1, 0, 1};
  const SourceScene scene = splitByMaterial(p);
  ASSERT_EQ(scene.parts.size(), 1u);
  EXPECT_EQ(scene.parts[0].polygons.positions.size(), 7u);
  const TemporaryFile file(".obj", test::objText(test::cube()));
  const SourceScene cube = readSourceScene(file.path());
  ASSERT_EQ(cube.parts.size(), 1u);
  EXPECT_EQ(cube.parts[0].name, file.path().stem().string());
  EXPECT_EQ(cube.parts[0].polygons.faceCount(), 12u);
  EXPECT_TRUE(cube.notes.empty());
}

TEST(SourceScene, MergesInstancesAsParts) {
  SourceScene scene = splitByMaterial(fourFaces());
  scene.instances[1].worldFromObject[3] = {0, 0, 9, 1};
  scene.instances.push_back(scene.instances[1]);
  const Polygons whole = mergeInstances(scene);
  EXPECT_EQ(whole.faceCount(), 5u);
  EXPECT_EQ(whole.positions.size(), 6u + 3 + 4 + 3);
  EXPECT_EQ(whole.partOf, (std::vector<std::uint32_t>{0, 0, 1, 2, 3}));
  EXPECT_EQ(whole.parts[3], (Part{"blue", "blue"}));
  EXPECT_EQ(whole.positions[whole.face(4)[0]], glm::dvec3(1, 1, 9));
}

TEST(SourceScene, ListsReferencedFiles) {
  const TemporaryFile file(".obj", "mtllib a b.mtl\n" + test::objText(test::cube()));
  const std::filesystem::path folder = file.path().parent_path();
  EXPECT_EQ(referencedFiles(file.path()), (std::vector{folder / "a", folder / "b.mtl"}));
  const TemporaryFile mtl(".mtl", "newmtl a\n");
  const std::string name = mtl.path().filename().string();
  const TemporaryFile one(".obj", "mtllib " + name + "\n" + test::objText(test::cube()));
  EXPECT_EQ(referencedFiles(one.path()), std::vector{mtl.path()});
  const TemporaryFile other(".off", "mtllib a.mtl\n");
  EXPECT_TRUE(referencedFiles(other.path()).empty());
}

}  // namespace
}  // namespace malus::prep

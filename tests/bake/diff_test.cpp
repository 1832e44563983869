// Differences between two packs.
#include "bake/diff.h"

#include <algorithm>
#include <map>

#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;

pack::Pack writeAndParse(const pack::Scene& scene) { return pack::parse(pack::serialize(scene, {}).bytes, "test"); }

json findChanges(const pack::Scene& a, const pack::Scene& b) {
  const json difference = diffJson(writeAndParse(a), writeAndParse(b));
  EXPECT_FALSE(difference.at("equal"));
  return difference.at("changes");
}

// Returns the names of the changed fields in order.
std::vector<std::string> changedFields(const json& changes) {
  std::vector<std::string> names;
  for (const json& c : changes) names.push_back(c.at("where"));
  return names;
}

TEST(Diff, EqualPacksAreEqual) {
  const json difference = diffJson(writeAndParse(test::unusualScene()), writeAndParse(test::unusualScene()));
  EXPECT_TRUE(difference.at("equal"));
  EXPECT_TRUE(difference.at("sections").empty());
  EXPECT_TRUE(difference.at("changes").empty());
  EXPECT_CONTAINS(diffText(difference), "equal");
}

TEST(Diff, ReportsSourceMaps) {
  pack::WriteSettings settings;
  settings.keepMap = true;
  pack::Scene scene = test::smallScene();
  const pack::Pack with = pack::parse(pack::serialize(scene, settings).bytes, "with"), without = writeAndParse(scene);
  const json difference = diffJson(without, with);
  EXPECT_TRUE(std::any_of(difference["sections"].begin(), difference["sections"].end(), [](const json& s) {
    return s.at("id") == "SMAP" && s.at("change") == "only in the second";
  }));
  EXPECT_CONTAINS(diffText(difference), "sourceMap.tetrahedron: \"not kept\" -> \"kept\"");
  scene.meshes[0].sourceVertices = {4, 5, 6, 7};
  EXPECT_CONTAINS(diffText(diffJson(with, pack::parse(pack::serialize(scene, settings).bytes, "other"))),
                  "sourceMap.tetrahedron", "\"kept\" -> \"other");
}

TEST(Diff, NamesWhatChanged) {
  const pack::Scene a = test::smallScene();
  pack::Scene b = a;
  b.materials[1].eta.y = 0.6;
  b.exposureEv = 1;
  b.lights.pop_back();
  b.effects[0].on = false;
  const json changes = findChanges(a, b);
  EXPECT_EQ(changedFields(changes),
            (std::vector<std::string>{"effects.metal.on", "exposureEv", "lights.1.intensity.0", "lights.1.intensity.1",
                                      "lights.1.intensity.2", "lights.1.position.0", "lights.1.position.1",
                                      "lights.1.position.2", "lights.1.type", "materials.gold.eta.1"}));
  EXPECT_EQ(changes.back().at("a"), 0.5439);
  EXPECT_EQ(changes.back().at("b"), 0.6);
  const json difference = diffJson(writeAndParse(a), writeAndParse(b));
  std::vector<std::string> ids;
  for (const json& s : difference.at("sections")) ids.push_back(s.at("id"));
  EXPECT_EQ(ids, (std::vector<std::string>{"META", "LGHT", "MATL", "EFCT"}));
  const std::string text = diffText(difference);
  EXPECT_CONTAINS(text, "materials.gold.eta.1: 0.5439 -> 0.6");
  EXPECT_CONTAINS(text, "LGHT  changed");
}

TEST(Diff, NamesTheMapsThatChanged) {
  const pack::Scene a = test::mappedScene();
  pack::Scene b = a;
  b.materials[1].meshMaps.albedo.wrapU = pack::Wrap::mirror;
  b.materials[1].meshMaps.normalScale = 3;
  const std::string name = "materials." + a.materials[1].name + ".meshMaps.";
  EXPECT_EQ(changedFields(findChanges(a, b)), (std::vector<std::string>{name + "albedo.wrapU", name + "normalScale"}));
}

TEST(Diff, MeshesAreMatchedByName) {
  const pack::Scene a = test::smallScene();
  pack::Scene b = a;
  b.meshes[1].positions[2] = {3, 0.75f, 0};
  json changes = findChanges(a, b);
  ASSERT_EQ(changedFields(changes), std::vector<std::string>{"geometry.sheet"});
  EXPECT_CONTAINS(changes[0].at("b").get<std::string>(), "corners", "0.25 m");
  b = a;
  std::swap(b.meshes[0], b.meshes[1]);  // another order changes sections only
  EXPECT_TRUE(findChanges(a, b).empty());
  b.meshes.pop_back();
  for (const std::string& name : changedFields(findChanges(a, b)))
    EXPECT_TRUE(name.starts_with("meshes.tetrahedron.") || name.starts_with("encoding.tetrahedron") ||
                name == "geometry.sheet")  // quantized on another grid
        << name;
}

TEST(Diff, SectionsOfOnePackOnly) {
  const json difference = diffJson(writeAndParse(test::smallScene()), writeAndParse(test::unusualScene()));
  std::map<std::string, std::string> sections;
  for (const json& s : difference.at("sections")) sections[s.at("id")] = s.at("change");
  for (const char* id : {"SRFX", "TEXR", "SKYP"}) EXPECT_EQ(sections[id], "only in the second") << id;
  const std::vector<std::string> names = changedFields(difference.at("changes"));
  EXPECT_NE(std::find(names.begin(), names.end(), "environment.sky.maxDegree"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "materials.gold.roughness"), names.end());
}

}  // namespace
}  // namespace malus::bake

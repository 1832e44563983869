// Differences between two packs.
#include "bake/diff.h"

#include <algorithm>
#include <map>

#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;

pack::Pack packOf(const pack::Scene& scene) { return pack::parse(pack::serialize(scene, {}).bytes, "test"); }

json changesOf(const pack::Scene& a, const pack::Scene& b) {
  const json difference = diffJson(packOf(a), packOf(b));
  EXPECT_FALSE(difference.at("equal"));
  return difference.at("changes");
}

// Places of the changes, in their order.
std::vector<std::string> placesOf(const json& changes) {
  std::vector<std::string> places;
  for (const json& c : changes) places.push_back(c.at("where"));
  return places;
}

TEST(Diff, EqualPacksAreEqual) {
  const json difference = diffJson(packOf(test::unusualScene()), packOf(test::unusualScene()));
  EXPECT_TRUE(difference.at("equal"));
  EXPECT_TRUE(difference.at("sections").empty());
  EXPECT_TRUE(difference.at("changes").empty());
  EXPECT_EQ(diffText(difference), "the packs are equal\n");
}

TEST(Diff, TellsAMapToTheSource) {
  pack::WriteSettings settings;
  settings.keepMap = true;
  pack::Scene scene = test::smallScene();
  const pack::Pack with = pack::parse(pack::serialize(scene, settings).bytes, "with"), without = packOf(scene);
  const json difference = diffJson(without, with);
  EXPECT_TRUE(std::any_of(difference["sections"].begin(), difference["sections"].end(), [](const json& s) {
    return s.at("id") == "SMAP" && s.at("change") == "only in the second";
  }));
  EXPECT_CONTAINS(diffText(difference), "sourceMap.tetrahedron: \"not kept\" -> \"kept\"");
  scene.meshes[0].sourceVertices = {4, 5, 6, 7};
  EXPECT_CONTAINS(diffText(diffJson(with, pack::parse(pack::serialize(scene, settings).bytes, "other"))),
                  "sourceMap.tetrahedron: \"kept\" -> \"other vertices or faces\"");
}

TEST(Diff, NamesWhatChanged) {
  const pack::Scene a = test::smallScene();
  pack::Scene b = a;
  b.materials[1].eta.y = 0.6;
  b.exposureEv = 1;
  b.lights.pop_back();
  b.effects[0].on = false;
  const json changes = changesOf(a, b);
  EXPECT_EQ(placesOf(changes),
            (std::vector<std::string>{"effects.metal.on", "exposureEv", "lights.1.intensity.0", "lights.1.intensity.1",
                                      "lights.1.intensity.2", "lights.1.position.0", "lights.1.position.1",
                                      "lights.1.position.2", "lights.1.type", "materials.gold.eta.1"}));
  EXPECT_EQ(changes.back().at("a"), 0.5439);
  EXPECT_EQ(changes.back().at("b"), 0.6);
  const json difference = diffJson(packOf(a), packOf(b));
  std::vector<std::string> ids;
  for (const json& s : difference.at("sections")) ids.push_back(s.at("id"));
  EXPECT_EQ(ids, (std::vector<std::string>{"META", "LGHT", "MATL", "EFCT"}));
  const std::string text = diffText(difference);
  EXPECT_CONTAINS(text, "materials.gold.eta.1: 0.5439 -> 0.6");
  EXPECT_CONTAINS(text, "LGHT  changed");
}

TEST(Diff, MeshesAreToldByName) {
  const pack::Scene a = test::smallScene();
  pack::Scene b = a;
  b.meshes[1].positions[2] = {3, 0.75f, 0};
  json changes = changesOf(a, b);
  ASSERT_EQ(placesOf(changes), std::vector<std::string>{"geometry.sheet"});
  EXPECT_CONTAINS(changes[0].at("b").get<std::string>(), "corners moved by up to 0.25 m");
  b = a;
  std::swap(b.meshes[0], b.meshes[1]);  // the order alone: no change but of sections
  EXPECT_TRUE(changesOf(a, b).empty());
  b.meshes.pop_back();
  for (const std::string& place : placesOf(changesOf(a, b)))
    EXPECT_TRUE(place.starts_with("meshes.tetrahedron.") || place.starts_with("encoding.tetrahedron") ||
                place == "geometry.sheet")  // on another grid
        << place;
}

TEST(Diff, SectionsThatOneAloneHas) {
  const json difference = diffJson(packOf(test::smallScene()), packOf(test::unusualScene()));
  std::map<std::string, std::string> sections;
  for (const json& s : difference.at("sections")) sections[s.at("id")] = s.at("change");
  for (const char* id : {"SRFX", "TEXR", "SKYP"}) EXPECT_EQ(sections[id], "only in the second") << id;
  const std::vector<std::string> places = placesOf(difference.at("changes"));
  EXPECT_NE(std::find(places.begin(), places.end(), "environment.sky.maxDegree"), places.end());
  EXPECT_NE(std::find(places.begin(), places.end(), "materials.gold.roughness"), places.end());
}

}  // namespace
}  // namespace malus::bake

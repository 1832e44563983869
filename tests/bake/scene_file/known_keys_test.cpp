// The keys that the reader of scene.json knows are those of the tables: the error of an unknown key lists the known
// ones.
#include <regex>
#include <set>

#include <nlohmann/json.hpp>

#include "bake/pack/material_fields.h"
#include "bake/scene_file/scene_keys.h"
#include "bake/scene_file/special_keys.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

// Adds the names of fields that are keys of a kind of material; "coating.eta" counts as "coating".
struct FieldNames {
  Names& names;
  pack::KindSet kinds = pack::kEveryKind;
  template <class T>
  void operator()(const pack::Field& field, const T&) {
    if (field.key != pack::Key::none && (field.kinds & kinds) != 0)
      names.emplace(field.name.substr(0, field.name.find('.')));
  }
};

Names special(std::initializer_list<std::span<const SpecialKey>> lists) {
  Names names;
  for (const std::span<const SpecialKey> list : lists)
    for (const SpecialKey& key : list) names.emplace(key.name);
  return names;
}

template <class Record, class Visit>
Names with(Names names, Visit visit) {
  const Record any{};
  visit(FieldNames{names}, any);
  return names;
}

#define MALUS_KEYS(visit) [](auto visitor, const auto& record) { visit(visitor, record); }

// A scene with an object of each kind, and with each alternative that has other keys.
json wholeScene() {
  return json::parse(R"({
    "malus": 1, "name": "plain",
    "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "verticalFovDegrees": 30},
    "resolution": [64, 48], "depth": 4,
    "environment": {"image": "sky.exr"},
    "lights": [{"type": "point", "position": [0, 0, 0], "intensity": [1, 1, 1]}],
    "materials": {
      "lambert": {"type": "lambert", "albedoMap": {"image": "a.png"}, "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}},
      "paint": {"type": "paint", "albedoMap": {"image": "a.png"}, "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}},
      "mirror-glass": {"type": "mirror-glass", "etaMap": {"image": "n.exr"},
                       "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}},
      "metal": {"type": "metal", "eta": 0.2, "k": 3, "etaMap": {"image": "n.exr"}, "kMap": {"image": "k.exr"},
                "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}},
      "glass": {"type": "glass", "eta": 1.5},
      "emitter": {"type": "emitter", "radiance": [1, 1, 1]},
      "polarizer": {"type": "polarizer", "axis": [0, 1, 0]},
      "wave-plate": {"type": "wave-plate", "axis": [0, 1, 0]},
      "thin-glass": {"type": "thin-glass", "eta": 1.5}},
    "meshes": [{"name": "floor", "file": "floor.obj", "material": "lambert", "instances": [{}]}],
    "imports": [{"file": "parts.obj", "transform": {}}]})");
}

// Returns the keys that the reader knows in the object at a JSON pointer.
Names knownKeys(json scene, const std::string& pointer) {
  const test::TemporaryFolder folder;
  scene[json::json_pointer(pointer)]["#################################"] = 1;
  const std::string error = test::errorMessage([&] { readSceneFile(folder.write("scene.json", scene.dump())); });
  EXPECT_CONTAINS(error, "unknown key");
  Names names;
  const std::regex quoted("'([A-Za-z]+)'");
  for (std::sregex_iterator match(error.begin(), error.end(), quoted), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

TEST(KnownKeys, AreThoseOfTheTables) {
  const json scene = wholeScene();
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::errorMessage([&] { readSceneFile(folder.write("scene.json", scene.dump())); }), "");
  EXPECT_EQ(knownKeys(scene, ""), with<SceneDescription>(special({kSceneSpecialKeys}), MALUS_KEYS(visitSceneKeys)));
  const Names camera =
      with<SceneDescription>({"verticalFovDegrees", "orthographicHeight", "intrinsics"}, MALUS_KEYS(visitCameraKeys));
  EXPECT_EQ(knownKeys(scene, "/camera"), camera);
  json other = scene;
  other["camera"].erase("verticalFovDegrees");
  other["camera"]["orthographicHeight"] = 2;
  EXPECT_EQ(knownKeys(other, "/camera"), camera);
  other["camera"].erase("orthographicHeight");
  other["camera"]["intrinsics"] = {{"fx", 100}, {"fy", 100}, {"cx", 32}, {"cy", 24}};
  EXPECT_EQ(knownKeys(other, "/camera"), camera);
  EXPECT_EQ(knownKeys(other, "/camera/intrinsics"), with<Intrinsics>({}, MALUS_KEYS(visitIntrinsicsKeys)));
  EXPECT_EQ(knownKeys(scene, "/lights/0"),
            with<pack::LightSource>(special({kLightSpecialKeys}), MALUS_KEYS(visitLightKeys)));
  other["lights"][0] = {{"type", "spot"}, {"position", {0, 0, 0}}, {"intensity", {1, 1, 1}}, {"direction", {0, 0, 1}}};
  Names spot = with<pack::LightSource>(special({kLightSpecialKeys}), MALUS_KEYS(visitLightKeys));
  spot =
      with<pack::LightSource>(with<pack::LightSource>(spot, MALUS_KEYS(visitDirectionKeys)), MALUS_KEYS(visitSpotKeys));
  EXPECT_EQ(knownKeys(other, "/lights/0"), spot);
  other["lights"][0] = {{"type", "directional"}, {"irradiance", {1, 1, 1}}, {"direction", {0, 0, 1}}};
  EXPECT_EQ(
      knownKeys(other, "/lights/0"),
      with<pack::LightSource>(with<pack::LightSource>(special({kLightSpecialKeys}), MALUS_KEYS(visitDirectionKeys)),
                              MALUS_KEYS(visitDirectionalKeys)));
  EXPECT_EQ(knownKeys(scene, "/materials/lambert/albedoMap"),
            with<TextureDescription>(special({kMapSpecialKeys}), MALUS_KEYS(visitMapKeys)));
  EXPECT_EQ(knownKeys(scene, "/materials/lambert/projection"), with<pack::Maps>({}, MALUS_KEYS(visitProjectionKeys)));
  EXPECT_EQ(knownKeys(scene, "/meshes/0/instances/0"), with<Transform>({}, MALUS_KEYS(visitTransformKeys)));
  EXPECT_EQ(knownKeys(scene, "/imports/0/transform"), with<Transform>({}, MALUS_KEYS(visitTransformKeys)));
  EXPECT_EQ(knownKeys(scene, "/meshes/0"),
            with<MeshDescription>(
                with<prep::Options>(special({kMeshSpecialKeys, kCleaningSpecialKeys}), MALUS_KEYS(visitCleaningKeys)),
                MALUS_KEYS(visitMeshKeys)));
  EXPECT_EQ(knownKeys(scene, "/imports/0"),
            with<prep::Options>(special({kImportSpecialKeys, kCleaningSpecialKeys}), MALUS_KEYS(visitCleaningKeys)));

  // The alternatives of an environment exclude each other.
  Names environment = with<SceneDescription>(special({kImageSpecialKeys}), MALUS_KEYS(visitEnvironmentKeys));
  environment.insert({"radiance", "preset"});
  json constant = scene;
  constant["environment"] = {{"radiance", {1, 1, 1}}};
  EXPECT_EQ(knownKeys(constant, "/environment"), environment);
  EXPECT_EQ(knownKeys(scene, "/environment"), with<SceneDescription>(environment, MALUS_KEYS(visitImageKeys)));
  json preset = scene;
  preset["environment"] = {{"preset", "studio"}};
  EXPECT_EQ(knownKeys(preset, "/environment"), with<SceneDescription>(environment, MALUS_KEYS(visitImageKeys)));
}

TEST(KnownKeys, OfEveryKindOfMaterial) {
  const json scene = wholeScene();
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds) {
    Names expected;
    for (const SpecialKey& key : kMaterialSpecialKeys)
      if (pack::contains(key.kinds, info.kind)) expected.emplace(key.name);
    const pack::Material any;
    pack::visitMaterial(FieldNames{expected, pack::only(info.kind)}, any);
    ASSERT_TRUE(scene.at("materials").contains(info.name)) << "an example of the kind " << info.name;
    EXPECT_EQ(knownKeys(scene, "/materials/" + std::string(info.name)), expected) << info.name;
  }
}

}  // namespace
}  // namespace malus::bake

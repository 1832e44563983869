#include "bake/info.h"

#include "bake/effects/effects.h"

#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;

pack::Pack writeAndParse(const pack::Scene& scene) { return pack::parse(pack::serialize(scene, {}).bytes, "test"); }

// A scene with an effect that this version does not know: its effects are reported as stored.
pack::Scene sceneWithUnknownEffect() {
  pack::Scene scene = test::smallScene();
  scene.effects[0].name = "newer";
  return scene;
}

TEST(Info, JsonHasTheDocumentedKeys) {
  const pack::Pack pack = writeAndParse(sceneWithUnknownEffect());
  const json info = infoJson(pack);
  EXPECT_EQ(info.at("formatVersion"), pack::kFormatVersion);
  EXPECT_EQ(info.at("name"), "small");
  EXPECT_EQ(info.at("title"), "A title with \xc3\xa4");
  EXPECT_EQ(info.at("resolution"), json({64, 48}));
  EXPECT_EQ(info.at("depth"), 5);
  EXPECT_EQ(info.at("vertices"), 8);
  EXPECT_EQ(info.at("triangles"), 6);
  EXPECT_EQ(info.at("lights"), 2);
  EXPECT_EQ(info.at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(info.at("geometryHash"), fmt::format("{:016x}", pack::canonicalGeometryHash(pack.scene)));
  ASSERT_EQ(info.at("meshes").size(), 2u);
  EXPECT_EQ(info["meshes"][0]["name"], "tetrahedron");
  EXPECT_EQ(info["meshes"][0]["material"], "gold");
  EXPECT_EQ(info["meshes"][0]["vertices"], 4);
  EXPECT_EQ(info["meshes"][0]["triangles"], 4);
  EXPECT_EQ(info["meshes"][0]["openSurface"], false);
  EXPECT_EQ(info["meshes"][1]["material"], "glass");
  EXPECT_EQ(info["meshes"][1]["openSurface"], true);
  EXPECT_EQ(info["meshes"][1]["encoding"], pack.compression[1]);
  EXPECT_EQ(info["meshes"][0]["errors"]["tiltMaxDegrees"], pack.encodings.meshes[0].deviation.tiltMaxDegrees);
  EXPECT_EQ(info["meshes"][0]["normalBits"], pack.encodings.meshes[0].normalBits);
  EXPECT_EQ(info["positionBits"], pack.encodings.positionBits());
  EXPECT_EQ(info["sourceMap"], false);
  ASSERT_EQ(info.at("materials").size(), 3u);
  EXPECT_EQ(info["materials"][1]["name"], "gold");
  EXPECT_EQ(info["materials"][1]["type"], "metal");
  EXPECT_EQ(info["materials"][1]["k"], json({3.4034, 2.2309, 1.8693}));
  ASSERT_EQ(info.at("effects").size(), 2u);
  EXPECT_EQ(info["effects"][0], (json{{"name", "newer"}, {"on", true}, {"reason", "there is gold"}}));
  ASSERT_EQ(info.at("sections").size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(info["sections"][i]["id"], pack.sections[i].id);
    EXPECT_EQ(info["sections"][i]["version"], pack.sections[i].version);
    EXPECT_EQ(info["sections"][i]["offset"], pack.sections[i].offset);
    EXPECT_EQ(info["sections"][i]["sizeBytes"], pack.sections[i].sizeBytes);
    EXPECT_EQ(info["sections"][i]["hash"], fmt::format("{:016x}", pack.sections[i].hash));
  }
  EXPECT_EQ(info.at("provenance"), (json{{"malus", "0"}}));
}

TEST(Info, PackWithoutEncodings) {
  pack::Pack pack = writeAndParse(test::smallScene());
  pack.encodings = {};
  const json info = infoJson(pack);
  EXPECT_TRUE(info.at("positionBits").is_null());
  EXPECT_TRUE(info["meshes"][0]["errors"].is_null());
  EXPECT_FALSE(test::contains(infoText(pack), "positions of"));
}

TEST(Info, ReportsTheSourceMap) {
  pack::WriteSettings settings;
  settings.keepMap = true;
  const pack::Pack pack = pack::parse(pack::serialize(test::smallScene(), settings).bytes, "test");
  EXPECT_EQ(infoJson(pack)["sourceMap"], true);
  EXPECT_CONTAINS(infoText(pack), "map to the source");
}

TEST(Info, TextContainsAllParts) {
  const std::string text = infoText(writeAndParse(sceneWithUnknownEffect()));
  for (const char* part : {"small", "8 vertices, 6 triangles, 2 lights, 64 x 48 pixels, depth 5", "tetrahedron", "gold",
                           "(open surface)", "there is gold", "positions of ", "GEOM", "PROV"})
    EXPECT_CONTAINS(text, part);
}

// A pack written before some of the current effects existed.
TEST(Info, OldEffectNamesAreRecomputed) {
  pack::Scene scene = test::smallScene();
  scene.effects = {{"transmission", false, "stored reason"}, {"conductor", false, "stored reason"}};
  const json effects = infoJson(writeAndParse(scene)).at("effects");
  ASSERT_EQ(effects.size(), effectNames().size());
  for (const json& e : effects)
    if (e.at("name") == "metal") {
      EXPECT_EQ(e.at("on"), true);
    }
}

TEST(Info, ProvenanceThatIsNotJson) {
  pack::Scene scene = test::smallScene();
  scene.provenance = "not { json";
  EXPECT_TRUE(infoJson(writeAndParse(scene)).at("provenance").is_null());
  scene.provenance = "";
  EXPECT_TRUE(infoJson(writeAndParse(scene)).at("provenance").is_null());
}

TEST(Info, DeepProvenanceDoesNotOverflowTheStack) {
  pack::Scene scene = test::smallScene();
  constexpr std::size_t kDeep = 1000000;
  scene.provenance = R"({"malus": )" + std::string(kDeep, '[') + std::string(kDeep, ']') + "}";
  EXPECT_LT(infoJson(writeAndParse(scene)).dump().size(), 10000u);
}

TEST(Info, InvalidUtf8) {
  pack::Scene scene = test::smallScene();
  scene.title = "\xff\xfe";
  scene.provenance = "\"\xff\"";
  const json info = infoJson(writeAndParse(scene));
  EXPECT_NO_THROW(info.dump(2, ' ', false, json::error_handler_t::replace));
}

// Two glass mirrors at any angle: the bound is 1 at depth 2, and useless at depth 5.
TEST(Info, MeasuresPolarizationWhereTheBoundSaysNothing) {
  pack::Scene scene = test::smallScene();
  for (pack::Mesh& mesh : scene.meshes) mesh.material = 0;
  int calls = 0;
  const MeasurePolarization measure = [&](const pack::Scene&) {
    ++calls;
    return PolarizationProbe{64, 48, 0.0125, 0.031};
  };
  const pack::Pack pack = writeAndParse(scene);
  const std::string text = infoText(pack, kInfoTolerance, measure);
  EXPECT_CONTAINS(text, "no useful bound", "measured at 64 x 48 pixels", "0.013", "3.1 %");
  EXPECT_EQ(infoJson(pack, kInfoTolerance, measure)["withoutPolarization"]["relRms"], 0.0125);
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(infoJson(pack)["withoutPolarization"].is_null());
  EXPECT_CONTAINS(infoText(pack, kInfoTolerance,
                           [](const pack::Scene&) {
                             return PolarizationProbe{64, 48, 0.2, 1};
                           }),
                  "100 % of the pixels");
  EXPECT_CONTAINS(infoText(pack, kInfoTolerance,
                           [](const pack::Scene&) -> PolarizationProbe { throw Error("test", "cannot be rendered"); }),
                  "no useful bound of the error\n");
  scene.depth = 0;
  infoText(writeAndParse(scene), kInfoTolerance, measure);
  EXPECT_EQ(calls, 2) << "the bound suffices";
}

TEST(Info, HasTheMeasuredDeepestBounce) {
  pack::Scene scene = test::smallScene();
  scene.lightBeyond = {0.9, 0.2, 0.02, 5e-4, 1e-4, 2e-5};
  const pack::Pack pack = writeAndParse(scene);
  EXPECT_EQ(infoJson(pack, 1e-3)["deepestBounce"]["measured"], 3);
  EXPECT_EQ(infoJson(pack, 0.1)["deepestBounce"]["measured"], 2);
  EXPECT_CONTAINS(infoText(pack, 1e-3), "0.05 % of the light arrives after more than 3 bounces");
  scene.lightBeyond.clear();
  EXPECT_TRUE(infoJson(writeAndParse(scene))["deepestBounce"]["measured"].is_null());
}

}  // namespace
}  // namespace malus::bake

// Materials of scene.json: kinds, indices, optional properties, maps.
#include "bake/scene_file/scene_file.h"
#include "tests/bake/scene_file/scene_texts.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;
using test::errorOfMaterial;
using test::errorWith;
using test::minimal;
using test::readJson;
using test::readText;

TEST(SceneMaterial, KindsAndIndices) {
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "marble", "albedo": 1})"),
                       "expected lambert, paint, mirror-glass, metal, glass, emitter, polarizer, wave-plate, "
                       "thin-glass, found 'marble'"));
  const std::string preset = errorOfMaterial(R"({"type": "metal", "preset": "golt"})");
  EXPECT_TRUE(contains(preset, "materials.floor.preset", "'golt'", "'gold'")) << preset;
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "metal", "preset": "gold", "k": 1})"), "exclude each other"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "metal", "k": 1})"), "eta: is missing"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "glass"})"), "preset: is missing"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "glass", "preset": "gold"})"), "of a dielectric"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "glass", "eta": 1.5, "k": 0.1})"), "of a dielectric"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "glass", "eta": 0})"), "is too small"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "metal", "eta": 0, "k": 0})"), "is too small"));
  EXPECT_EQ(errorOfMaterial(R"({"type": "metal", "eta": 0, "k": 3})"), "");
  EXPECT_EQ(errorOfMaterial(R"({"type": "glass", "eta": 1})"), "");
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "metal", "eta": 1001, "k": 0})"), "out of range"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "paint", "albedo": 1, "highlight": {"exponent": 0}})"), "range"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "paint", "albedo": 1, "highlight": {"exponent": 5000}})"), "range"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "paint", "albedo": 1, "highlight": {"strength": 1}})"), "exponent"));
}

pack::Material parseMaterial(const char* text) {
  json scene = minimal();
  scene["materials"]["floor"] = json::parse(text);
  return readJson(scene).materials[0];
}

TEST(SceneMaterial, OptionalMaterialProperties) {
  using Kind = pack::MaterialKind;
  pack::Material m = parseMaterial(R"({"type": "glass", "eta": 1.5, "absorption": [1, 2, 3], "outsideAbsorption": 4,
                                    "coating": {"eta": 1.38, "thicknessNm": 96.4}})");
  EXPECT_EQ(m.absorption, glm::dvec3(1, 2, 3));
  EXPECT_EQ(m.outsideAbsorption, glm::dvec3(4));
  EXPECT_EQ(m.coating.eta, glm::dvec3(1.38));
  EXPECT_EQ(m.coating.thicknessNm, 96.4);
  EXPECT_EQ(parseMaterial(R"({"type": "metal", "preset": "gold", "roughness": 0.25})").roughness, 0.25);
  m = parseMaterial(R"({"type": "emitter", "radiance": [1, 1, 1], "polarization": {"axis": [0, 3, 4]}})");
  EXPECT_EQ(m.axis, glm::dvec3(0, 0.6, 0.8));
  EXPECT_EQ(m.polarization, 1);
  m = parseMaterial(R"({"type": "polarizer", "axis": [0, 2, 0], "transmittanceCrossed": 0.01})");
  EXPECT_EQ(m.kind, Kind::polarizer);
  EXPECT_EQ(m.axis, glm::dvec3(0, 1, 0));
  EXPECT_EQ(m.transmittanceParallel, glm::dvec3(1));
  EXPECT_EQ(m.transmittanceCrossed, glm::dvec3(0.01));
  m = parseMaterial(
      R"({"type": "wave-plate", "axis": [1, 0, 0], "retardanceDegrees": [80, 90, 100], "transmittance": 0.9})");
  EXPECT_EQ(m.kind, Kind::wavePlate);
  EXPECT_EQ(m.retardanceDegrees, glm::dvec3(80, 90, 100));
  EXPECT_EQ(m.transmittanceParallel, glm::dvec3(0.9));
  EXPECT_EQ(m.transmittanceCrossed, glm::dvec3(0.9));
  EXPECT_TRUE(parseMaterial(R"({"type": "lambert", "albedo": 1})").isPlain());
  m = parseMaterial(R"({"type": "metal", "preset": "gold", "clearCoat": {}, "specularFactor": 0.5})");
  EXPECT_EQ(m.clearCoat.eta, 1.5);
  EXPECT_EQ(m.clearCoat.factor, 1);
  EXPECT_EQ(m.specularFactor, 0.5);
  m = parseMaterial(
      R"({"type": "glass", "eta": 1.8, "clearCoat": {"eta": 1.6, "factor": 0.25}, "transmittance": 0.5})");
  EXPECT_EQ(m.clearCoat.eta, 1.6);
  EXPECT_EQ(m.clearCoat.factor, 0.25);
  EXPECT_EQ(m.transmittanceParallel, glm::dvec3(0.5));

  for (const char* bad :
       {R"({"type": "glass", "eta": 1.5, "absorption": -1})", R"({"type": "metal", "preset": "gold", "absorption": 1})",
        R"({"type": "glass", "eta": 1.5, "roughness": 0.1})", R"({"type": "metal", "preset": "gold", "roughness": 2})",
        R"({"type": "lambert", "albedo": 1, "coating": {"eta": 1.4, "thicknessNm": 1}})",
        R"({"type": "glass", "eta": 1.5, "coating": {"eta": 1.4}})",
        R"({"type": "glass", "eta": 1.5, "coating": {"eta": 0, "thicknessNm": 1}})",
        R"({"type": "glass", "eta": 1.5, "clearCoat": {}, "coating": {"eta": 1.4, "thicknessNm": 1}})",
        R"({"type": "glass", "eta": 1.5, "clearCoat": {"factor": 2}})",
        R"({"type": "thin-glass", "eta": 1.5, "clearCoat": {}})",
        R"({"type": "lambert", "albedo": 1, "specularFactor": 0.5})",
        R"({"type": "emitter", "radiance": [1, 1, 1], "polarization": {"axis": [0, 0, 0]}})",
        R"({"type": "emitter", "radiance": [1, 1, 1], "polarization": {"axis": [0, 0, 1], "degree": 2}})",
        R"({"type": "polarizer"})", R"({"type": "polarizer", "axis": [0, 1, 0], "transmittanceParallel": 1.5})",
        R"({"type": "wave-plate", "axis": [0, 1, 0], "transmittanceCrossed": 1})"})
    EXPECT_TRUE(contains(errorOfMaterial(bad), "materials.floor")) << bad << ": " << errorOfMaterial(bad);
}

TEST(SceneMaterial, Maps) {
  json scene = minimal();
  scene["materials"] = json::parse(R"({
    "floor": {"type": "paint", "albedoMap": {"image": "a.png"},
              "etaMap": {"image": "b.exr", "scale": 2, "offset": 1},
              "projection": {"origin": [1, 2, 3], "u": [0.5, 0, 0], "v": [0, 0, 2]}},
    "wall": {"type": "lambert", "albedo": 0.5, "albedoMap": {"image": "a.png"}, "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}},
    "gold": {"type": "metal", "preset": "gold", "etaMap": {"image": "n.exr"}, "kMap": {"image": "k.exr"},
             "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}}})");
  const SceneDescription read = readJson(scene);
  ASSERT_EQ(read.textures.size(), 4u);  // equal image and use share a texture
  const auto material = [&](const char* name) {
    for (const pack::Material& m : read.materials)
      if (m.name == name) return m;
    return pack::Material{};
  };
  const pack::Material floor = material("floor"), wall = material("wall"), gold = material("gold");
  EXPECT_EQ(floor.maps.albedo, wall.maps.albedo);
  EXPECT_EQ(floor.albedo, glm::dvec3(1));
  EXPECT_EQ(wall.albedo, glm::dvec3(0.5));
  EXPECT_EQ(floor.maps.origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(floor.maps.v, glm::dvec3(0, 0, 2));
  const TextureDescription& eta = read.textures[static_cast<std::size_t>(floor.maps.eta)];
  EXPECT_EQ(eta.file.filename(), "b.exr");
  EXPECT_EQ(eta.scale, 2);
  EXPECT_EQ(eta.offset, 1);
  EXPECT_TRUE(eta.grey);
  EXPECT_FALSE(read.textures[static_cast<std::size_t>(gold.maps.k)].grey);
  const auto error = [](const char* text) { return errorOfMaterial(text); };
  EXPECT_TRUE(contains(error(R"({"type": "lambert", "albedoMap": {"image": "a.png"}})"), "projection: is missing"));
  EXPECT_TRUE(contains(error(R"({"type": "metal", "preset": "gold", "etaMap": {"image": "n.exr"},
                                 "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}})"),
                       "belong together"));
  EXPECT_TRUE(contains(error(R"({"type": "glass", "eta": 1.5, "etaMap": {"image": "n.exr"}})"), "etaMap"));
  EXPECT_TRUE(contains(error(R"({"type": "lambert", "albedo": 1, "projection": {"u": [1, 0, 0], "v": [0, 1, 0]}})"),
                       "projection"));
}

}  // namespace
}  // namespace malus::bake

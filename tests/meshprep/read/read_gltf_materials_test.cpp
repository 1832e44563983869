// Materials of glTF: values, defaults, and what replaces invalid ones.
#include "meshprep/read/read_gltf.h"

#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::errorMessage;
using test::GltfFile;
using test::hasNote;
using test::readGlb;
using test::TemporaryFile;
using test::triangleFile;

TEST(ReadGltf, ReplacesMaterialValuesOutOfRange) {
  GltfFile gltf = triangleFile();
  gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.document["materials"] = json::parse(R"([{"name": "bad", "emissiveFactor": [1, -1, 0],
    "pbrMetallicRoughness": {"baseColorFactor": [2, 0.5, -1, 1], "metallicFactor": 2, "roughnessFactor": -1},
    "extensions": {"KHR_materials_ior": {"ior": 0.5}, "KHR_materials_transmission": {"transmissionFactor": 7},
      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": -3, "attenuationColor": [1, 0.5, 9]}}}])");
  const SourceScene scene = readGlb(gltf);
  const SourceMaterial& material = scene.materials.at(0);
  EXPECT_EQ(material.baseColour, glm::dvec3(1, 0.5, 0));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 0);
  EXPECT_EQ(material.emissive, glm::dvec3(1, 0, 0));
  EXPECT_EQ(material.ior, 1.5);
  EXPECT_EQ(material.transmission, 1);
  EXPECT_EQ(material.attenuationColour, glm::dvec3(1, 0.5, 1));
  EXPECT_TRUE(std::isinf(material.attenuationDistance));
  for (const char* key : {"baseColorFactor", "metallicFactor", "roughnessFactor", "emissiveFactor", "ior",
                          "transmissionFactor", "attenuationColor", "attenuationDistance"})
    EXPECT_TRUE(hasNote(scene, key)) << key;
}

TEST(ReadGltf, ReadsSpecularLayersAndGlossiness) {
  GltfFile gltf = triangleFile();
  gltf.document["materials"] = json::parse(R"([
    {"extensions": {"KHR_materials_ior": {"ior": 0},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [0.25, 1, 2]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.5},
      "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.75, "iridescenceThicknessMinimum": 50,
        "iridescenceThicknessMaximum": 250}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "metallicFactor": 1},
     "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 1, 0, 1],
       "specularFactor": [0.25, 0.5, 0.75], "glossinessFactor": 0.25}}},
    {"name": "lamp", "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}},
    {"extensions": {"KHR_materials_specular": {"specularFactor": 2, "specularColorFactor": [-1, 1, 1]},
      "KHR_materials_clearcoat": {"clearcoatFactor": -1}, "KHR_materials_iridescence": {"iridescenceIor": 0.5}}}])");
  const SourceScene scene = readGlb(gltf);
  const SourceMaterial& layers = scene.materials[0];
  EXPECT_EQ(layers.ior, 0);
  EXPECT_EQ(layers.specular, 0.5);
  EXPECT_EQ(layers.specularColour, glm::dvec3(0.25, 1, 2));
  EXPECT_EQ(layers.clearcoat, 0.75);
  EXPECT_EQ(layers.clearcoatRoughness, 0.5);
  EXPECT_EQ(layers.film, 1);
  EXPECT_EQ(layers.filmIor, 1.75);
  EXPECT_EQ(layers.filmThicknessNm, 250);
  const SourceMaterial& glossy = scene.materials[1];
  EXPECT_EQ(glossy.baseColour, glm::dvec3(0, 1, 0));
  EXPECT_EQ(glossy.metallic, 0);
  EXPECT_EQ(glossy.roughness, 0.75);
  EXPECT_EQ(glossy.ior, 0);
  EXPECT_EQ(glossy.specularColour, glm::dvec3(0.25, 0.5, 0.75));
  EXPECT_EQ(scene.materials[2].emissive, glm::dvec3(0));
  EXPECT_TRUE(hasNote(scene, "emission of material 'lamp'"));
  EXPECT_EQ(scene.materials[3].specular, 1);
  EXPECT_EQ(scene.materials[3].specularColour, glm::dvec3(0, 1, 1));
  EXPECT_EQ(scene.materials[3].filmIor, 1.3);
  for (const char* key : {"specularFactor", "specularColorFactor", "clearcoatFactor", "iridescenceIor"})
    EXPECT_TRUE(hasNote(scene, key)) << key;
}

TEST(ReadGltf, ReadsMaterials) {
  GltfFile gltf = triangleFile();
  gltf.document["meshes"][0]["primitives"][0]["material"] = 1;
  gltf.document["materials"] = json::parse(R"([{"name": "plain"},
    {"name": "all", "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 1, 1], "metallicFactor": 0, "roughnessFactor": 0.5},
     "emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_ior": {"ior": 2},
       "KHR_materials_transmission": {"transmissionFactor": 0.75},
       "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 3, "attenuationColor": [1, 0.5, 0]},
       "KHR_materials_emissive_strength": {"emissiveStrength": 4}}}])");
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.parts[0].material, 1u);
  const SourceMaterial& plain = scene.materials[0];
  EXPECT_EQ(plain.baseColour, glm::dvec3(1));
  EXPECT_EQ(plain.metallic, 1);
  EXPECT_EQ(plain.roughness, 1);
  EXPECT_EQ(plain.ior, 1.5);
  EXPECT_FALSE(plain.hasVolume);
  const SourceMaterial& all = scene.materials[1];
  EXPECT_EQ(all.name, "all");
  EXPECT_EQ(all.baseColour, glm::dvec3(0.25, 0.5, 1));
  EXPECT_EQ(all.metallic, 0);
  EXPECT_EQ(all.roughness, 0.5);
  EXPECT_EQ(all.emissive, glm::dvec3(4, 2, 0));
  EXPECT_EQ(all.ior, 2);
  EXPECT_EQ(all.transmission, 0.75);
  EXPECT_TRUE(all.hasVolume);
  EXPECT_FALSE(all.isThinWalled);
  EXPECT_TRUE(all.tintsTransmission);
  EXPECT_EQ(all.attenuationDistance, 3);
  EXPECT_EQ(all.attenuationColour, glm::dvec3(1, 0.5, 0));

  const auto error = [&](const char* pointer, const json& value) {
    GltfFile bad = gltf;
    bad.document[json::json_pointer(std::string("/materials/1/") + pointer)] = value;
    const TemporaryFile file(".glb", bad.glb());
    return errorMessage([&] { readGltf(file.path(), true); });
  };
  EXPECT_CONTAINS(error("pbrMetallicRoughness/metallicFactor", 2),
                  "materials[1].pbrMetallicRoughness.metallicFactor: is");
  EXPECT_CONTAINS(error("pbrMetallicRoughness/baseColorFactor", {1, 1, 1}), "baseColorFactor: wrong type");
  EXPECT_CONTAINS(error("emissiveFactor", {1, -1, 0}), "materials[1].emissiveFactor", "range");
  EXPECT_EQ(error("emissiveFactor", {1, 40, 0}), "");
  EXPECT_CONTAINS(error("extensions/KHR_materials_ior/ior", 0.5), "materials[1].ior", "range");
  EXPECT_CONTAINS(error("extensions/KHR_materials_volume/attenuationDistance", 0), "materials[1].attenuationDistance",
                  "range");
  EXPECT_EQ(error("extensions/KHR_materials_ior/ior", 0), "");
  gltf.document["materials"][1]["extensions"]["KHR_materials_volume"].erase("thicknessFactor");
  const SourceScene thin = readGlb(gltf);
  EXPECT_FALSE(thin.materials[1].hasVolume);  // a wall without thickness absorbs nothing
  EXPECT_TRUE(thin.materials[1].isThinWalled);
  EXPECT_FALSE(thin.materials[0].isThinWalled);  // opaque
  EXPECT_TRUE(thin.materials[1].tintsTransmission);
  gltf.document["materials"][1]["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 0;
  EXPECT_TRUE(readGlb(gltf).materials[1].isThinWalled);
  gltf.document["materials"][1]["extensions"].erase("KHR_materials_volume");
  EXPECT_TRUE(readGlb(gltf).materials[1].isThinWalled);

  gltf.document["materials"][1]["alphaMode"] = "BLEND";
  gltf.document["materials"][1]["doubleSided"] = true;
  gltf.document["materials"][1]["extensions"]["KHR_materials_transmission"]["transmissionTexture"] = {{"index", 0}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["images"] = {{{"uri", "nowhere.png"}}};
  const SourceScene noted = readGlb(gltf);
  EXPECT_TRUE(noted.materials[1].isThinWalled);
  EXPECT_TRUE(noted.materials[1].isDoubleSided);
  EXPECT_FALSE(noted.materials[0].isDoubleSided);
  EXPECT_EQ(noted.materials[1].alphaMode, AlphaMode::blend);
  EXPECT_EQ(noted.materials[0].alphaMode, AlphaMode::opaque);
  EXPECT_EQ(noted.materials[1].transmissionImage, 0u);
}

TEST(ReadGltf, LeavesOutKeysOfMaterialsWithAWrongType) {
  GltfFile gltf = triangleFile();
  gltf.document["meshes"][0]["primitives"][0]["material"] = 2;
  gltf.document["materials"] = json::parse(R"(["red",
    {"name": 3, "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0], "roughnessFactor": 0.5},
     "emissiveFactor": "bright", "extensions": {"KHR_materials_ior": [1.5],
     "KHR_materials_volume": {"thicknessFactor": null, "attenuationDistance": 3}}},
    {"name": "good", "pbrMetallicRoughness": {"metallicFactor": 0}}])");
  const TemporaryFile file(".glb", gltf.glb());
  const SourceScene scene = readGltf(file.path());
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[0].baseColour, glm::dvec3(1));
  const SourceMaterial& part = scene.materials[1];
  EXPECT_EQ(part.name, "");
  EXPECT_EQ(part.baseColour, glm::dvec3(1));
  EXPECT_EQ(part.roughness, 0.5);
  EXPECT_EQ(part.emissive, glm::dvec3(0));
  EXPECT_EQ(part.ior, 1.5);
  EXPECT_FALSE(part.hasVolume);
  EXPECT_EQ(part.attenuationDistance, 3);
  EXPECT_EQ(scene.parts[0].material, 2u);
  EXPECT_EQ(scene.materials[2].name, "good");
  EXPECT_EQ(scene.materials[2].metallic, 0);
  for (const char* note :
       {"materials[0]: wrong type", "materials[1].name: wrong type",
        "materials[1].pbrMetallicRoughness.baseColorFactor: wrong type", "materials[1].emissiveFactor: wrong type",
        "KHR_materials_ior: wrong type", "thicknessFactor: wrong type"})
    EXPECT_TRUE(hasNote(scene, note)) << note;
  EXPECT_FALSE(hasNote(scene, file.path().string()));
  EXPECT_CONTAINS(errorMessage([&] { readGltf(file.path(), true); }), "materials[0]", "wrong type");
  gltf.document["materials"] = "none";
  EXPECT_CONTAINS(test::errorIn(gltf), "materials", "wrong type");
}

TEST(ReadGltf, AcceptsEmissiveFactorsAboveOne) {
  GltfFile gltf = triangleFile();
  gltf.document["materials"] = {{{"emissiveFactor", {1, 40, 0.5}}}};
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.materials[0].emissive, glm::dvec3(1, 40, 0.5));
  EXPECT_TRUE(hasNote(scene, "accepted: emissive factors above 1"));
  gltf.document["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
  EXPECT_FALSE(hasNote(readGlb(gltf), "accepted: emissive factors above 1"));
}

}  // namespace
}  // namespace malus::prep

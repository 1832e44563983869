// Reading scene.json: every key of bake/SCENE.md, and errors for unknown keys and invalid values.
#include "bake/scene_file/scene_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

TEST(SceneFile, DefaultsAreThoseOfTheDocument) {
  const SceneDescription scene = readJson(minimal());
  EXPECT_EQ(scene.name, "plain");
  EXPECT_EQ(scene.title, "");
  EXPECT_FALSE(scene.origin.has_value());
  EXPECT_EQ(scene.cameraPosition, glm::dvec3(0, 1, 5));
  EXPECT_EQ(scene.cameraTarget, glm::dvec3(0, 0, 0));
  EXPECT_EQ(scene.cameraUp, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.verticalFovDegrees, 30);
  EXPECT_EQ(scene.mediumEta, 1);
  EXPECT_EQ(scene.width, 64u);
  EXPECT_EQ(scene.height, 48u);
  EXPECT_EQ(scene.depth, 4u);
  EXPECT_EQ(scene.exposureEv, 0);
  EXPECT_EQ(scene.wavelengthsNm, glm::dvec3(630, 532, 465));
  EXPECT_EQ(scene.environmentRadiance, glm::dvec3(0));
  EXPECT_TRUE(scene.environmentImage.empty());
  EXPECT_EQ(scene.ambientIrradiance, 0);
  EXPECT_TRUE(scene.lights.empty());
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].kind, pack::MaterialKind::lambert);
  EXPECT_EQ(scene.materials[0].albedo, glm::dvec3(0.5));
  EXPECT_EQ(scene.materials[0].outsideEta, 1);
  EXPECT_EQ(scene.materials[0].highlightStrength, 0);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].file, scene.file.parent_path() / "floor.obj");
  EXPECT_FALSE(scene.meshes[0].preparation.flat);
  EXPECT_FALSE(scene.meshes[0].preparation.openSurface);
  EXPECT_EQ(scene.meshes[0].preparation.creaseDegrees, 40);
  EXPECT_EQ(scene.meshes[0].preparation.steps.weldTolerance, 0);
  ASSERT_EQ(scene.meshes[0].instances.size(), 1u);
  EXPECT_EQ(scene.meshes[0].instances[0].scale, glm::dvec3(1));
}

TEST(SceneFile, EveryKeyIsRead) {
  const SceneDescription scene = readText(R"({
    "malus": 1, "name": "Full-2", "title": "All of it", "origin": [1, 2, 3],
    "camera": {"position": [4, 5, 6], "target": [7, 8, 9], "up": [0, 0, 1], "verticalFovDegrees": 25.5, "mediumEta": 1.33},
    "resolution": [1, 16384], "depth": 30, "exposureEv": -1.5,
    "environment": {"image": "sky.hdr", "scale": 2.5, "rotationDegrees": -90, "ambientIrradiance": 0.25},
    "lights": [{"type": "point", "position": [1, 1, 1], "intensity": [2, 3, 4]}],
    "materials": {
      "a-metal": {"type": "metal", "eta": [0.2, 0.5, 1.3], "k": 3, "albedo": [0.1, 0.2, 0.3], "outsideEta": 1.5,
                  "highlight": {"exponent": 200, "strength": 0.5}},
      "b-glass": {"type": "glass", "preset": "bk7"},
      "c-black": {"type": "mirror-glass", "eta": 1.5, "highlight": {"exponent": 1}},
      "d-paint": {"type": "paint", "albedo": 1},
      "e-paint": {"type": "paint", "albedo": 0, "eta": 1.7},
      "f-lamp": {"type": "emitter", "radiance": [5, 6, 7]}},
    "meshes": [{"name": "one", "file": "sub/one.ply", "material": "b-glass", "flat": true, "openSurface": true,
                "creaseDegrees": 30, "weldTolerance": 0.001,
                "instances": [{}, {"scale": [1, -2, 3], "rotateDegrees": [10, 20, 30], "translate": [-1, -2, -3]},
                              {"scale": 4}]}]})");
  EXPECT_EQ(scene.name, "Full-2");
  EXPECT_EQ(scene.title, "All of it");
  EXPECT_EQ(scene.origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.cameraUp, glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.mediumEta, 1.33);
  EXPECT_EQ(scene.width, 1u);
  EXPECT_EQ(scene.height, 16384u);
  EXPECT_EQ(scene.depth, 30u);
  EXPECT_EQ(scene.exposureEv, -1.5);
  EXPECT_EQ(scene.environmentImage, scene.file.parent_path() / "sky.hdr");
  EXPECT_EQ(scene.environmentScale, 2.5);
  EXPECT_EQ(scene.environmentRotationDegrees, -90);
  EXPECT_EQ(scene.ambientIrradiance, 0.25);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].intensity, glm::dvec3(2, 3, 4));
  ASSERT_EQ(scene.materials.size(), 6u);
  EXPECT_EQ(scene.materials[0].kind, pack::MaterialKind::metal);
  EXPECT_EQ(scene.materials[0].eta, glm::dvec3(0.2, 0.5, 1.3));
  EXPECT_EQ(scene.materials[0].k, glm::dvec3(3));
  EXPECT_EQ(scene.materials[0].albedo, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.materials[0].outsideEta, 1.5);
  EXPECT_EQ(scene.materials[0].highlightExponent, 200u);
  EXPECT_EQ(scene.materials[0].highlightStrength, 0.5);
  EXPECT_EQ(scene.materials[1].kind, pack::MaterialKind::glass);
  EXPECT_EQ(scene.materials[1].eta.y, 1.5195);
  EXPECT_EQ(scene.materials[2].kind, pack::MaterialKind::mirrorGlass);
  EXPECT_EQ(scene.materials[2].highlightStrength, 1);
  EXPECT_EQ(scene.materials[3].kind, pack::MaterialKind::paint);
  EXPECT_EQ(scene.materials[3].eta, glm::dvec3(1.5));
  EXPECT_EQ(scene.materials[4].eta, glm::dvec3(1.7));
  EXPECT_EQ(scene.materials[5].kind, pack::MaterialKind::emitter);
  EXPECT_EQ(scene.materials[5].radiance, glm::dvec3(5, 6, 7));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const MeshDescription& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.file, scene.file.parent_path() / "sub/one.ply");
  EXPECT_TRUE(mesh.preparation.flat);
  EXPECT_TRUE(mesh.preparation.openSurface);
  EXPECT_EQ(mesh.preparation.creaseDegrees, 30);
  EXPECT_EQ(mesh.preparation.steps.weldTolerance, 0.001);
  ASSERT_EQ(mesh.instances.size(), 3u);
  EXPECT_EQ(mesh.instances[1].scale, glm::dvec3(1, -2, 3));
  EXPECT_EQ(mesh.instances[1].rotateDegrees, glm::dvec3(10, 20, 30));
  EXPECT_EQ(mesh.instances[1].translate, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(mesh.instances[2].scale, glm::dvec3(4));
}

TEST(SceneFile, RequiredKeys) {
  for (const char* pointer :
       {"/malus", "/name", "/camera", "/camera/position", "/camera/target", "/camera/verticalFovDegrees", "/resolution",
        "/depth", "/materials", "/materials/floor/type", "/materials/floor/albedo", "/meshes", "/meshes/0/name",
        "/meshes/0/file", "/meshes/0/material"}) {
    const std::string error = errorWith(pointer, nullptr);
    EXPECT_TRUE(contains(error, "is missing")) << pointer << ": " << error;
    EXPECT_TRUE(contains(error, "scene.json")) << error;
  }
}

TEST(SceneFile, MisspeltKeysNameTheNearest) {
  const struct {
    const char *pointer, *expected;
  } kCases[] = {
      {"/titel", "titel: unknown key; expected 'title'"},
      {"/exposureEV", "exposureEV: unknown key; expected 'exposureEv'"},
      {"/light", "light: unknown key; expected 'lights'"},
      {"/camera/mediumEtta", "camera.mediumEtta: unknown key; expected 'mediumEta'"},
      {"/meshes/0/creaseDegree", "meshes[0].creaseDegree: unknown key; expected 'creaseDegrees'"},
      {"/meshes/0/instance", "meshes[0].instance: unknown key; expected 'instances'"},
      {"/materials/floor/outsideEtta", "materials.floor.outsideEtta: unknown key; expected 'outsideEta'"},
  };
  for (const auto& c : kCases) {
    const std::string error = errorWith(c.pointer, "1");
    EXPECT_TRUE(contains(error, c.expected)) << error;
  }
  json scene = minimal();
  scene["environment"] = {{"radiance", {1, 1, 1}}, {"ambientIradiance", 1}};
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "environment.ambientIradiance", "'ambientIrradiance'"));
  scene = minimal();
  scene["lights"] = json::parse(R"([{"type": "point", "position": [0,0,0], "intensity": [1,1,1], "intensityy": 1}])");
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "lights[0].intensityy", "'intensity'"));
  scene = minimal();
  scene["meshes"][0]["instances"] = json::parse(R"([{}, {"rotate": [0, 0, 0], "translat": [0, 0, 0]}])");
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "meshes[0].instances[1]."));
}

TEST(SceneFile, KeysOfAnotherKindAreUnknown) {
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "lambert", "albedo": 1, "eta": 1.5})"), "eta: unknown key"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "lambert", "albedo": 1, "radiance": [1, 1, 1]})"), "unknown key"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "glass", "eta": 1.5, "albedo": 1})"), "albedo: unknown key"));
  EXPECT_TRUE(contains(errorOfMaterial(R"({"type": "emitter", "radiance": [1, 1, 1], "highlight": {"exponent": 1}})"),
                       "highlight: unknown key"));
  json scene = minimal();
  scene["environment"] = {{"radiance", {1, 1, 1}}, {"scale", 1}};
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "environment.scale: unknown key"));
}

TEST(SceneFile, Ranges) {
  const struct {
    const char *pointer, *value;
  } kCases[] = {
      {"/malus", "2"},
      {"/malus", "1.5"},
      {"/malus", "\"1\""},
      {"/name", "\"\""},
      {"/name", "\"two words\""},
      {"/name", "\"../x\""},
      {"/title", "7"},
      {"/origin", "[1, 2]"},
      {"/origin", "[0, 0, 1e13]"},
      {"/camera/position", "[0, 1]"},
      {"/camera/verticalFovDegrees", "0"},
      {"/camera/verticalFovDegrees", "171"},
      {"/camera/mediumEta", "0"},
      {"/resolution", "[0, 48]"},
      {"/resolution", "[64, 16385]"},
      {"/resolution", "[64]"},
      {"/resolution", "[64.5, 48]"},
      {"/resolution", "[-64, 48]"},
      {"/depth", "256"},
      {"/depth", "-1"},
      {"/depth", "4.0"},
      {"/exposureEv", "101"},
      {"/environment", "{}"},
      {"/environment", R"({"radiance": [1, 1, 1], "image": "a.hdr"})"},
      {"/environment", R"({"radiance": [-1, 1, 1]})"},
      {"/environment", R"({"image": "a.hdr", "rotationDegrees": 361})"},
      {"/environment", R"({"radiance": [1, 1, 1], "ambientIrradiance": -1})"},
      {"/lights", "{}"},
      {"/lights", R"([{"type": "spot", "position": [0, 0, 0], "intensity": [1, 1, 1]}])"},
      {"/lights", R"([{"type": "point", "position": [0, 0, 0], "intensity": [1, -1, 1]}])"},
      {"/materials", "[]"},
      {"/materials/floor/albedo", "1.1"},
      {"/materials/floor/albedo", "[1, 1]"},
      {"/materials/floor/outsideEta", "0"},
      {"/meshes", "[]"},
      {"/meshes", "{}"},
      {"/meshes/0/flat", "1"},
      {"/meshes/0/creaseDegrees", "181"},
      {"/meshes/0/weldTolerance", "-1"},
      {"/meshes/0/instances", "[]"},
      {"/meshes/0/instances", "{}"},
      {"/meshes/0/instances", R"([{"scale": 0}])"},
      {"/meshes/0/instances", R"([{"scale": [1, 0, 1]}])"},
      {"/meshes/0/instances", R"([{"rotateDegrees": [0, 0, 3601]}])"},
  };
  for (const auto& c : kCases) {
    const std::string error = errorWith(c.pointer, c.value);
    EXPECT_TRUE(contains(error, "expected")) << c.pointer << " = " << c.value << ": " << error;
  }
}

TEST(SceneFile, Simplification) {
  EXPECT_FALSE(readJson(minimal()).meshes[0].preparation.simplify.any());
  json scene = minimal();
  json& mesh = scene["meshes"][0];
  mesh.update({{"simplifyError", 0.001}, {"simplifyTriangles", 268435456}, {"simplifyNormal", 180}});
  scene["imports"] = json::parse(R"([{"file": "parts.obj", "simplifyTriangles": 1}])");
  const SceneDescription read = readJson(scene);
  const prep::SimplifyBounds& bounds = read.meshes[0].preparation.simplify;
  EXPECT_EQ(bounds.maxError, 0.001);
  EXPECT_EQ(bounds.triangles, 268435456u);
  EXPECT_EQ(bounds.maxNormalErrorDegrees, 180);
  EXPECT_EQ(read.imports[0].preparation.simplify.triangles, 1u);
  EXPECT_FALSE(read.imports[0].preparation.simplify.maxError);

  // Ranges.
  for (const auto& [key, value] :
       {std::pair("simplifyError", "0"), std::pair("simplifyError", "-1"), std::pair("simplifyError", "1e13"),
        std::pair("simplifyError", "\"1\""), std::pair("simplifyError", "null"), std::pair("simplifyTriangles", "0"),
        std::pair("simplifyTriangles", "-5"), std::pair("simplifyTriangles", "1.5"),
        std::pair("simplifyTriangles", "268435457"), std::pair("simplifyNormal", "0"),
        std::pair("simplifyNormal", "180.5")}) {
    for (const char* list : {"meshes", "imports"}) {
      json bad = scene;
      bad[list][0][key] = json::parse(value);
      const std::string error = errorMessage([&] { readJson(bad); });
      EXPECT_TRUE(contains(error, fmt::format("{}[0].{}", list, key)) && contains(error, "expected"))
          << key << " = " << value << ": " << error;
    }
  }

  // Keys that exclude simplification.
  for (const auto& [key, value] : {std::pair("asIs", "true"), std::pair("skip", R"(["fans"])"),
                                   std::pair("skip", R"(["orient"])"), std::pair("normals", R"("authored")")}) {
    json bad = scene;
    bad["meshes"][0][key] = json::parse(value);
    const std::string error = errorMessage([&] { readJson(bad); });
    EXPECT_TRUE(contains(error, "meshes[0].simplifyError") && contains(error, "simplif")) << error;
  }
  mesh["normals"] = "authored";
  mesh["flat"] = true;  // the normals are not used
  mesh["skip"] = {"weld", "unreferenced"};
  EXPECT_EQ(errorMessage([&] { readJson(scene); }), "");
}

TEST(SceneFile, DeprecatedKeys) {
  json scene = minimal();
  scene["environment"] = {{"radiance", {1, 1, 1}}, {"diffuseFill", 0.5}};
  scene["materials"]["film"] = json::parse(R"({"type": "polarizer", "axis": [0, 1, 0], "along": 0.9, "across": 0.1})");
  scene["meshes"][0]["sheet"] = true;
  scene["imports"] = json::parse(R"([{"file": "parts.obj", "sheets": ["pane"]}])");
  const SceneDescription read = readJson(scene);
  EXPECT_EQ(read.ambientIrradiance, 0.5);
  EXPECT_EQ(read.materials[0].transmittanceParallel, glm::dvec3(0.9));
  EXPECT_EQ(read.materials[0].transmittanceCrossed, glm::dvec3(0.1));
  EXPECT_TRUE(read.meshes[0].preparation.openSurface);
  EXPECT_EQ(read.imports[0].openSurfaces, std::vector<std::string>{"pane"});
  ASSERT_EQ(read.deprecations.size(), 5u);
  for (const auto& [name, expected] :
       {std::pair("diffuseFill", "ambientIrradiance"), std::pair("along", "transmittanceParallel"),
        std::pair("across", "transmittanceCrossed"), std::pair("sheet", "openSurface"),
        std::pair("sheets", "openSurfaces")})
    EXPECT_TRUE(std::any_of(read.deprecations.begin(), read.deprecations.end(),
                            [&, n = name, e = expected](const std::string& note) {
                              return contains(note, std::string(n) + " is deprecated") && contains(note, e);
                            }))
        << name;
  EXPECT_TRUE(readJson(minimal()).deprecations.empty());
  scene["meshes"][0]["openSurface"] = true;
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "meshes[0].sheet"));
}

TEST(SceneFile, Sky) {
  json scene = minimal();
  scene["environment"] = json::parse(R"({"radiance": [1, 1, 1], "sky": {"sun": [0, 3, 4]}})");
  const SceneDescription read = readJson(scene);
  EXPECT_EQ(read.sun, glm::dvec3(0, 0.6, 0.8));
  EXPECT_EQ(read.skyDegree, 0.8);
  for (const char* bad :
       {R"({"radiance": [1, 1, 1], "sky": {}})", R"({"radiance": [1, 1, 1], "sky": {"sun": [0, 0, 0]}})",
        R"({"radiance": [1, 1, 1], "sky": {"sun": [0, 1, 0], "maxDegree": 1.5}})"}) {
    scene["environment"] = json::parse(bad);
    EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "environment.sky")) << bad;
  }
}

TEST(SceneFile, MeshesNeedKnownMaterialsAndUniqueNames) {
  const std::string error = errorWith("/meshes/0/material", "\"flor\"");
  EXPECT_TRUE(contains(error, "meshes[0].material", "'flor'", "'floor'")) << error;
  json scene = minimal();
  scene["meshes"].push_back(scene["meshes"][0]);
  EXPECT_TRUE(contains(errorMessage([&] { readJson(scene); }), "meshes[1].name: occurs twice"));
}

TEST(SceneFile, InvalidJsonReportsTheLine) {
  const auto error = [](const std::string& text) { return errorMessage([&] { readText(text); }); };
  const std::string third = error("{\n  \"malus\": 1,\n  \"name\": oops\n}\n");
  EXPECT_TRUE(contains(third, "scene.json:3: is not JSON")) << third;
  EXPECT_TRUE(contains(error(""), "scene.json:1: is not JSON"));
  EXPECT_TRUE(contains(error("{\n\n\n"), "is not JSON"));
  EXPECT_TRUE(contains(error("\x89PNG\r\n"), "is not JSON"));
  EXPECT_TRUE(contains(error("[]"), "top level"));
  EXPECT_TRUE(contains(error("{\"name\": \"\xff\"}"), "is not JSON"));
}

TEST(SceneFile, DuplicateKeys) {
  std::string text = minimal().dump();
  text.insert(1, R"("depth": 2, )");
  const std::string error = errorMessage([&] { readText(text); });
  EXPECT_TRUE(contains(error, "key 'depth' occurs twice")) << error;
  EXPECT_EQ(errorWith("/title", "\"name\""), "");  // a value may equal a key
}

TEST(SceneFile, NumbersBeyondDoubles) {
  std::string text = minimal().dump();
  text.insert(1, R"("exposureEv": 1e999, )");
  const std::string error = errorMessage([&] { readText(text); });
  EXPECT_TRUE(contains(error, "scene.json")) << error;
  EXPECT_TRUE(contains(error, "1e999")) << error;
}

TEST(SceneFile, DeepNestingIsAnError) {
  constexpr std::size_t kDeep = 1000000;
  const std::string text = R"({"name": )" + std::string(kDeep, '[') + std::string(kDeep, ']') + "}";
  const std::string error = errorMessage([&] { readText(text); });
  EXPECT_TRUE(contains(error, "nested too deep")) << error.substr(0, 200);
}

TEST(SceneFile, MissingFile) {
  EXPECT_TRUE(contains(errorMessage([] { readSceneFile("/nowhere/scene.json"); }), "/nowhere/scene.json: cannot open"));
}

TEST(SceneFile, CamerasOfEveryKind) {
  json scene = minimal();
  json& camera = scene["camera"];
  camera.erase("verticalFovDegrees");
  camera["orthographicHeight"] = 3;
  EXPECT_EQ(readJson(scene).orthographicHeight, 3);
  camera["intrinsics"] = {{"fx", 100}, {"fy", 90}, {"cx", 32.5}, {"cy", 20}};
  EXPECT_CONTAINS(errorMessage([&] { readJson(scene); }), "camera", "exclude");
  camera.erase("orthographicHeight");
  const Intrinsics intrinsics = readJson(scene).intrinsics.value();
  EXPECT_EQ(intrinsics.fx, 100);
  EXPECT_EQ(intrinsics.fy, 90);
  EXPECT_EQ(intrinsics.cx, 32.5);
  EXPECT_EQ(intrinsics.cy, 20);
  for (const auto& [key, value] : {std::pair("fx", 0), std::pair("fy", -1), std::pair("cx", 10000000)}) {
    json wrong = scene;
    wrong["camera"]["intrinsics"][key] = value;
    EXPECT_CONTAINS(errorMessage([&] { readJson(wrong); }), std::string("camera.intrinsics.") + key);
  }
}

TEST(SceneFile, LightsOfEveryKind) {
  json scene = minimal();
  scene["lights"] = {{{"type", "spot"}, {"position", {1, 2, 3}}, {"intensity", {1, 1, 1}}, {"direction", {0, 0, -4}}},
                     {{"type", "directional"}, {"irradiance", {3, 2, 1}}, {"direction", {0, -1, 0}}}};
  const SceneDescription read = readJson(scene);
  ASSERT_EQ(read.lights.size(), 2u);
  EXPECT_EQ(read.lights[0].kind, pack::LightKind::spot);
  EXPECT_EQ(read.lights[0].direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(read.lights[0].innerConeDegrees, 0);
  EXPECT_EQ(read.lights[0].outerConeDegrees, 45);
  EXPECT_EQ(read.lights[1].kind, pack::LightKind::directional);
  EXPECT_EQ(read.lights[1].intensity, glm::dvec3(3, 2, 1));
  const auto lightError = [&](const char* key, const json& value) {
    json wrong = scene;
    wrong["lights"][0][key] = value;
    return errorMessage([&] { readJson(wrong); });
  };
  EXPECT_CONTAINS(lightError("type", "spt"), "lights[0].type", "'spot'");
  EXPECT_CONTAINS(lightError("direction", {0, 0, 0}), "lights[0].direction");
  EXPECT_CONTAINS(lightError("innerConeDegrees", 45), "innerConeDegrees", "below 45");
  EXPECT_CONTAINS(lightError("outerConeDegrees", 91), "outerConeDegrees");
  EXPECT_CONTAINS(lightError("irradiance", {1, 1, 1}), "irradiance");
}

}  // namespace
}  // namespace malus::bake

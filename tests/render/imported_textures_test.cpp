// Textures of glTF files whose texels choose the kind of surface, baked and rendered on every renderer: closed forms.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "bake/bake.h"
#include "meshprep/base/image.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using nlohmann::json;
using test::Stokes;

constexpr auto kSilent = [](std::string_view) {};

// sRGB of a linear value.
float encoded(double linear) {
  return static_cast<float>(linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

// A glTF file with textured squares of 2 m that face +z, and a scene with a light.
class ImportedTextures : public testing::Test {
 protected:
  // Adds an image of one row; returns the index of its texture. channels: 3 or 4 numbers per texel.
  int addTexture(std::size_t channels, const std::vector<float>& texels) {
    image::Image image;
    image.width = static_cast<int>(texels.size() / channels);
    image.height = 1;
    image.channels = {"R", "G", "B"};
    if (channels == 4) image.channels.emplace_back("A");
    image.pixels = texels;
    const std::string name = fmt::format("{}.exr", images_++);
    image::writeExr(folder_.path() / name, image);
    return gltf_.add("textures", {{"source", gltf_.add("images", {{"uri", name}})}});
  }
  // Its image covers x from -1 to 1, from the left.
  void addSquare(const json& material, double z, const char* name) {
    const auto x = static_cast<float>(z);
    const int positions = gltf_.addVectors({{-1, -1, x}, {1, -1, x}, {1, 1, x}, {-1, 1, x}});
    const int coordinates = gltf_.addAccessor(
        gltf_.addView(prep::test::GltfFile::toBytes(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0})), 5126, 4, "VEC2");
    const int indices = gltf_.addIndices(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3});
    const int index = gltf_.add("materials", material);
    const int mesh = gltf_.add("meshes", {{"primitives",
                                           {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", coordinates}}},
                                             {"indices", indices},
                                             {"material", index}}}}});
    gltf_.addNode({{"name", name}, {"mesh", mesh}});
  }
  bake::Baked bake(double environment, double light) {
    folder_.write("model.glb", gltf_.glb());
    const json scene = {
        {"malus", 1},
        {"name", "test"},
        {"resolution", {1, 1}},
        {"depth", 4},
        {"materials", json::object()},
        {"camera", {{"position", {0, 0, 5}}, {"target", {0, 0, 0}}, {"verticalFovDegrees", 0.01}}},
        {"environment", {{"radiance", {environment, environment, environment}}}},
        {"lights", {{{"type", "point"}, {"position", {0, 0, 3}}, {"intensity", {light, light, light}}}}},
        {"imports", {{{"file", "model.glb"}}}}};
    return bake::bake(bake::readSceneFile(folder_.write("scene.json", scene.dump())), {}, kSilent, {});
  }
  // truth: by colour; empty: not compared.
  static void expectEverywhere(pack::Scene scene, const glm::dvec3& from, const glm::dvec3& to,
                               const std::array<std::optional<Stokes>, 3>& truth) {
    test::look(scene, from - scene.origin, to - scene.origin);
    for (const auto& [name, result] : test::renderEverywhere(scene))
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; truth[c] && k < 4; ++k)
          EXPECT_NEAR(result.pixels[3 + 3 * k + c], (*truth[c])[k], 1e-5)
              << name << ", S" << k << " of colour " << c << " at x = " << to.x;
  }

  bake::test::TemporaryFolder folder_;
  prep::test::GltfFile gltf_;
  int images_ = 0;
};

double reflectance(double n, double c, bool isP) {
  const double t = std::sqrt(n * n - 1 + c * c);
  const double r = isP ? (n * n * c - t) / (n * n * c + t) : (c - t) / (c + t);
  return r * r;
}

// Unpolarized light through a pane of index 1.5: (1 - R)/(1 + R) of s and p sums the reflections inside.
double paneTransmittance(double c) {
  const double s = reflectance(1.5, c, false), p = reflectance(1.5, c, true);
  return ((1 - s) / (1 + s) + (1 - p) / (1 + p)) / 2;
}

constexpr double kIntensity = 7;

// Radiance of a white wall at z = -1 under the light at (0, 0, 3) without a pane, and the cosine at wall and pane.
double lambert(double x, double z, double& cosine) {
  const double height = 3 - z, distanceSq = x * x + height * height;
  cosine = height / std::sqrt(distanceSq);
  return kIntensity / distanceSq * cosine / std::numbers::pi;
}

class TransmissionTexture : public ImportedTextures {
 protected:
  bake::Baked bakePane(double factor, const std::vector<float>& reds, const json& others = json::object()) {
    std::vector<float> texels;
    for (const float red : reds) texels.insert(texels.end(), {red, 1, 1});
    json pane = {{"name", "pane"},
                 {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                 {"extensions",
                  {{"KHR_materials_transmission",
                    {{"transmissionFactor", factor}, {"transmissionTexture", {{"index", addTexture(3, texels)}}}}}}}};
    pane.update(others, true);
    gltf_.document["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_volume"};
    addSquare(pane, 0, "window");
    addSquare({{"name", "white"}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}}, -1, "wall");
    return bake(0, kIntensity);
  }
  // Whether light and camera rays pass the pane at x, on every renderer.
  static void expectPane(const pack::Scene& scene, double x, bool isClear) {
    double c = 0;
    // The wall, seen from between, where the ray to the light crosses the pane at x.
    const double wall = lambert(x * 4 / 3, -1, c) * (isClear ? paneTransmittance(c) : 0);
    expectEverywhere(scene, {0, 0, -0.5}, {x * 4 / 3, 0, -1}, {Stokes{wall, 0, 0, 0}});
    expectFront(scene, x, isClear);
  }
  // The pane, seen from the front at normal incidence: the wall behind it, or the opaque surface.
  static void expectFront(const pack::Scene& scene, double x, bool isClear) {
    double c = 0;
    const double behind = lambert(x, -1, c) * paneTransmittance(c) * paneTransmittance(1);
    expectEverywhere(scene, {x, 0, 5}, {x, 0, 0}, {Stokes{isClear ? behind : lambert(x, 0, c), 0, 0, 0}});
  }
};

TEST_F(TransmissionTexture, TexelsAreThinGlassOrOpaqueForAllRays) {
  const bake::Baked baked = bakePane(1, {1, 0});
  expectPane(baked.scene, -0.5, true);
  expectPane(baked.scene, 0.5, false);
  // The boundary is where the interpolated transmission is a half, in the middle.
  expectFront(baked.scene, -0.01, true);
  expectFront(baked.scene, 0.01, false);
  EXPECT_EQ(baked.scene.meshes.size(), 3u);
  EXPECT_TRUE(
      bake::test::contains(fmt::format("{}", fmt::join(baked.notes, "\n")), "transmission texture of material 'pane'"));
}

TEST_F(TransmissionTexture, TheThresholdIsThatOfTheFactor) {
  const bake::Baked baked = bakePane(0.8, {0.1f, 0.6f, 0.7f, 0.9f});  // 0.08, 0.48, 0.56, 0.72
  expectFront(baked.scene, -0.25, false);
  expectFront(baked.scene, 0.25, true);
}

// The frame of a window: metallic texels do not transmit, whatever the mean of the texture is.
TEST_F(TransmissionTexture, MetallicTexelsAreOpaque) {
  const int metallic = addTexture(3, {1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  const bake::Baked baked = bakePane(
      1, {1},
      {{"pbrMetallicRoughness", {{"metallicFactor", 1.0}, {"metallicRoughnessTexture", {{"index", metallic}}}}}});
  EXPECT_EQ(baked.scene.meshes.size(), 3u);
  expectFront(baked.scene, -0.875, true);
  // A mirror in front of a black environment.
  expectEverywhere(baked.scene, {0.5, 0, 5}, {0.5, 0, 0}, {Stokes{0, 0, 0, 0}});
}

TEST_F(TransmissionTexture, TexelsOfOneKindMakeOneMaterial) {
  for (const auto& [factor, expected] : {std::pair(1.0, true), std::pair(0.5, false)}) {
    gltf_ = {};
    const bake::Baked baked = bakePane(factor, {1, 0.75f});
    EXPECT_EQ(baked.scene.meshes.size(), 2u);
    EXPECT_FALSE(baked.scene.materials[0].meshMaps.coverage.isUsed());
    expectFront(baked.scene, 0.5, expected);
  }
}

TEST_F(TransmissionTexture, BodiesAndCutOutsUseTheMeanWithANote) {
  const json body = {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1.0}}}}}};
  const json mask = {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
  for (const json& others : {body, mask}) {
    gltf_ = {};
    images_ = 0;
    if (others.contains("alphaMode")) addTexture(4, {1, 1, 1, 1, 1, 1, 1, 0});
    const bake::Baked baked = bakePane(0.9, {1, 0.1f});  // a mean of 0.495: opaque
    gltf_ = {};
    images_ = 0;
    if (others.contains("alphaMode")) addTexture(4, {1, 1, 1, 1, 1, 1, 1, 0});
    const bake::Baked other = bakePane(0.9, {1, 0.1f}, others);
    EXPECT_EQ(baked.scene.meshes.size(), 3u);
    EXPECT_EQ(other.scene.meshes.size(), 2u);
    EXPECT_TRUE(bake::test::contains(fmt::format("{}", fmt::join(other.notes, "\n")), "whose mean is used"));
  }
}

class SpecularGlossiness : public ImportedTextures {
 protected:
  // Glossy texels of these reflectances. blue: factor of that of blue.
  bake::Baked bakePlate(const std::vector<double>& reflectances, double blue, const json& values = json::object()) {
    std::vector<float> texels;
    for (const double f : reflectances) texels.insert(texels.end(), {encoded(f), encoded(f), encoded(f * blue), 1});
    json extension = {{"diffuseFactor", {0, 0, 0, 1}},
                      {"specularGlossinessTexture", {{"index", addTexture(4, texels)}}}};
    extension.update(values);
    gltf_.document["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    addSquare({{"name", "plate"}, {"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}}, 0, "plate");
    return bake(1, 0);
  }
  // The middle of a texel.
  static double middle(std::size_t texel, std::size_t count) {
    return 2 * (static_cast<double>(texel) + 0.5) / static_cast<double>(count) - 1;
  }
  static void expectReflectances(const bake::Baked& baked, const std::vector<double>& truth, double blue) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double x = middle(i, truth.size());
      expectEverywhere(baked.scene, {x, 0, 5}, {x, 0, 0},
                       {Stokes{truth[i], 0, 0, 0}, {}, Stokes{truth[i] * blue, 0, 0, 0}});
    }
  }
};

TEST_F(SpecularGlossiness, TexelsAreMetalsAndDielectrics) {
  const std::vector<double> reflectances = {0.04, 0.6, 0.9, 0.1};
  const bake::Baked baked = bakePlate(reflectances, 0.25);
  EXPECT_EQ(baked.scene.materials[0].kind, pack::MaterialKind::metal);
  expectReflectances(baked, reflectances, 0.25);
  // At Brewster's angle in the plane of x the dielectric of index 1.5 polarizes fully: s is along y, which is S1 < 0.
  const double angle = std::atan(1.5), x = middle(0, 4), rs = reflectance(1.5, std::cos(angle), false);
  expectEverywhere(baked.scene, {x + 3 * std::sin(angle), 0, 3 * std::cos(angle)}, {x, 0, 0},
                   {Stokes{rs / 2, -rs / 2, 0, 0}});
}

TEST_F(SpecularGlossiness, DielectricsAloneArePaint) {
  const std::vector<double> reflectances = {0.02, 0.04, 0.2, 0.1};
  // Dielectrics have one index for all colours, that of green, also if the file gives several.
  const bake::Baked baked = bakePlate(reflectances, 1);
  EXPECT_EQ(baked.scene.materials[0].kind, pack::MaterialKind::paint);
  expectReflectances(baked, reflectances, 1);
}

TEST_F(SpecularGlossiness, MetalsAloneAreScaledByTheFactor) {
  const bake::Baked baked = bakePlate({0.9, 0.6}, 0.5, {{"specularFactor", {0.9, 0.9, 0.9}}});
  EXPECT_FALSE(baked.scene.materials[0].meshMaps.metallic.isUsed());
  expectReflectances(baked, {0.81, 0.54}, 0.5);
}

TEST_F(SpecularGlossiness, TheDiffuseTextureHasCoordinatesOfItsOwn) {
  const int diffuse =
      addTexture(3, {encoded(0.2), encoded(0.2), encoded(0.2), encoded(0.8), encoded(0.8), encoded(0.8)});
  // Matt, so that it is lambert: the texels of the colour, moved by one.
  const bake::Baked baked =
      bakePlate({0.04, 0.04, 0.04, 0.04}, 1,
                {{"diffuseFactor", {1, 1, 1, 1}},
                 {"glossinessFactor", 0.1},
                 {"diffuseTexture",
                  {{"index", diffuse}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.0}}}}}}}}});
  const pack::Material& plate = baked.scene.materials[0];
  EXPECT_EQ(plate.kind, pack::MaterialKind::lambert);
  EXPECT_EQ(plate.meshMaps.albedo.u.z, 0.5);
}

}  // namespace
}  // namespace malus

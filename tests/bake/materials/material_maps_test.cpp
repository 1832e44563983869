// Maps of imported materials: a uniform image gives what the factor gives, the others follow the rules per texel.
#include "bake/materials/material_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bake/materials/source_material.h"
#include "bake/materials/texture_means.h"
#include "meshprep/base/image.h"
#include "shaders/optics/optics.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::MaterialKind;

// Converts the first material of a scene whose images are files of these pixels.
class MaterialMapsTest : public ::testing::Test {
 protected:
  // An image of `width` pixels and one row; returns its index. channels: R, G, B or R, G, B, A.
  std::size_t add(int width, const std::vector<float>& pixels) {
    image::Image image;
    image.width = width;
    image.height = 1;
    image.channels = {"R", "G", "B"};
    if (pixels.size() == static_cast<std::size_t>(width) * 4) image.channels.emplace_back("A");
    image.pixels = pixels;
    const std::filesystem::path file = folder_.path() / fmt::format("{}.exr", scene_.images.size());
    image::writeExr(file, image);
    scene_.images.push_back({file.filename().string(), file, nullptr});
    return scene_.images.size() - 1;
  }

  pack::Material convert(const prep::SourceMaterial& source) {
    scene_.materials = {source};
    applyTextureMeans(scene_, true);
    textures_.clear();
    MaterialMaps maps(scene_.images, textures_, notes_, true);
    return maps.convert(source, scene_.materials[0]);
  }

  const glm::vec3& texel(const pack::MeshMap& map, std::size_t i) const {
    return textures_.at(static_cast<std::size_t>(map.texture)).texels.at(i);
  }

  test::TemporaryFolder folder_;
  prep::SourceScene scene_;
  std::vector<pack::Texture> textures_;
  std::vector<std::string> notes_;
};

// sRGB of a linear value.
float encoded(double linear) { return static_cast<float>(1.055 * std::pow(linear, 1 / 2.4) - 0.055); }

TEST_F(MaterialMapsTest, AUniformImageGivesWhatTheFactorGives) {
  const glm::dvec3 colour{0.5, 0.25, 0.125};
  for (const double metallic : {0.0, 1.0})
    for (const double roughness : {0.0, 0.4, 1.0}) {
      prep::SourceMaterial factor;
      factor.baseColour = colour;
      factor.metallic = metallic;
      factor.roughness = roughness;
      const pack::Material expected = convertMaterial(factor, notes_);
      prep::SourceMaterial textured;
      textured.baseColourImage =
          add(2, {encoded(0.5), encoded(0.25), encoded(0.125), encoded(0.5), encoded(0.25), encoded(0.125)});
      const auto r = static_cast<float>(roughness), m = static_cast<float>(metallic);
      textured.metallicRoughnessImage = add(1, {0.3f, r, m});
      const pack::Material made = convert(textured);
      EXPECT_EQ(made.kind, expected.kind);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(made.albedo[c], expected.albedo[c], 1e-6);
        EXPECT_NEAR(made.eta[c], expected.eta[c], 1e-5);
        EXPECT_NEAR(made.k[c], expected.k[c], 1e-5);
        if (metallic > 0) {
          const f64::ConductorIndex index =
              f64::conductorIndex(static_cast<double>(texel(made.meshMaps.reflectance, 1)[c]), 1);
          EXPECT_NEAR(index.eta, expected.eta[c], 1e-5);
          EXPECT_NEAR(index.k, expected.k[c], 1e-5);
        } else {
          EXPECT_NEAR(texel(made.meshMaps.albedo, 1)[c], expected.albedo[c], 1e-6);
        }
      }
      EXPECT_NEAR(made.roughness, expected.roughness, 1e-6);
      EXPECT_EQ(made.meshMaps.roughness.isUsed(), pack::canBeRough(made.kind));
      if (made.meshMaps.roughness.isUsed()) {
        EXPECT_NEAR(texel(made.meshMaps.roughness, 0).x, expected.roughness, 1e-6);
      }
      EXPECT_FALSE(made.meshMaps.metallic.isUsed() || made.meshMaps.normal.isUsed() || made.meshMaps.coverage.isUsed());
    }
}

TEST_F(MaterialMapsTest, MetalBesideADielectric) {
  prep::SourceMaterial source;
  source.baseColourImage = add(2, {encoded(0.5), encoded(0.5), encoded(0.5), encoded(0.8), encoded(0.8), encoded(0.8)});
  source.metallicRoughnessImage = add(2, {0, 0.5f, 0, 0, 0.5f, 1});
  const pack::Material made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::metal);
  EXPECT_NEAR(texel(made.meshMaps.albedo, 0).x, 0.5, 1e-6);
  EXPECT_EQ(texel(made.meshMaps.albedo, 1).x, 0);
  EXPECT_NEAR(texel(made.meshMaps.reflectance, 0).x, 0.04, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.reflectance, 1).x, 0.8, 1e-6);
  const auto index = [&](std::size_t i) {
    return f64::conductorIndex(static_cast<double>(texel(made.meshMaps.reflectance, i).x),
                               static_cast<double>(texel(made.meshMaps.metallic, i).x));
  };
  EXPECT_NEAR(index(0).eta, 1.5, 1e-5);  // the dielectric of index 1.5
  EXPECT_EQ(index(0).k, 0);
  prep::SourceMaterial metal;
  metal.baseColour = glm::dvec3(0.8);
  EXPECT_NEAR(index(1).eta, convertMaterial(metal, notes_).eta.x, 1e-6);
  EXPECT_NEAR(index(1).k, convertMaterial(metal, notes_).k.x, 1e-5);
}

TEST_F(MaterialMapsTest, MixedMetalHasTheLayersOfAMetal) {
  prep::SourceMaterial source;
  source.clearcoat = 0.25;
  source.specular = 0.5;
  source.metallicRoughnessImage = add(4, {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1});
  const pack::Material made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::metal);
  EXPECT_EQ(made.clearCoat.factor, 0.25);
  EXPECT_EQ(made.specularFactor, 1);
  ASSERT_EQ(notes_.size(), 2u);
  EXPECT_CONTAINS(notes_[0], "roughness of the clear coat");
  EXPECT_CONTAINS(notes_[1], "specular factor");
}

TEST_F(MaterialMapsTest, TheBaseColourTintsTheSurfaceOfBodies) {
  prep::SourceMaterial source;
  source.metallic = source.roughness = 0;
  source.transmission = 1;
  source.hasVolume = true;
  source.baseColour = {1, 0.5, 1};
  source.baseColourImage = add(2, {encoded(0.25), encoded(0.5), 1, 1, 1, 1});
  EXPECT_FALSE(convert(source).meshMaps.transmittance.isUsed());  // MTL: the colour of a diffuse reflection
  source.tintsTransmission = true;
  const pack::Material made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::glass);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 0).x, 0.25, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 0).y, 0.25, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 1).y, 0.5, 1e-6);
  EXPECT_NEAR(made.transmittanceParallel.x, 0.625, 1e-6);
}

// A pane of KHR_materials_transmission has the colour of its texels, whatever its alpha is, as without a texture.
TEST_F(MaterialMapsTest, BlendedPanesThatTransmitKeepTheirColour) {
  prep::SourceMaterial source;
  source.metallic = source.roughness = 0;
  source.transmission = 1;
  source.isThinWalled = source.tintsTransmission = true;
  source.alphaMode = prep::AlphaMode::blend;
  source.alpha = 0.2;
  source.baseColour = {0.1, 0.5, 1};
  const pack::Material factor = convert(source);
  ASSERT_EQ(factor.kind, MaterialKind::thinGlass);
  EXPECT_NEAR(factor.transmittanceParallel.x, 0.1, 1e-6);
  source.baseColourImage = add(2, {1, 1, 1, 1, encoded(0.5), 1});
  const pack::Material made = convert(source);
  ASSERT_EQ(made.kind, MaterialKind::thinGlass);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 0).x, 0.1, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 1).y, 0.25, 1e-6);
}

TEST_F(MaterialMapsTest, AlphaCutsOutOrBecomesAPane) {
  prep::SourceMaterial source;
  source.metallic = 0;
  source.alphaMode = prep::AlphaMode::mask;
  source.alphaCutoff = 0.7;
  source.alpha = 0.9;
  source.baseColourImage = add(2, {1, 1, 1, 0.5f, 1, 1, 1, 1});
  pack::Material made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::lambert);
  EXPECT_EQ(made.meshMaps.cutoff, 0.7);
  EXPECT_NEAR(texel(made.meshMaps.coverage, 0).x, 0.45, 1e-6);
  EXPECT_TRUE(notes_.empty());
  // Blended with sharp edges: cut out, and reported.
  source.alphaMode = prep::AlphaMode::blend;
  source.baseColourImage = add(2, {1, 1, 1, 0, 1, 1, 1, 1});
  made = convert(source);
  EXPECT_EQ(made.meshMaps.cutoff, 0.5);
  EXPECT_TRUE(made.meshMaps.coverage.isUsed());
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_CONTAINS(notes_[0], "blended alpha", "cut out");
  // Half transparent: a pane of the texels' transmittance.
  source.alpha = 1;
  source.baseColourImage = add(2, {1, 0, 0, 0.25f, 1, 0, 0, 0.5f});
  made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::thinGlass);
  EXPECT_FALSE(made.meshMaps.coverage.isUsed());
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 0).y, 0.75, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.transmittance, 1).y, 0.5, 1e-6);
  EXPECT_EQ(texel(made.meshMaps.transmittance, 1).x, 1);
}

TEST_F(MaterialMapsTest, EmissionAndNormals) {
  prep::SourceMaterial source;
  source.metallic = 0;
  source.baseColour = glm::dvec3(0.5);
  source.emissive = glm::dvec3(0.2);
  source.emissiveImage = add(4, {0, 0, 0, 0, 0, 0, 0, 0, 0, encoded(0.5), 0, 0});
  source.normalImage = add(1, {0.5f, 0.75f, 1});
  source.normalScale = 0.5;
  const pack::Material made = convert(source);
  EXPECT_EQ(made.kind, MaterialKind::lambert);
  EXPECT_NEAR(texel(made.meshMaps.radiance, 3).x, 0.1, 1e-6);
  EXPECT_NEAR(made.radiance.x, 0.025, 1e-6);
  EXPECT_EQ(texel(made.meshMaps.normal, 0), glm::vec3(0.5f, 0.75f, 1));
  EXPECT_EQ(made.meshMaps.normalScale, 0.5);
}

TEST_F(MaterialMapsTest, PlacesAreThoseOfTheTexture) {
  prep::SourceMaterial source;
  source.metallic = 0;
  source.baseColourImage = add(1, {1, 1, 1});
  prep::SourcePlacement& place = source.baseColourPlacement;
  place = {1, prep::SourceWrap::clamp, prep::SourceWrap::mirror, {0.25, 0.5}, {2, 3}, std::numbers::pi / 2};
  const pack::MeshMap map = convert(source).meshMaps.albedo;
  EXPECT_EQ(map.set, 1u);
  EXPECT_EQ(map.wrapU, pack::Wrap::clamp);
  EXPECT_EQ(map.wrapV, pack::Wrap::mirror);
  // A quarter counter-clockwise in the image, whose v points down: u' = 3 t + 0.25, v' = -2 s + 0.5.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(map.u[i], (glm::dvec3{0, 3, 0.25})[i], 1e-12);
    EXPECT_NEAR(map.v[i], (glm::dvec3{-2, 0, 0.5})[i], 1e-12);
  }
}

TEST_F(MaterialMapsTest, AUniformSpecularGlossinessGivesWhatTheFactorsGive) {
  for (const double f : {0.04, 0.2, 0.6})
    for (const double glossiness : {1.0, 0.7, 0.1}) {
      prep::SourceMaterial factor;
      factor.metallic = factor.ior = 0;
      factor.specularColour = glm::dvec3(f);
      factor.roughness = 1 - glossiness;
      const pack::Material expected = convertMaterial(factor, notes_);
      prep::SourceMaterial textured = factor;
      textured.specularColour = glm::dvec3(1);
      textured.roughness = 0;
      const float x = encoded(f), g = static_cast<float>(glossiness);
      textured.specularGlossinessImage = add(2, {x, x, x, g, x, x, x, g});
      const pack::Material made = convert(textured);
      EXPECT_EQ(made.kind, expected.kind) << f << ", " << glossiness;
      EXPECT_NEAR(made.roughness, expected.roughness, 1e-6);
      EXPECT_NEAR(made.eta.y, expected.eta.y, 1e-5);
      if (made.kind == MaterialKind::lambert) continue;
      EXPECT_NEAR(texel(made.meshMaps.roughness, 1).x, expected.roughness, 1e-6);
      EXPECT_FALSE(made.meshMaps.metallic.isUsed());
      if (made.kind == MaterialKind::paint)
        EXPECT_NEAR(texel(made.meshMaps.eta, 1).y, expected.eta.y, 1e-5);
      else
        EXPECT_NEAR(texel(made.meshMaps.reflectance, 1).y, f, 1e-6);
    }
}

TEST_F(MaterialMapsTest, TexelsOfSpecularGlossiness) {
  prep::SourceMaterial source;
  source.metallic = source.ior = 0;
  source.roughness = 0.5;  // glossiness 0.5, times that of the texel
  source.specularColour = glm::dvec3(0.5, 1, 1);
  source.specularGlossinessPlacement.wrapU = prep::SourceWrap::mirror;
  const float low = encoded(0.04), high = encoded(0.8);
  source.specularGlossinessImage = add(2, {high, low, low, 1, low, low, low, 0.5f});
  const pack::Material made = convert(source);
  ASSERT_EQ(made.kind, MaterialKind::metal);
  EXPECT_NEAR(texel(made.meshMaps.reflectance, 0).x, 0.4, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.reflectance, 1).x, 0.02, 1e-6);
  EXPECT_EQ(texel(made.meshMaps.metallic, 0), glm::vec3(1));
  EXPECT_EQ(texel(made.meshMaps.metallic, 1), glm::vec3(0));
  EXPECT_NEAR(texel(made.meshMaps.roughness, 0).x, 0.25, 1e-6);
  EXPECT_NEAR(texel(made.meshMaps.roughness, 1).x, 0.75 * 0.75, 1e-6);
  EXPECT_EQ(made.meshMaps.reflectance.wrapU, pack::Wrap::mirror);

  source.clearcoat = 1;  // its interface is that of the coat
  const pack::Material coated = convert(source);
  EXPECT_FALSE(coated.meshMaps.reflectance.isUsed() || coated.meshMaps.roughness.isUsed());
  EXPECT_TRUE(std::any_of(notes_.begin(), notes_.end(), [](const std::string& note) {
    return note.find("specular-glossiness texture") != std::string::npos;
  }));
}

}  // namespace
}  // namespace malus::bake

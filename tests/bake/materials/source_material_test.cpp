#include "bake/materials/source_material.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "bake/pack/format.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using Kind = pack::MaterialKind;

pack::Material made(const prep::SourceMaterial& source) {
  std::vector<std::string> ignored;
  return convertMaterial(source, ignored);
}

TEST(SourceMaterial, MetalReflectsItsBaseColour) {
  prep::SourceMaterial source;
  source.name = "brass";
  source.roughness = 0;
  for (const double r : {0.02, 0.3, 0.55, 0.9, 0.98}) {
    source.baseColour = {r, 0.5 * r, 0.25};
    const pack::Material metal = made(source);
    EXPECT_EQ(metal.kind, Kind::metal);
    EXPECT_EQ(metal.name, "brass");
    EXPECT_EQ(metal.roughness, 0);
    for (int c = 0; c < 3; ++c) {
      // The reflectance at normal incidence, from the amplitude (1 - m) / (1 + m) with m = eta - i k.
      const std::complex<double> m(metal.eta[c], -metal.k[c]);
      EXPECT_NEAR(std::norm((1.0 - m) / (1.0 + m)), source.baseColour[c], 1e-12);
    }
  }
  source.baseColour = {0, 1, 5};  // above 1
  const pack::Material metal = made(source);
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::isfinite(metal.k[c]));
    EXPECT_GE(std::max(metal.eta[c], metal.k[c]), pack::kMinEta);
  }
}

prep::SourceMaterial dielectric(double roughness) {
  prep::SourceMaterial source;
  source.name = "plastic";
  source.metallic = 0;
  source.roughness = roughness;
  source.baseColour = {0.2, 0.4, 0.6};
  return source;
}

// Fresnel's equations at normal incidence.
double normalReflectance(const pack::Material& m, int colour) {
  const std::complex<double> index(m.eta[colour], -m.k[colour]);
  return std::norm((1.0 - index) / (1.0 + index));
}

TEST(SourceMaterial, TheSpecularColourChangesTheIndex) {
  prep::SourceMaterial source = dielectric(0);
  EXPECT_EQ(made(source).eta, glm::dvec3(1.5));
  source.specularColour = {1, 0.5, 2};
  const pack::Material paint = made(source);
  EXPECT_EQ(paint.kind, Kind::paint);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(normalReflectance(paint, c), 0.04 * source.specularColour[c], 1e-12);
  source.specularColour = {0, 0, 0};
  EXPECT_EQ(made(source).kind, Kind::lambert);
  // Specular-glossiness: an index of 0 and the colour of the reflection.
  source.ior = 0;
  source.specularColour = {0.04, 0.09, 0.16};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(normalReflectance(made(source), c), source.specularColour[c], 1e-12);
}

TEST(SourceMaterial, ReflectancesOfNoDielectricAreMetal) {
  prep::SourceMaterial source = dielectric(0.5);
  source.ior = 0;
  source.specularColour = {0.9, 0.6, 0.3};
  const pack::Material metal = made(source);
  EXPECT_EQ(metal.kind, Kind::metal);
  EXPECT_EQ(metal.roughness, 0.25);
  EXPECT_EQ(metal.albedo, source.baseColour);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(normalReflectance(metal, c), source.specularColour[c], 1e-12);
  // Without a specular colour the reflectance is 1, at every angle.
  source.specularColour = {1, 1, 1};
  const pack::Material mirror = made(source);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(normalReflectance(mirror, c), 1, 1e-8);
}

TEST(SourceMaterial, TheSpecularFactorScalesTheReflection) {
  prep::SourceMaterial source = dielectric(0);
  source.specular = 0;
  EXPECT_EQ(made(source).kind, Kind::lambert);
  EXPECT_EQ(made(source).albedo, source.baseColour);
  source.specular = 0.5;
  std::vector<std::string> notes;
  const pack::Material paint = convertMaterial(source, notes);
  EXPECT_EQ(paint.kind, Kind::paint);
  EXPECT_EQ(paint.specularFactor, 0.5);
  EXPECT_EQ(paint.eta, glm::dvec3(1.5));  // the specular colour alone changes the index
  source.metallic = 1;
  EXPECT_EQ(convertMaterial(source, notes).specularFactor, 1);  // of the dielectric alone
  source.metallic = 0;
  source.transmission = 1;
  for (const bool isThin : {false, true}) {
    source.isThinWalled = isThin;
    source.specular = 0;
    EXPECT_EQ(convertMaterial(source, notes).specularFactor, 0);  // refracts still
    source.specular = 0.5;
    EXPECT_EQ(convertMaterial(source, notes).specularFactor, 0.5);
  }
  EXPECT_TRUE(notes.empty());
}

TEST(SourceMaterial, AClearCoatIsTheInterface) {
  prep::SourceMaterial source = dielectric(0.9);
  EXPECT_EQ(made(source).kind, Kind::lambert);
  source.clearcoat = 1;
  source.clearcoatRoughness = 0.5;
  std::vector<std::string> notes;
  for (const double roughness : {0.9, 0.3}) {
    source.roughness = roughness;
    const pack::Material coated = convertMaterial(source, notes);
    EXPECT_EQ(coated.kind, Kind::paint);
    EXPECT_EQ(coated.eta, glm::dvec3(1.5));
    EXPECT_EQ(coated.roughness, 0.25);
    EXPECT_EQ(coated.albedo, source.baseColour);
    EXPECT_EQ(coated.specularFactor, 1);
    EXPECT_EQ(coated.clearCoat.factor, 0);
  }
  // A share of a matt surface, and of one whose interface of the same index has another share.
  source.roughness = 0.9;
  for (const double share : {0.25, 0.75}) {
    source.clearcoat = share;
    EXPECT_EQ(convertMaterial(source, notes).specularFactor, share);
  }
  source.roughness = source.clearcoatRoughness = 0.3;
  source.specular = 0.5;
  EXPECT_EQ(convertMaterial(source, notes).specularFactor, 0.75 + 0.25 * 0.5);
  EXPECT_TRUE(notes.empty());
}

TEST(SourceMaterial, AClearCoatIsALayerOnOtherInterfaces) {
  prep::SourceMaterial source = dielectric(0);
  source.clearcoat = 0.5;
  std::vector<std::string> notes;
  const auto expectCoat = [&](Kind kind, double share) {
    const pack::Material coated = convertMaterial(source, notes);
    EXPECT_EQ(coated.kind, kind);
    EXPECT_EQ(coated.clearCoat.factor, share);
    EXPECT_EQ(coated.clearCoat.eta, 1.5);
    EXPECT_EQ(coated.specularFactor, 1);
  };
  source.ior = 1.8;
  expectCoat(Kind::paint, 0.5);
  source.transmission = 1;
  expectCoat(Kind::glass, 0.5);
  source.ior = 1.5;  // the coat's: it changes nothing
  expectCoat(Kind::glass, 0);
  source.isThinWalled = true;
  expectCoat(Kind::thinGlass, 0);
  source.transmission = 0;
  source.metallic = 1;
  expectCoat(Kind::metal, 0.5);
  EXPECT_TRUE(notes.empty());

  // Left out: a coat on thin glass, a film below a coat, a second roughness.
  source.roughness = 0.5;
  source.film = 1;
  source.filmThicknessNm = 300;
  const pack::Material metal = convertMaterial(source, notes);
  EXPECT_EQ(metal.roughness, 0.25);
  EXPECT_EQ(metal.coating.thicknessNm, 0);
  source = dielectric(0);
  source.ior = 1.8;
  source.transmission = 1;
  source.isThinWalled = true;
  source.clearcoat = 1;
  convertMaterial(source, notes);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_CONTAINS(notes[0], "roughness of the clear coat");
  EXPECT_CONTAINS(notes[1], "film below the clear coat");
  EXPECT_CONTAINS(notes[2], "clear coat on thin glass");
  for (const std::string& note : notes) EXPECT_CONTAINS(note, "'plastic'");
}

TEST(SourceMaterial, IridescenceIsAThinFilm) {
  prep::SourceMaterial source = dielectric(0);
  source.film = 1;
  source.filmIor = 1.7;
  source.filmThicknessNm = 350;
  for (const double metallic : {0.0, 1.0}) {
    source.metallic = metallic;
    EXPECT_EQ(made(source).coating.thicknessNm, 350);
    EXPECT_EQ(made(source).coating.eta, glm::dvec3(1.7));
  }
  std::vector<std::string> notes;
  source.metallic = 0;
  source.roughness = 1;
  EXPECT_EQ(convertMaterial(source, notes).coating.thicknessNm, 0);
  source.roughness = 0;
  source.film = 0.25;
  EXPECT_EQ(convertMaterial(source, notes).coating.thicknessNm, 0);
  ASSERT_EQ(notes.size(), 2u);
  for (const std::string& note : notes) EXPECT_CONTAINS(note, "'plastic'", "film");
}

TEST(SourceMaterial, BlendedPanesAreThinGlass) {
  prep::SourceMaterial source = dielectric(0);
  source.alphaMode = prep::AlphaMode::blend;
  source.alpha = 0.25;
  std::vector<std::string> notes;
  const pack::Material pane = convertMaterial(source, notes);
  EXPECT_EQ(pane.kind, Kind::thinGlass);
  EXPECT_EQ(pane.eta, glm::dvec3(1.5));
  EXPECT_NEAR(pane.transmittanceParallel.x, 0.8, 1e-12);  // a quarter absorbs 0.8 of the light
  EXPECT_NEAR(pane.transmittanceParallel.z, 0.9, 1e-12);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_CONTAINS(notes[0], "alpha", "'plastic'", "thin glass");
  source.alpha = 0.75;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::paint);
  EXPECT_CONTAINS(notes.back(), "opaque");
  EXPECT_FALSE(isInvisible(source));
  source.alpha = 0;
  EXPECT_TRUE(isInvisible(source));
  source.alphaMode = prep::AlphaMode::opaque;
  EXPECT_FALSE(isInvisible(source));
  source.alphaMode = prep::AlphaMode::mask;
  EXPECT_TRUE(isInvisible(source));
  source.alpha = source.alphaCutoff;
  EXPECT_FALSE(isInvisible(source));
}

TEST(SourceMaterial, FaintEmissionIsThatOfTheDiffuseLayer) {
  prep::SourceMaterial source = dielectric(1);
  source.emissive = {0.05, 0.05, 0.05};
  std::vector<std::string> notes;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::lambert);
  EXPECT_EQ(convertMaterial(source, notes).radiance, source.emissive);
  EXPECT_TRUE(notes.empty());
  prep::SourceMaterial window = source;
  window.transmission = 1;
  window.roughness = 0;
  EXPECT_EQ(convertMaterial(window, notes).radiance, glm::dvec3(0));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_CONTAINS(notes[0], "faint emission", "'plastic'");
  source.baseColour = {0, 0, 0};
  EXPECT_EQ(made(source).kind, Kind::emitter);
  source.baseColour = {0.2, 0.4, 0.6};
  source.emissive = {1, 1, 1};
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::emitter);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_CONTAINS(notes[1], "reflection of material", "'plastic'");
  source.emissive = {100, 100, 100};
  convertMaterial(source, notes);
  EXPECT_EQ(notes.size(), 2u);
  source.alphaMode = prep::AlphaMode::blend;
  source.transmission = 1;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::emitter);
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_CONTAINS(notes[2], "alpha", "opaque");
  EXPECT_CONTAINS(notes[3], "transmission");
}

TEST(SourceMaterial, GlassAbsorbsByItsVolume) {
  prep::SourceMaterial source;
  source.metallic = 0;
  source.transmission = 1;
  source.roughness = 0;
  source.ior = 1.33;
  EXPECT_EQ(made(source).kind, Kind::glass);
  EXPECT_EQ(made(source).eta, glm::dvec3(1.33));
  EXPECT_EQ(made(source).absorption, glm::dvec3(0));
  source.hasVolume = true;
  source.attenuationColour = {1, 0.5, 0};
  source.attenuationDistance = 0.02;
  const pack::Material glass = made(source);
  // The attenuation colour remains after the attenuation distance.
  EXPECT_NEAR(std::exp(-glass.absorption.x * 0.02), 1, 1e-12);
  EXPECT_NEAR(std::exp(-glass.absorption.y * 0.02), 0.5, 1e-12);
  EXPECT_NEAR(std::exp(-glass.absorption.z * 0.02), 1e-6, 1e-12);
  source.attenuationDistance = 1e-300;
  EXPECT_EQ(made(source).absorption.y, pack::kMaxAbsorption);

  source.baseColour = {0.5, 0.25, 1};  // of MTL: the diffuse reflection; of glTF: tints each passage
  EXPECT_EQ(made(source).transmittanceParallel, glm::dvec3(1));
  source.tintsTransmission = true;
  EXPECT_EQ(made(source).transmittanceParallel, source.baseColour);

  source.roughness = 0.5;
  source.name = "frosted";
  std::vector<std::string> notes;
  EXPECT_EQ(convertMaterial(source, notes).roughness, 0);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_CONTAINS(notes[0], "roughness", "'frosted'");
}

TEST(SourceMaterial, ThinWallsAreTintedPanes) {
  prep::SourceMaterial source;
  source.name = "window";
  source.metallic = 0;
  source.roughness = 0;
  source.transmission = 1;
  source.isThinWalled = source.tintsTransmission = true;
  source.ior = 1.52;
  source.baseColour = {1, 0.25, 0};
  source.attenuationColour = glm::dvec3(0.5);  // of a volume, which a wall does not have
  source.attenuationDistance = 1;
  std::vector<std::string> notes;
  const pack::Material pane = convertMaterial(source, notes);
  EXPECT_EQ(pane.kind, Kind::thinGlass);
  EXPECT_EQ(pane.eta, glm::dvec3(1.52));
  EXPECT_EQ(pane.transmittanceParallel, glm::dvec3(1, 0.25, 0));
  EXPECT_EQ(pane.absorption, glm::dvec3(0));
  EXPECT_TRUE(notes.empty());

  // Properties that a pane lacks are noted.
  source.roughness = 0.5;
  source.transmission = 0.75;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::thinGlass);
  EXPECT_EQ(convertMaterial(source, notes).roughness, 0);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("roughness of glass 'window'"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("opaque part of glass 'window'"), std::string::npos) << notes[1];
}

TEST(SourceMaterial, MetalsAndFaintTransmissionAreOpaque) {
  prep::SourceMaterial source;
  source.name = "foil";
  source.transmission = 1;  // without effect on a metal
  std::vector<std::string> notes;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::metal);
  EXPECT_TRUE(notes.empty());
  source.metallic = 0.4;
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::glass);
  source.transmission = 0.75;
  notes.clear();
  EXPECT_EQ(convertMaterial(source, notes).kind, Kind::lambert);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("transmission of material 'foil'"), std::string::npos) << notes[0];
}

TEST(SourceMaterial, DielectricsArePaintOrMatt) {
  prep::SourceMaterial source;
  source.metallic = 0.49;
  source.baseColour = {0.1, 0.2, 0.3};
  source.ior = 1.7;
  source.roughness = 0.4;
  const pack::Material paint = made(source);
  EXPECT_EQ(paint.kind, Kind::paint);
  EXPECT_EQ(paint.albedo, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(paint.eta, glm::dvec3(1.7));
  EXPECT_NEAR(paint.roughness, 0.16, 1e-12);
  source.roughness = 0.05;
  EXPECT_EQ(made(source).roughness, 0);
  source.roughness = 0.6;
  EXPECT_EQ(made(source).kind, Kind::lambert);
  EXPECT_EQ(made(source).albedo, glm::dvec3(0.1, 0.2, 0.3));
}

TEST(SourceMaterial, EmissionTakesPrecedence) {
  prep::SourceMaterial source;
  source.transmission = 1;
  source.emissive = {0, 40, 2};
  EXPECT_EQ(made(source).kind, Kind::emitter);
  EXPECT_EQ(made(source).radiance, glm::dvec3(0, 40, 2));
  EXPECT_FALSE(made(source).twoSided);
  source.isDoubleSided = true;
  EXPECT_TRUE(made(source).twoSided);
}

TEST(SourceMaterial, PartsWithoutMaterialAreMatt) {
  EXPECT_EQ(defaultMaterial().kind, Kind::lambert);
  EXPECT_EQ(defaultMaterial().albedo, glm::dvec3(0.8));
}

}  // namespace
}  // namespace malus::bake

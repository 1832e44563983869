// Published optical constants: bounds, sources, reflectances.
#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

#include "bake/materials/presets.h"
#include "bake/pack/scene.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using Complex = std::complex<long double>;

// Diattenuation (Rs - Rp)/(Rs + Rp) of a mirror in air, from the Fresnel amplitudes.
double diattenuation(double n, double k, double degrees) {
  const long double angle = static_cast<long double>(degrees) * std::acos(-1.0L) / 180;
  const Complex index(n, -k);
  const long double c = std::cos(angle), s = std::sin(angle);
  const Complex t = std::sqrt(Complex(1) - Complex(s * s) / (index * index));
  const long double rs = std::norm((c - index * t) / (c + index * t)),
                    rp = std::norm((index * c - t) / (index * c + t));
  return static_cast<double>((rs - rp) / (rs + rp));
}

// The constants of a preset at the default wavelengths.
OpticalConstants constants(const char* name) { return findPreset(name)->at(pack::kDefaultWavelengthsNm); }

double largestDiattenuation(const OpticalConstants& m, int colour) {
  double largest = 0;
  for (int i = 0; i < 9000; ++i) largest = std::max(largest, diattenuation(m.eta[colour], m.k[colour], i * 0.01));
  return largest;
}

TEST(Materials, PresetsOfTheScenes) {
  for (const char* name : {"bk7", "water", "gold", "silver", "copper", "aluminium", "iron", "chromium", "titanium"})
    EXPECT_NE(findPreset(name), nullptr) << name;
  EXPECT_EQ(findPreset("unobtainium"), nullptr);
  EXPECT_EQ(findPreset(""), nullptr);
}

TEST(Materials, WithinBoundsAndWithASource) {
  std::set<std::string> names;
  for (const Preset& preset : presets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_GT(preset.source.size(), 20u) << preset.name;
    const OpticalConstants m = constants(preset.name.c_str());
    const bool dielectric = m.k == glm::dvec3(0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(m.eta[c], dielectric ? 1.0 : pack::kMinEta) << preset.name;
      EXPECT_LE(m.eta[c], 10) << preset.name;
      EXPECT_GE(m.k[c], 0) << preset.name;
      EXPECT_LE(m.k[c], 10) << preset.name;
    }
    // Normal dispersion: the index of glass is larger in blue than in red.
    if (dielectric) {
      EXPECT_TRUE(m.eta.x < m.eta.y && m.eta.y < m.eta.z) << preset.name;
    }
    if (!dielectric) {
      EXPECT_TRUE(m.k.x > 1 && m.k.y > 1 && m.k.z > 1) << preset.name;
    }
  }
}

TEST(Materials, KnownIndices) {
  EXPECT_EQ(constants("bk7").eta.y, 1.5195);
  EXPECT_NEAR(constants("water").eta.y, 1.335, 1e-3);
  EXPECT_NEAR(constants("fused-silica").eta.y, 1.4607, 1e-4);
  EXPECT_NEAR(constants("diamond").eta.y, 2.426, 1e-3);
}

TEST(Materials, Bk7FollowsItsSellmeierFormula) {
  // Coefficients of the SCHOTT catalogue, wavelengths in micrometres.
  const double b[3] = {1.03961212, 0.231792344, 1.01046945}, c[3] = {0.00600069867, 0.0200179144, 103.560653};
  const double wavelengths[3] = {0.630, 0.532, 0.465};
  for (int i = 0; i < 3; ++i) {
    const double square = wavelengths[i] * wavelengths[i];
    double n2 = 1;
    for (int j = 0; j < 3; ++j) n2 += b[j] * square / (square - c[j]);
    EXPECT_NEAR(constants("bk7").eta[i], std::sqrt(n2), 6e-5) << wavelengths[i];
  }
}

TEST(Materials, OtherWavelengthsComeFromTheTables) {
  // Johnson and Christy's row at 0.5821 um; the catalogue's n_d.
  EXPECT_EQ(findPreset("gold")->at(OpticalData::Quantity::n, 582.1), 0.29);
  EXPECT_EQ(findPreset("gold")->at(OpticalData::Quantity::k, 582.1), 2.863);
  EXPECT_EQ(findPreset("bk7")->at(OpticalData::Quantity::n, 587.5618), 1.5168);
  for (const Preset& preset : presets()) {
    EXPECT_THROW(preset.at(OpticalData::Quantity::n, 100), Error) << preset.name;
    EXPECT_NO_THROW(preset.at({700, 550, 440})) << preset.name;
  }
}

TEST(Materials, LargestDiattenuationOfMetals) {
  // Johnson and Christy 1972, 1974; Rakic 1995; at 630, 532 and 465 nm.
  const struct {
    const char* name;
    double expected[3];
  } kMetals[] = {{"gold", {.05, .21, .52}},
                 {"copper", {.08, .36, .41}},
                 {"iron", {.67, .68, .66}},
                 {"chromium", {.67, .66, .59}},
                 {"aluminium", {.18, .14, .12}}};
  for (const auto& metal : kMetals)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(largestDiattenuation(constants(metal.name), c), metal.expected[c], 0.01) << metal.name << " " << c;
}

TEST(Materials, GlassPolarizesFully) { EXPECT_GT(largestDiattenuation(constants("bk7"), 1), 0.9999); }

TEST(Materials, ColoursOfMetals) {
  const auto reflectance = [](const char* name, int c) {
    const Complex index(constants(name).eta[c], -constants(name).k[c]);
    return static_cast<double>(std::norm((index - Complex(1)) / (index + Complex(1))));
  };
  EXPECT_GT(reflectance("gold", 0), 0.9);
  EXPECT_LT(reflectance("gold", 2), 0.45);
  EXPECT_GT(reflectance("copper", 0), 0.9);
  EXPECT_LT(reflectance("copper", 2), 0.65);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(reflectance("silver", c), 0.95) << c;
    EXPECT_NEAR(reflectance("aluminium", c), 0.915, 0.015) << c;
  }
}

}  // namespace
}  // namespace malus::bake

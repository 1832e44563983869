#include "meshprep/base/icc_profile.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>
#include <lcms2.h>

namespace malus::image {
namespace {

constexpr cmsCIExyY kD65 = {0.3127, 0.3290, 1};
constexpr cmsCIExyYTRIPLE kRec709 = {{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
constexpr cmsCIExyYTRIPLE kAdobe = {{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};

std::vector<unsigned char> saveAndClose(cmsHPROFILE profile) {
  cmsUInt32Number count = 0;
  EXPECT_TRUE(cmsSaveProfileToMem(profile, nullptr, &count));
  std::vector<unsigned char> bytes(count);
  EXPECT_TRUE(cmsSaveProfileToMem(profile, bytes.data(), &count));
  cmsCloseProfile(profile);
  return bytes;
}

cmsToneCurve* srgbCurve() {
  const std::array<double, 5> parameters = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  return cmsBuildParametricToneCurve(nullptr, 4, parameters.data());
}

// Forms of stored curves: parameters of ICC version 4, or samples of version 2. Takes the curve.
std::vector<unsigned char> rgbProfile(const cmsCIExyYTRIPLE& primaries, cmsToneCurve* curve, double version = 4.3) {
  const std::array<cmsToneCurve*, 3> curves = {curve, curve, curve};
  cmsHPROFILE profile = cmsCreateRGBProfile(&kD65, &primaries, curves.data());
  cmsSetProfileVersion(profile, version);
  cmsFreeToneCurve(curve);
  return saveAndClose(profile);
}

std::vector<unsigned char> greyProfile(cmsToneCurve* curve) {
  cmsHPROFILE profile = cmsCreateGrayProfile(&kD65, curve);
  cmsFreeToneCurve(curve);
  return saveAndClose(profile);
}

TEST(IccProfile, SrgbIsKnownByItsCurvesAndColorants) {
  EXPECT_TRUE(isSrgbProfile(saveAndClose(cmsCreate_sRGBProfile())));
  EXPECT_TRUE(isSrgbProfile(rgbProfile(kRec709, srgbCurve())));
  EXPECT_TRUE(isSrgbProfile(rgbProfile(kRec709, srgbCurve(), 2.1)));
  EXPECT_TRUE(isSrgbProfile(greyProfile(srgbCurve())));
}

TEST(IccProfile, OtherCurvesAndColorantsAreNotSrgb) {
  EXPECT_FALSE(isSrgbProfile(rgbProfile(kRec709, cmsBuildGamma(nullptr, 2.2))));
  EXPECT_FALSE(isSrgbProfile(rgbProfile(kRec709, cmsBuildGamma(nullptr, 1))));
  EXPECT_FALSE(isSrgbProfile(rgbProfile(kAdobe, srgbCurve())));
  EXPECT_FALSE(isSrgbProfile(greyProfile(cmsBuildGamma(nullptr, 1.8))));
  EXPECT_FALSE(isSrgbProfile(saveAndClose(cmsCreateLab4Profile(nullptr))));
}

TEST(IccProfile, DamagedProfilesAreNotSrgb) {
  const std::vector<unsigned char> bytes = saveAndClose(cmsCreate_sRGBProfile());
  EXPECT_FALSE(isSrgbProfile({}));
  // The first half has no curve yet.
  for (std::size_t size = 0; size < bytes.size() / 2; size += 7)
    EXPECT_FALSE(isSrgbProfile(std::span(bytes).first(size)));
}

}  // namespace
}  // namespace malus::image

#include "meshprep/base/icc_profile.h"

#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include <lcms2.h>

namespace malus::image {

namespace {

// The transfer function of sRGB (IEC 61966-2-1).
bool isSrgbCurve(cmsHPROFILE profile, cmsTagSignature tag) {
  const auto* curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tag));
  if (curve == nullptr) return false;
  for (const float x : {0.02f, 0.1f, 0.25f, 0.5f, 0.75f, 0.9f, 1.0f}) {
    const double encoded = static_cast<double>(x);
    const double expected = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    if (!(std::abs(static_cast<double>(cmsEvalToneCurveFloat(curve, x)) - expected) <= 0.005)) return false;
  }
  return true;
}

bool isColorant(cmsHPROFILE profile, cmsTagSignature tag, const cmsCIEXYZ& expected) {
  const auto* found = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tag));
  constexpr double kSame = 0.002;
  return found != nullptr && std::abs(found->X - expected.X) <= kSame && std::abs(found->Y - expected.Y) <= kSame &&
         std::abs(found->Z - expected.Z) <= kSame;
}

bool isNamedSrgb(cmsHPROFILE profile) {
  std::array<char, 256> name{};
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, cmsNoLanguage, cmsNoCountry, name.data(), name.size());
  return std::string_view(name.data()).find("sRGB") != std::string_view::npos;
}

}  // namespace

bool isSrgbProfile(std::span<const unsigned char> bytes) {
  const std::unique_ptr<void, cmsBool (*)(cmsHPROFILE)> profile(
      cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())), cmsCloseProfile);
  if (!profile) return false;
  if (cmsIsTag(profile.get(), cmsSigGrayTRCTag)) return isSrgbCurve(profile.get(), cmsSigGrayTRCTag);
  if (!cmsIsTag(profile.get(), cmsSigRedColorantTag)) return isNamedSrgb(profile.get());
  // Colorants of sRGB under D50 (ICC, "sRGB.icc").
  return isColorant(profile.get(), cmsSigRedColorantTag, {0.4361, 0.2225, 0.0139}) &&
         isColorant(profile.get(), cmsSigGreenColorantTag, {0.3851, 0.7169, 0.0971}) &&
         isColorant(profile.get(), cmsSigBlueColorantTag, {0.1431, 0.0606, 0.7141}) &&
         isSrgbCurve(profile.get(), cmsSigRedTRCTag) && isSrgbCurve(profile.get(), cmsSigGreenTRCTag) &&
         isSrgbCurve(profile.get(), cmsSigBlueTRCTag);
}

}  // namespace malus::image

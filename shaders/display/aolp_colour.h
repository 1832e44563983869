// Angle of linear polarization from 0 to pi as a hue at constant lightness and chroma in Oklab (B. Ottosson, A
// perceptual color space for image processing, 2020), for C++ (render/image/polarization.cpp) and GLSL (present.comp).

FN real cubed(real x) { return x * x * x; }

// Linear sRGB, up to rounding errors within 0 and 1. fade: 1; 0 is black.
FN real3 aolpLinearColour(real aolp, real fade) {
  // At lightness 0.75 every hue of chroma 0.125 is within sRGB. Hue 29 degrees is that of sRGB's red.
  const real kLightness = R(0.75), kChroma = R(0.125), kFirstHue = R(29 * 3.14159265358979323846 / 180);
  real hue = kFirstHue + 2 * aolp;
  real lightness = fade * kLightness, a = fade * kChroma * cos(hue), b = fade * kChroma * sin(hue);
  // Oklab to linear sRGB, with Ottosson's numbers.
  real l = cubed(lightness + R(0.3963377774) * a + R(0.2158037573) * b);
  real m = cubed(lightness - R(0.1055613458) * a - R(0.0638541728) * b);
  real s = cubed(lightness - R(0.0894841775) * a - R(1.2914855480) * b);
  real3 c;
  c.x = R(4.0767416621) * l - R(3.3077115913) * m + R(0.2309699292) * s;
  c.y = R(-1.2684380046) * l + R(2.6097574011) * m - R(0.3413193965) * s;
  c.z = R(-0.0041960863) * l - R(0.7034186147) * m + R(1.7076147010) * s;
  return c;
}

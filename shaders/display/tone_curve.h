// Linear radiance to the values of a display, for C++ (render/image/output.cpp) and GLSL (present.comp).

// Linear up to 0.7, above that an exponential shoulder that approaches 1. x: radiance times 2^exposure, at least 0.
FN real toneCurve(real x) {
  const real kLinear = R(0.7);
  return x > kLinear ? kLinear + (1 - kLinear) * (1 - exp(-(x - kLinear) / (1 - kLinear))) : x;
}

// The sRGB curve (IEC 61966-2-1). x: 0 to 1.
FN real srgbCurve(real x) { return x <= R(0.0031308) ? R(12.92) * x : R(1.055) * pow(x, 1 / R(2.4)) - R(0.055); }

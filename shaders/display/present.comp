// Shows rendered images: the filter on their Stokes vectors, exposure and tone curve, or a quantity of the polarization
// by colours. No ray is traced.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/gpu/language.glsl"
#include "shaders/display/tone_curve.h"
#include "shaders/display/aolp_colour.h"
#include "shaders/display/signed_colour.h"
#include "shaders/display/display_parameters.h"

layout(local_size_x = 16, local_size_y = 4) in;
layout(push_constant) uniform Parameters { DisplayParameters parameters; };
layout(binding = 0, rgba8) uniform writeonly image2D targetImage;
layout(binding = 1) readonly buffer Coarse0 { float coarse0[]; };
layout(binding = 2) readonly buffer Coarse1 { float coarse1[]; };
layout(binding = 3) readonly buffer Fine0 { float fine0[]; };
layout(binding = 4) readonly buffer Fine1 { float fine1[]; };
layout(binding = 5) readonly buffer Reference { float referencePixels[]; };
layout(binding = 6) readonly buffer Flip { float flipValues[]; };

layout(constant_id = 0) const uint kShown = 0u;  // viewer::Quantity
layout(constant_id = 1) const bool kInterpolates = true;
const uint kColour = 0u, kDolp = 1u, kAolp = 2u, kS1 = 3u, kS2 = 4u, kS3 = 5u, kDifference = 6u, kFlip = 7u;
const uint kStokesChannels = 15u;
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
const float kAolpFadeDolp = 0.05;  // as in render/image/polarization.h
const vec3 kNone = vec3(0.02);     // no image yet

#define MALUS_COLOUR(r, g, b) vec3(r, g, b) / 255.0,
#define MALUS_LAST_COLOUR(r, g, b) vec3(r, g, b) / 255.0
const vec3 kViridis[18] = vec3[](
#include "shaders/display/viridis.def"
);

vec3 viridis(float value) {
  float x = clamp(value, 0.0, 1.0) * 17.0;
  int i = min(int(x), 16);
  return mix(kViridis[i], kViridis[i + 1], x - float(i));
}

// Light of a pixel: the colour behind the filter, and the luminance of S0 to S3 in front of it. Only what is shown is
// read: reading is most of the work.
struct Light {
  vec3 colour;
  vec4 stokes;
};
const bool kShowsStokes = kShown >= kDolp && kShown <= kS3;

#define READER(NAME, BUFFER)                                                                           \
  vec3 NAME##At(uint i) { return vec3(BUFFER[i], BUFFER[i + 1u], BUFFER[i + 2u]); }                    \
  Light NAME(uint pixel, uint channels) {                                                              \
    uint i = pixel * channels;                                                                         \
    Light light;                                                                                       \
    light.stokes = vec4(0.0);                                                                          \
    light.colour = vec3(0.0);                                                                          \
    if (kShowsStokes) {                                                                                \
      light.stokes.x = dot(NAME##At(i), kLuminance);                                                   \
      if (channels < kStokesChannels) return light;                                                    \
      light.stokes.x = dot(NAME##At(i + 3u), kLuminance);                                              \
      if (kShown != kS2 && kShown != kS3) light.stokes.y = dot(NAME##At(i + 6u), kLuminance);          \
      if (kShown != kS1 && kShown != kS3) light.stokes.z = dot(NAME##At(i + 9u), kLuminance);          \
      if (kShown == kS3) light.stokes.w = dot(NAME##At(i + 12u), kLuminance);                          \
      return light;                                                                                    \
    }                                                                                                  \
    vec4 f = parameters.analyser;                                                                      \
    if (channels < kStokesChannels) {                                                                  \
      light.colour = NAME##At(i);                                                                      \
      return light;                                                                                    \
    }                                                                                                  \
    light.colour = f.x * NAME##At(i + 3u);                                                             \
    if (f.y != 0.0 || f.z != 0.0) light.colour += f.y * NAME##At(i + 6u) + f.z * NAME##At(i + 9u);      \
    if (f.w != 0.0) light.colour += f.w * NAME##At(i + 12u);                                           \
    light.colour = max(light.colour, vec3(0.0));                                                       \
    return light;                                                                                      \
  }
READER(readCoarse0, coarse0)
READER(readCoarse1, coarse1)
READER(readFine0, fine0)
READER(readFine1, fine1)
READER(readReference, referencePixels)

Light readCoarse(uint side, uint pixel, uint channels) {
  if (side == 0u) return readCoarse0(pixel, channels);
  return readCoarse1(pixel, channels);
}
Light readFine(uint side, uint pixel, uint channels) {
  if (side == 0u) return readFine0(pixel, channels);
  return readFine1(pixel, channels);
}

Light mixLight(Light a, Light b, float t) {
  Light light;
  light.colour = mix(a.colour, b.colour, t);
  light.stokes = mix(a.stokes, b.stokes, t);
  return light;
}

// The coarse image at a point of the window, 0 to 1: between its four nearest pixels or, on a CPU, where reading them
// takes as long as tracing them, the nearest.
Light stretchCoarse(uint side, vec2 at) {
  DisplayImage image = parameters.coarse[side];
  if (!kInterpolates) {
    uvec2 nearest = min(uvec2(at * vec2(image.width, image.height)), uvec2(image.width, image.height) - 1u);
    return readCoarse(side, nearest.y * image.width + nearest.x, image.channels);
  }
  vec2 last = vec2(image.width - 1u, image.height - 1u);
  vec2 position = clamp(at * vec2(image.width, image.height) - 0.5, vec2(0.0), last);
  uvec2 low = uvec2(position), high = min(low + 1u, uvec2(last));
  vec2 t = position - vec2(low);
  uint c = image.channels, w = image.width;
  Light upper = mixLight(readCoarse(side, low.y * w + low.x, c), readCoarse(side, low.y * w + high.x, c), t.x);
  Light lower = mixLight(readCoarse(side, high.y * w + low.x, c), readCoarse(side, high.y * w + high.x, c), t.x);
  return mixLight(upper, lower, t.y);
}

// Light of a side at a pixel of the window. Returns false if there is no image.
bool readSide(uint side, uvec2 pixel, vec2 at, out Light light) {
  DisplayImage image = parameters.fine[side];
  light.colour = vec3(0.0);
  light.stokes = vec4(0.0);
  if (image.rows > 0u) {
    // Of the size of the window, except just after a change of that size.
    uvec2 nearest = min(uvec2(at * vec2(image.width, image.height)), uvec2(image.width, image.height) - 1u);
    if (nearest.y < image.rows) {
      light = readFine(side, nearest.y * image.width + nearest.x, image.channels);
      return true;
    }
  }
  if (parameters.coarse[side].rows == 0u) return false;
  light = stretchCoarse(side, at);
  return true;
}

vec3 displayed(vec3 radiance) {
  vec3 x = clamp(radiance * parameters.gain, vec3(0.0), vec3(1e6));
  return vec3(srgbCurve(toneCurve(x.x)), srgbCurve(toneCurve(x.y)), srgbCurve(toneCurve(x.z)));
}

float degreeOfLinearPolarization(vec4 s) { return s.x > 0.0 ? min(length(s.yz) / s.x, 1.0) : 0.0; }

vec3 aolpColour(vec4 s) {
  float aolp = s.y == 0.0 && s.z == 0.0 ? 0.0 : 0.5 * atan(s.z, s.y);
  vec3 c = clamp(aolpLinearColour(aolp, clamp(degreeOfLinearPolarization(s) / kAolpFadeDolp, 0.0, 1.0)), 0.0, 1.0);
  return vec3(srgbCurve(c.x), srgbCurve(c.y), srgbCurve(c.z));
}

// Difference of a side to the other side or to the reference.
vec3 differenceColour(uint side, Light light, uvec2 pixel, vec2 at) {
  Light other;
  if (parameters.againstOther == 1u) {
    if (!readSide(1u - side, pixel, at, other)) return kNone;
  } else {
    if (pixel.y >= parameters.referenceRows) return kNone;
    other = readReference(pixel.y * (parameters.target & 0xffffu) + pixel.x, kStokesChannels);
  }
  vec3 d = abs(light.colour - other.colour) * parameters.gain / parameters.differenceScale;
  return viridis(max(d.x, max(d.y, d.z)));
}

vec3 shownColour(uint side, uvec2 pixel, vec2 at) {
  Light light;
  if (!readSide(side, pixel, at, light)) return kNone;
  switch (kShown) {
    case kDolp: return viridis(degreeOfLinearPolarization(light.stokes));
    case kAolp: return aolpColour(light.stokes);
    case kS1: return signedColour(light.stokes.x > 0.0 ? light.stokes.y / light.stokes.x : 0.0);
    case kS2: return signedColour(light.stokes.x > 0.0 ? light.stokes.z / light.stokes.x : 0.0);
    case kS3: return signedColour(light.stokes.x > 0.0 ? light.stokes.w / light.stokes.x : 0.0);
    case kDifference: return differenceColour(side, light, pixel, at);
    case kFlip: {
      uvec2 size = uvec2(parameters.target & 0xffffu, parameters.target >> 16u);
      if (uint(flipValues.length()) < 2u * size.x * size.y) return kNone;
      return viridis(flipValues[(side * size.y + pixel.y) * size.x + pixel.x]);
    }
    default: return displayed(light.colour);
  }
}

void main() {
  uvec2 size = uvec2(parameters.target & 0xffffu, parameters.target >> 16u), pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  vec2 centre = vec2(pixel) + 0.5;
  uint side = centre.x < parameters.divider ? 0u : 1u;
  imageStore(targetImage, ivec2(pixel), vec4(shownColour(side, pixel, centre / vec2(size)), 1.0));
}

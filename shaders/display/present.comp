// Shows rendered images: the filter on their Stokes vectors, exposure and tone curve, or a quantity of the polarization
// by colours. No ray is traced.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require

#include "shaders/gpu/language.glsl"
#include "shaders/display/tone_curve.h"
#include "shaders/display/aolp_colour.h"
#include "shaders/display/signed_colour.h"

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer FloatBuffer { float values[]; };
#include "shaders/display/display_parameters.h"

layout(local_size_x = 16, local_size_y = 4) in;
layout(push_constant) uniform Parameters { DisplayParameters parameters; };
layout(binding = 0, rgba8) uniform writeonly image2D targetImage;

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

vec3 rgb(FloatBuffer pixels, uint i) { return vec3(pixels.values[i], pixels.values[i + 1u], pixels.values[i + 2u]); }
float luminance(FloatBuffer pixels, uint i) { return dot(rgb(pixels, i), kLuminance); }

Light readLight(FloatBuffer pixels, uint pixel, uint channels) {
  uint i = pixel * channels;
  Light light;
  light.stokes = vec4(0.0);
  light.colour = vec3(0.0);
  bool hasStokes = channels == kStokesChannels;
  if (kShowsStokes) {
    light.stokes.x = luminance(pixels, hasStokes ? i + 3u : i);
    if (!hasStokes) return light;
    if (kShown != kS2 && kShown != kS3) light.stokes.y = luminance(pixels, i + 6u);
    if (kShown != kS1 && kShown != kS3) light.stokes.z = luminance(pixels, i + 9u);
    if (kShown == kS3) light.stokes.w = luminance(pixels, i + 12u);
    return light;
  }
  if (!hasStokes) {
    light.colour = rgb(pixels, i);
    return light;
  }
  vec4 f = parameters.analyser;
  light.colour = f.x * rgb(pixels, i + 3u);
  if (f.y != 0.0 || f.z != 0.0) light.colour += f.y * rgb(pixels, i + 6u) + f.z * rgb(pixels, i + 9u);
  if (f.w != 0.0) light.colour += f.w * rgb(pixels, i + 12u);
  light.colour = max(light.colour, vec3(0.0));
  return light;
}

uvec2 unpack(uint packed) { return uvec2(packed & 0xffffu, packed >> 16u); }

Light mixLight(Light a, Light b, float t) {
  Light light;
  light.colour = mix(a.colour, b.colour, t);
  light.stokes = mix(a.stokes, b.stokes, t);
  return light;
}

// A coarse image at a point of the window, 0 to 1: between its four nearest pixels or, on a CPU, where reading them takes
// as long as tracing them, the nearest.
Light stretchCoarse(DisplayImage image, vec2 at) {
  uvec2 size = unpack(image.size), last = size - 1u;
  uint channels = image.rows >> 16u;
  if (!kInterpolates) {
    uvec2 nearest = min(uvec2(at * vec2(size)), last);
    return readLight(image.pixels, nearest.y * size.x + nearest.x, channels);
  }
  vec2 position = clamp(at * vec2(size) - 0.5, vec2(0.0), vec2(last));
  uvec2 low = uvec2(position), high = min(low + 1u, last);
  vec2 t = position - vec2(low);
  Light upper = mixLight(readLight(image.pixels, low.y * size.x + low.x, channels),
                         readLight(image.pixels, low.y * size.x + high.x, channels), t.x);
  Light lower = mixLight(readLight(image.pixels, high.y * size.x + low.x, channels),
                         readLight(image.pixels, high.y * size.x + high.x, channels), t.x);
  return mixLight(upper, lower, t.y);
}

// Light of a side at a point of the window. Returns false if there is no image.
bool readSide(uint side, vec2 at, out Light light) {
  DisplayImage image = parameters.fine[side];
  uint rows = image.rows & 0xffffu;
  light.colour = vec3(0.0);
  light.stokes = vec4(0.0);
  if (rows > 0u) {
    // Of the size of the window, except just after a change of that size.
    uvec2 size = unpack(image.size), nearest = min(uvec2(at * vec2(size)), size - 1u);
    if (nearest.y < rows) {
      light = readLight(image.pixels, nearest.y * size.x + nearest.x, image.rows >> 16u);
      return true;
    }
  }
  if ((parameters.coarse[side].rows & 0xffffu) == 0u) return false;
  light = stretchCoarse(parameters.coarse[side], at);
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
  if ((parameters.flags & kDisplayAgainstOther) != 0u) {
    if (!readSide(1u - side, at, other)) return kNone;
  } else {
    if (pixel.y >= parameters.referenceRows) return kNone;
    uint width = parameters.target & 0xffffu;
    other = readLight(parameters.reference, pixel.y * width + pixel.x, kStokesChannels);
  }
  vec3 d = abs(light.colour - other.colour) * parameters.gain / parameters.differenceScale;
  return viridis(max(d.x, max(d.y, d.z)));
}

vec3 shownColour(uint side, uvec2 pixel, vec2 at) {
  Light light;
  if (!readSide(side, at, light)) return kNone;
  switch (kShown) {
    case kDolp: return viridis(degreeOfLinearPolarization(light.stokes));
    case kAolp: return aolpColour(light.stokes);
    case kS1: return signedColour(light.stokes.x > 0.0 ? light.stokes.y / light.stokes.x : 0.0);
    case kS2: return signedColour(light.stokes.x > 0.0 ? light.stokes.z / light.stokes.x : 0.0);
    case kS3: return signedColour(light.stokes.x > 0.0 ? light.stokes.w / light.stokes.x : 0.0);
    case kDifference: return differenceColour(side, light, pixel, at);
    case kFlip: {
      if ((parameters.flags & kDisplayHasFlip) == 0u) return kNone;
      uvec2 size = unpack(parameters.target);
      return viridis(parameters.flipValues.values[(side * size.y + pixel.y) * size.x + pixel.x]);
    }
    default: return displayed(light.colour);
  }
}

void main() {
  uvec2 size = unpack(parameters.target), pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  vec2 centre = vec2(pixel) + 0.5;
  uint side = centre.x < parameters.divider ? 0u : 1u;
  imageStore(targetImage, ivec2(pixel), vec4(shownColour(side, pixel, centre / vec2(size)), 1.0));
}

#include "meshprep/compress/bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::compress {

namespace {

constexpr std::string_view kLocation = "meshes to compress";

void requireBound(const std::optional<double>& bound, std::string_view what) {
  if (bound && !(*bound > 0 && std::isfinite(*bound)))
    throw Error(kLocation, what, "a positive, finite number", fmt::to_string(*bound));
}

void requireBits(const std::optional<int>& bits, int low, int high, std::string_view what) {
  if (bits && (*bits < low || *bits > high))
    throw Error(kLocation, what, fmt::format("{} to {}", low, high), fmt::to_string(*bits));
}

void checkGivenBounds(const Deviation& deviation, const Settings& used, const Bounds& bounds, std::string_view where) {
  if (bounds.positionError && !(deviation.positionMax <= *bounds.positionError))
    throw Error(where, "position error exceeds the bound",
                fmt::format("at most {:g} m (--position-error)", *bounds.positionError),
                fmt::format("{:.3g} m with {} bits in steps of {:.3g} m", deviation.positionMax, used.grid.positionBits,
                            used.grid.step));
  if (bounds.normalErrorDegrees && !(deviation.normalMaxDegrees <= *bounds.normalErrorDegrees))
    throw Error(where, "normal error exceeds the bound",
                fmt::format("at most {:g} degrees (--normal-error)", *bounds.normalErrorDegrees),
                fmt::format("{:.3g} degrees with {} bits", deviation.normalMaxDegrees, used.normalBits));
}

// Advice for faces that are too low for the grid.
std::string repair(const Settings& used, const Bounds& bounds) {
  if (bounds.positionBits && *bounds.positionBits < kMaxPositionBits) return "more bits (--position-bits)";
  return fmt::format("faces higher than {:.3g} m, or a smaller mesh: split it into parts, or remove its thin faces",
                     used.grid.step / std::tan(kDefaultTiltDegrees * std::numbers::pi / 180));
}

}  // namespace

void requireValid(const Bounds& bounds) {
  requireBound(bounds.positionError, "position error out of range");
  requireBound(bounds.normalErrorDegrees, "normal error out of range");
  requireBound(bounds.uvErrorTexels, "error of texture coordinates out of range");
  requireBits(bounds.positionBits, 1, kMaxPositionBits, "number of position bits out of range");
  requireBits(bounds.normalBits, kMinNormalBits, kMaxNormalBits, "number of normal bits out of range");
}

DeviationLimits deviationLimits(const Bounds& bounds) {
  DeviationLimits limits;
  if (bounds.positionError) limits.position = *bounds.positionError;
  limits.normalDegrees = bounds.normalErrorDegrees.value_or(kDefaultNormalErrorDegrees);
  limits.tiltDegrees = kDefaultTiltDegrees;
  limits.newDegenerate = false;
  return limits;
}

DeviationLimits limitsBefore(const Magnification& m, DeviationLimits limits) {
  limits.position /= m.largest;
  limits.normalDegrees /= m.angle;
  limits.tiltDegrees /= m.angle;
  limits.leastCross /= m.smallest * m.smallest;
  return limits;
}

Deviation deviationAfter(const Magnification& m, Deviation deviation) {
  deviation.positionMax *= m.largest;
  deviation.normalMaxDegrees *= m.angle;
  deviation.tiltMaxDegrees *= m.angle;
  if (deviation.tiltMaxDegrees > kDefaultTiltDegrees) deviation.tilted = std::max<std::uint64_t>(deviation.tilted, 1);
  return deviation;
}

std::vector<std::string> checkBounds(const Deviation& deviation, const Settings& used, const Bounds& bounds, bool glass,
                                     std::string_view where) {
  checkGivenBounds(deviation, used, bounds, where);
  if (deviation.flipped > 0)
    throw Error(where,
                fmt::format("rounding turns {} upside down with {} position bits, first face {}",
                            deviation.flipped == 1 ? "1 face" : fmt::format("{} faces", deviation.flipped),
                            used.grid.positionBits, deviation.flippedFace),
                repair(used, bounds));

  // Check the default bounds.
  std::vector<std::string> warnings;
  const auto report = [&](const std::string& problem) {
    if (glass) throw Error(where, problem, repair(used, bounds));
    warnings.push_back(fmt::format("{}: {}", where, problem));
  };
  if (!bounds.normalErrorDegrees && deviation.normalMaxDegrees > kDefaultNormalErrorDegrees)
    warnings.push_back(fmt::format("{}: normal error {:.3g} degrees with {} bits exceeds {:g} degrees", where,
                                   deviation.normalMaxDegrees, used.normalBits, kDefaultNormalErrorDegrees));
  if (deviation.tilted > 0)
    report(
        fmt::format("{} of {:.3g} m^2 tilt by more than {:g} degrees with {} position bits, at most by {:.3g} "
                    "degrees at face {}",
                    deviation.tilted == 1 ? "1 face" : fmt::format("{} faces", deviation.tilted), deviation.tiltedArea,
                    kDefaultTiltDegrees, used.grid.positionBits, deviation.tiltMaxDegrees, deviation.tiltFace));
  if (deviation.newDegenerate > 0 && deviation.newDegenerate == deviation.faces)
    throw Error(where, "all faces lose their area", "a larger mesh, or more bits (--position-bits)",
                fmt::format("{} faces of {:.3g} m^2 in steps of {:.3g} m", deviation.faces, deviation.degenerateArea,
                            used.grid.step));
  if (deviation.newDegenerate > 0)
    report(fmt::format("{} of {:.3g} m^2 lose their area with {} position bits, first face {}",
                       deviation.newDegenerate == 1 ? "1 face" : fmt::format("{} faces", deviation.newDegenerate),
                       deviation.degenerateArea, used.grid.positionBits, deviation.degenerateFace));
  return warnings;
}

RoundedTextures roundTextures(const TextureView& source, double texels, const Bounds& bounds, std::string_view where) {
  requireValid(bounds);
  return roundTextures(source, texels, bounds.uvErrorTexels.value_or(kDefaultUvErrorTexels),
                       bounds.normalErrorDegrees.value_or(kDefaultNormalErrorDegrees), where);
}

std::vector<std::string> checkTextures(const TextureDeviation& deviation, const TextureGrids& used,
                                       const Bounds& bounds, std::string_view where) {
  const std::string uv = fmt::format("{:.3g} texels with steps of {:g}", deviation.uvTexels,
                                     std::max(used.sets[0].step, used.sets[1].step));
  const std::string tangent = fmt::format("{:.3g} degrees with {} bits", deviation.tangentDegrees, used.tangentBits);
  if (bounds.uvErrorTexels && !(deviation.uvTexels <= *bounds.uvErrorTexels))
    throw Error(
        where, "error of texture coordinates exceeds the bound",
        fmt::format("at most {:g} texels (--max-uv-error), or a smaller range of coordinates", *bounds.uvErrorTexels),
        uv);
  if (bounds.normalErrorDegrees && !(deviation.tangentDegrees <= *bounds.normalErrorDegrees))
    throw Error(where, "error of tangents exceeds the bound",
                fmt::format("at most {:g} degrees (--normal-error)", *bounds.normalErrorDegrees), tangent);
  std::vector<std::string> warnings;
  if (!bounds.uvErrorTexels && deviation.uvTexels > kDefaultUvErrorTexels)
    warnings.push_back(
        fmt::format("{}: error of texture coordinates, {}, exceeds {:g}", where, uv, kDefaultUvErrorTexels));
  if (!bounds.normalErrorDegrees && deviation.tangentDegrees > kDefaultNormalErrorDegrees)
    warnings.push_back(
        fmt::format("{}: error of tangents, {}, exceeds {:g} degrees", where, tangent, kDefaultNormalErrorDegrees));
  return warnings;
}

}  // namespace malus::compress

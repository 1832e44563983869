// Contents of a pack as `malus info` prints them: text and JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"
#include "bake/polarization_probe.h"

namespace malus::bake {

// Share of the light that bounces deeper than the reported one may change.
inline constexpr double kInfoTolerance = 1e-3;

// {formatVersion, hash, name, title, resolution[2], depth, vertices, triangles, geometryHash,
//  positionBits, sourceMap, meshes[{name, vertices, triangles, material, openSurface, encoding, normalBits,
//  errors{positionMax, normalMaxDegrees, tiltMaxDegrees}}], materials[{...: the fields of bake/FORMAT.md}], lights,
//  effects[{name, on, reason}], polarizationErrorBound[3], withoutPolarization{width, height, relRms,
//  shareOver1Percent}, deepestBounce{tolerance, bounce, measured}, sections[{id, version, offset, sizeBytes, hash}],
//  provenance}; positionBits, normalBits and errors are null if the pack has no ENCD; withoutPolarization is null
//  unless it was measured, because the bound is above 1; deepestBounce.measured is null if the bake measured no light
// measure: empty: nothing is measured.
nlohmann::json infoJson(const pack::Pack& pack, double tolerance = kInfoTolerance,
                        const MeasurePolarization& measure = {});
std::string infoText(const pack::Pack& pack, double tolerance = kInfoTolerance,
                     const MeasurePolarization& measure = {});

}  // namespace malus::bake

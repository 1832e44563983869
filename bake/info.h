// What `malus info` tells of a pack, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/pack/reader.h"

namespace malus::bake {

// Share of the light that the deepest bounce named may change.
inline constexpr double kInfoTolerance = 1e-3;

// {formatVersion, hash, name, title, resolution[2], depth, vertices, triangles, geometryHash,
//  positionBits, sourceMap, meshes[{name, vertices, triangles, material, sheet, encoding, normalBits,
//  errors{positionMax, normalMaxDegrees, tiltMaxDegrees}}], materials[{name, type, eta[3], k[3]}], lights,
//  effects[{name, on, reason}], polarizationErrorBound[3], deepestBounce{tolerance, bounce}, sections[{id, version,
//  offset, sizeBytes, hash}], provenance}; positionBits, normalBits and errors are null where the pack does not say how
//  it was encoded
nlohmann::json infoJson(const pack::Pack& pack, double tolerance = kInfoTolerance);
std::string infoText(const pack::Pack& pack, double tolerance = kInfoTolerance);

}  // namespace malus::bake

// Report of `malus bake` on a pack that it wrote, as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/writer.h"

namespace malus::bake {

// rebaked: a previous pack had meshes that could be reused.
// {name, output, upToDate: false, sizeBytes, vertices, triangles, bytesPerTriangle, positionBits, reencoded,
//  fullRebakeReason, meshes[{name, encoding, sequentialReason, triangles, sizeBytes, bytesPerTriangle, normalBits,
//  reused, encodeMs, decodeMs, errors{positionMax, normalMaxDegrees, tiltMaxDegrees, flipped, degenerate}}],
//  preparation[...: meshprep/report.h], errors{positionMax, normalMaxDegrees, tiltMaxDegrees}, notes[], warnings[]}.
// Errors of positions are in metres and include the rounding to float; times are wall-clock milliseconds, 0 for reused
// meshes.
nlohmann::json bakeJson(const Baked& baked, const pack::Written& written, const std::string& output);
std::string bakeText(const Baked& baked, const pack::Written& written, const std::string& output, bool rebaked);

}  // namespace malus::bake

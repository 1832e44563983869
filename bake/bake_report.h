// What `malus bake` tells of a pack that it wrote, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/writer.h"

namespace malus::bake {

// rebaked: there was an older pack whose meshes could have been taken.
// {name, output, upToDate: false, sizeBytes, vertices, triangles, bytesPerTriangle, positionBits, redone, whyAll,
//  meshes[{name, encoding, sequentialReason, triangles, sizeBytes, bytesPerTriangle, normalBits, kept, encodeMs,
//  decodeMs, errors{positionMax, normalMaxDegrees, tiltMaxDegrees, flipped, degenerate}}], preparation[...:
//  meshprep/report.h], errors{positionMax, normalMaxDegrees, tiltMaxDegrees}, warnings[]}. Errors of positions in
//  metres, with the rounding
// to float; times in wall-clock milliseconds, 0 for meshes that were kept.
nlohmann::json bakeJson(const Baked& baked, const pack::Written& written, const std::string& output);
std::string bakeText(const Baked& baked, const pack::Written& written, const std::string& output, bool rebaked);

}  // namespace malus::bake

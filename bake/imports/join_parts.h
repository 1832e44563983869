// Bodies of glass that a file spreads over several parts. Exporters cut a mesh into primitives, at 65535 vertices or by
// texture coordinates, or into nodes. None of these parts is closed, but together they are one body.
//
// Two parts are neighbours if they have the same placements (the transforms of their instances) and an open edge of
// one is at the positions of an open edge of the other, within the weld tolerance. An open edge has one face in its
// part. Parts that are closed, and parts of materials without an inside, have no neighbours to join.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "meshprep/certify/certificate.h"
#include "meshprep/prepare.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

// A part in the scene.
struct PartUse {
  std::uint32_t material = 0;  // index into the scene's materials
  std::string materialName;
  bool isGlassBody = false;  // the material has an inside, and no instance is an open surface
};

// Joins neighbours that are glass bodies of one material of the scene into the first of them. The parts keep their
// indices; joined ones lose their faces and instances. An instance of a whole mesh gets the name of its node. Returns a
// note for each joined body. uses: one per part. Nothing is joined if the preparation does not weld.
std::vector<std::string> joinParts(prep::SourceScene& source, const std::vector<PartUse>& uses,
                                   const prep::Options& preparation);

// Returns the reason why a glass body with open edges is not closed: a neighbour of another material. Nothing without
// one.
std::optional<prep::Problem> findSpreadBody(const prep::SourceScene& source, const std::vector<PartUse>& uses,
                                            std::size_t part, const prep::Options& preparation);

// Returns "a, b and c", or the first eight names and the number of the others.
std::string listNames(const std::vector<std::string>& names);

}  // namespace malus::bake

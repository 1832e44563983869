// What an earlier bake left at the output: whether it is what baking would make, and whether its meshes may be taken.
//
// What is reused is the encoding of a mesh (bake/pack/mesh_writer.h), by the hash of all that the encoder is given.
// Every mesh is read and cleaned again: the scene's box, its origin, the effects and the checks of glass and sheets
// need the source's own coordinates, which the rounded ones of a pack do not give back, and a rebaked pack is the
// freshly baked one bit by bit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"

namespace malus::bake {

struct OlderBake {
  std::vector<std::byte> bytes;
  pack::Pack pack;
};

// Nothing where there is no pack, or a damaged one: it is made anew.
std::optional<OlderBake> readOlder(const std::filesystem::path& path);

// Whether it is made of just these sources and settings, by these versions: then there is nothing to do.
bool isUpToDate(const OlderBake& older, const std::string& provenance);

// Whether it is made by the same versions of malus, baker and codec: then equal meshes have equal bytes.
bool isOfSameVersions(const OlderBake& older, const std::string& provenance);

}  // namespace malus::bake

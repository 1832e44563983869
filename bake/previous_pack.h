// The pack of an earlier bake at the output: whether it is up to date, and whether its meshes may be reused.
//
// The encoding of a mesh is reused (bake/pack/mesh_writer.h), by the hash of the encoder's input. Every mesh is read
// and cleaned again: the scene's box, its origin, the effects and the checks of glass need the source's own
// coordinates, which the rounded ones of a pack do not give back, and a rebaked pack equals a freshly baked one bit by
// bit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"

namespace malus::bake {

struct PreviousBake {
  std::vector<std::byte> bytes;
  pack::Pack pack;
};

// Nothing if there is no pack or it is damaged.
std::optional<PreviousBake> readPrevious(const std::filesystem::path& path);

// Whether it was made from these sources and settings by these versions.
bool isUpToDate(const PreviousBake& previous, const std::string& provenance);

// Whether it was made by the same versions of malus, baker and codec, so that equal meshes have equal bytes.
bool isOfSameVersions(const PreviousBake& previous, const std::string& provenance);

}  // namespace malus::bake

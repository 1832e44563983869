// Header and table of a scene pack, with every hash checked.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "bake/pack/format.h"
#include "bake/pack/reader.h"

namespace malus::pack {

// Fills formatVersion, sections and hash. Throws Error: not a pack, another version, truncated, damaged, a section that
// is required and unknown or of an unknown version.
void readTable(std::span<const std::byte> bytes, std::string_view where, Pack& pack);

// The section with a known id; nullptr if the pack lacks it. Throws Error if it occurs twice, or is missing although
// every pack has it.
const Section* findSection(std::span<const Section> sections, std::string_view id, std::string_view where);

}  // namespace malus::pack

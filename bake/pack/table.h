// Header and table of a scene pack, with every hash checked.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bake/pack/format.h"
#include "bake/pack/reader.h"

namespace malus::pack {

// Fills formatVersion, sections and hash. Throws Error: no pack, another version, truncated, damaged, a section that is
// required and unknown or of an unknown version.
void readTable(std::span<const std::byte> bytes, std::string_view where, Pack& pack);

// Which section has the id. Throws Error where it is there twice, or missing though required.
std::optional<std::size_t> findSection(std::span<const Section> sections, std::string_view id, bool required,
                                       std::string_view where);

}  // namespace malus::pack

// Optical constants from files as refractiveindex.info offers them.
//
// YAML (.yml, .yaml): of its keys only DATA is read, a list of entries with the key `type`:
//   tabulated nk | tabulated n | tabulated k    key `data`: lines of a wavelength and the values
//   formula 1 ... formula 9                     keys `coefficients` and `wavelength_range` (in older files `range`)
// CSV (.csv): tables, each after a line of headings: a wavelength (wl, wavelength or lambda), then n, k or both.
// Columns are separated by commas, semicolons or tabs. A heading with "nm" has nanometres, every other micrometres.
//
// Wavelengths are those in vacuum, in micrometres. Files have at most 16 MiB.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bake/materials/optical_data.h"

namespace YAML {
class Node;
}

namespace malus::bake {

// Whether a name has the extension of such a file.
bool isOpticalFile(std::string_view name);

// Throws Error: unreadable, neither YAML nor CSV of this layout, an unknown type, a bad number, or without n.
OpticalData readOpticalFile(const std::filesystem::path& path);

// The same for text. where: the file, for errors.
OpticalData parseOpticalYaml(const std::string& text, const std::string& where);
OpticalData parseOpticalCsv(std::string_view text, const std::string& where);

// Returns the data of an object with the key DATA.
OpticalData parseOpticalData(const YAML::Node& object, const std::string& where);

}  // namespace malus::bake

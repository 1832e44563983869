// The response of a surface to polarized light:
//   malus material NAME | FILE.yml | FILE.csv | --eta N [--k K]  [--outside N] [--wavelength NM | FROM:TO:STEP]
//                  [--angle DEG | FROM:TO:STEP] [--precision double|float] [--csv | --json] [--plot FILE]
//
// Files: bake/materials/optical_file.h. --json: one object for one angle and wavelength, a list of objects for several,
// by wavelength, then by angle. Keys: material (null for --eta),
// wavelengthNm (null for --eta), eta, k, outside, precision, angleDegrees, rs, rp, ts, tp, diattenuation,
// phaseDegrees, reflection[16], transmission[16] (render/material/surface_response.h; ts, tp, transmission are null
// for metals).
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `material`. Its callback throws malus::Error: an unknown material, a plot that cannot be written.
void addMaterialCommand(CLI::App& app);

}  // namespace malus::render

// malus render PACK|MODEL -o OUT.exr [-o OUT.png] [--backend B] [--method M]
//              [--polarizer DEG | --analyser right|left] [--wave-plate AXIS[,RETARDANCE]]
//              [--output-dolp FILE] [--output-aolp FILE] [--mosaic FILE [--mosaic-bits 8|12|16]]
//              [--sensor FILE|PRESET [--sensor-raw FILE] [--sensor-mask FILE] [--sensor-stokes FILE]] ...
// and the list that `malus --list-methods` prints.
//
// --json prints one object: scene, renderer, method, device, width, height, depth, samples, rays (null if not counted),
// buildMs, traceMs, wallMs, numericsChecked, effects, substitutedFor (null, or the method that was asked for and the
// reason for a cheaper one; also under its earlier name inPlaceOf), outputs.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Adds the subcommand `render`. Its callback throws malus::Error (a pack that cannot be read, a file that cannot be
// written, a failed numeric check); a usage error is CLI11's.
void addRenderCommand(CLI::App& app);

// Prints a line per method: name and bytes per ray.
void listMethods();

}  // namespace malus::render

// The command lines of baking:
//   malus bake SCENE.json|MODEL -o OUT.pack [--camera NAME] [--environment FILE] [--write-scene FILE] [--position-error
//   METRES] [--normal-error DEGREES] [--position-bits N]
//              [--normal-bits N] [--keep-map] [--force] [--json]
//   malus info PACK [--verify] [--bounce-tolerance T] [--diff OTHER] [--json]
//   malus unpack PACK -o FOLDER [--json]
#pragma once

#include <CLI/CLI.hpp>

#include "bake/depth_probe.h"
#include "bake/polarization_probe.h"

namespace malus::bake {

// Thrown by info --diff where the packs differ: exit code 3.
struct PacksDiffer {};

// measure: the depth probe of a renderer; without it, packs have no measurement.
void addBakeCommand(CLI::App& app, MeasureDepth measure = {});
// measure: of a renderer; without it, `info` measures nothing.
void addInfoCommand(CLI::App& app, MeasurePolarization measure = {});
void addUnpackCommand(CLI::App& app);

// For --list-materials: one line per material with its constants and source.
void listMaterials();
// For --list-effects: one line per effect with its description.
void listEffects();

}  // namespace malus::bake

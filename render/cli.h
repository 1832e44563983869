// The command lines of rendering:
//   malus render PACK -o OUT.exr [-o OUT.png] [--backend B] [--method M] [--polarizer DEG] ...
//   malus compare-images A B [--threshold T] [--fail-over VALUE] [--difference OUT] [--json]
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Thrown by compare-images where the pictures differ by more than --fail-over: exit code 3.
struct PicturesDiffer {};

void addRenderCommand(CLI::App& app);
void addCompareImagesCommand(CLI::App& app);
void listMethods();
void listDevices();

}  // namespace malus::render

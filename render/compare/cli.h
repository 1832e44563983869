// malus compare PACK... -o FOLDER [--methods a,b] [--backends a,b] [--width N,N] [--scale S] [--depth N,N]
//                [--rounds N] [--minutes M] [--polarizer DEG] [--no-report] [--json]
// malus compare --show FILE... [-o FOLDER]
//
// results.json and results.csv are written after the first pass of each scene and after rounds, at most every five
// seconds.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

void addCompareCommand(CLI::App& app);

}  // namespace malus::render

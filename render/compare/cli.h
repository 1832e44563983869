// malus compare PACK... -o FOLDER [--methods a,b] [--backends a,b] [--width N,N] [--scale S] [--depth N,N]
//                [--rounds N] [--polarizer DEG] [--no-report] [--json]
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

void addCompareCommand(CLI::App& app);

}  // namespace malus::render

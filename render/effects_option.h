// The value of --effects.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace malus::render {

// Replaces earlier names in a list of effects by today's, with a note under -v. Leaves other text, which
// chooseEffects() checks.
CLI::Validator effectList();

// --effects of a command that renders.
void addEffects(CLI::App& command, std::string& effects);

}  // namespace malus::render

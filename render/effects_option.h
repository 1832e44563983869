// The value of --effects.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Replaces earlier names in a list of effects by today's, with a note under -v. Leaves other text, which
// chooseEffects() checks.
CLI::Validator effectList();

}  // namespace malus::render

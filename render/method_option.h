// The value of --method and --methods.
#pragma once

#include <CLI/CLI.hpp>

namespace malus::render {

// Accepts the names of methods; replaces an earlier name by today's, with a note under -v.
CLI::Validator methodName();

}  // namespace malus::render

// Receiver of the current step of a long command.
#pragma once

#include <functional>
#include <string_view>

namespace malus::render {

// Called with one line of text per step, such as console::progress.
using Progress = std::function<void(std::string_view)>;

}  // namespace malus::render

// `malus view --frames N`: replays a script without a window and measures the frames. Only the presentation to a
// surface differs from the window.
#pragma once

#include "render/viewer/host.h"
#include "render/viewer/module.h"

namespace malus::viewer {

// Prints the frame times to stdout. Throws Error, Interrupted.
void runHeadless(const Request& request, const Host& host);

}  // namespace malus::viewer

// The window of `malus view`: its loop.
#pragma once

#include "render/viewer/host.h"
#include "render/viewer/module.h"

namespace malus::viewer {

// Runs until the window is closed. Throws Error: no display, a lost device; Interrupted after Ctrl-C.
void runWindow(const Request& request, const Host& host);

}  // namespace malus::viewer

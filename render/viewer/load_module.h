// Finds and loads the module of the viewer.
#pragma once

#include "render/viewer/module.h"

namespace malus::viewer {

// Throws Error: this malus was built without the viewer, or the module is of another version.
const Module& loadModule();

}  // namespace malus::viewer

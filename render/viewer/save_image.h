// Files that the viewer writes.
#pragma once

#include <string>

#include "render/viewer/display_pass.h"
#include "render/viewer/session.h"

namespace malus::viewer {

// Saves what is seen: .exr with every channel of side A and the metadata of `malus render`, .png as the window shows it
// without the panel. Throws Error: another extension, no complete image, a file that cannot be written.
void saveImage(const std::string& file, const Session& session, const DisplayDevice& device,
               const DisplayImageTarget& target);
// The target as .png. It must be in the layout TRANSFER_SRC_OPTIMAL.
void savePng(const std::string& file, const DisplayDevice& device, const DisplayImageTarget& target);

}  // namespace malus::viewer

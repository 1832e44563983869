// The folder of the program, from which it finds its modules and scripts.
#pragma once

#include <filesystem>

namespace malus {

// Folder of the executable, or the one that was set.
std::filesystem::path programFolder();

// For code that runs inside of another program (Python). Call it before the first use.
void setProgramFolder(const std::filesystem::path& folder);

}  // namespace malus

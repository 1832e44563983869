// Check of the header of an EXR file. OpenEXR allocates the sizes that attributes, windows and tiles declare before it
// reads their bytes, so that a file of 1 kB could take 2 GB of memory, and it ignores the declared sizes of most types.
// Source: OpenEXR documentation, "OpenEXR File Layout".
#pragma once

#include <string>
#include <vector>

namespace malus::image {

// Returns why the file cannot be read, or an empty string. In every part, each attribute must be within the file and
// have the size of its type; the data window, a tile and a group of rows that are compressed together must be within
// the limits of an image (image_module.h), and each tile needs 8 bytes of the file.
std::string checkExrHeader(const std::vector<unsigned char>& bytes);

}  // namespace malus::image

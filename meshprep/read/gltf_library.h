// tinygltf, in a namespace of its own. Debian's libdraco holds another version of it and exports its symbols, which
// the linker would take in place of those of libtinygltf: calls would meet objects of another layout, and crash. So
// the header alone is used, and compiled in gltf_library.cpp; without files and pictures, which are not its to read.
#pragma once

#include <nlohmann/json.hpp>

#define tinygltf malus_tinygltf
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

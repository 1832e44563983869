// The one place where tinygltf is compiled.
#include <fstream>  // which it leaves out without files, and needs

#define TINYGLTF_IMPLEMENTATION
#include "meshprep/read/gltf_library.h"

// Fuzzes the scene reader, which does not open meshes and images.
#include "bake/scene_file/scene_file.h"
#include "meshprep/base/error.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/temporary.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    malus::bake::readSceneFile(writeTemporary(data, size, ".json"));
  } catch (const malus::Error&) {
  }
  return 0;
}

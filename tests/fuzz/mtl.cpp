// Fuzzes the reader of OBJ material files.
#include <string>

#include "meshprep/base/error.h"
#include "meshprep/read/read_mtl.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    std::vector<std::string> notes;
    std::vector<malus::prep::SourceImage> images;
    malus::prep::parseMtl(std::string(reinterpret_cast<const char*>(data), size), "fuzz.mtl", notes, images);
  } catch (const malus::Error&) {
  }
  return 0;
}

// Fuzzes the readers of optical constants, YAML and CSV, and what they give at the default wavelengths.
#include <string>

#include "bake/materials/optical_file.h"
#include "bake/pack/scene.h"
#include "meshprep/base/error.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace malus;
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto parse : {+[](const std::string& t) { return bake::parseOpticalYaml(t, "fuzz.yml"); },
                           +[](const std::string& t) { return bake::parseOpticalCsv(t, "fuzz.csv"); }}) {
    try {
      parse(text).at(pack::kDefaultWavelengthsNm);
    } catch (const Error&) {
    }
  }
  return 0;
}

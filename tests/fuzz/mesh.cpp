// Fuzzes the mesh readers, cleaning, and the certificate with its search for intersections. MALUS_EXTENSION is the
// format.
#include "meshprep/base/error.h"
#include "meshprep/prepare.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/temporary.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    malus::prep::Options options;
    options.certifyGlass = true;
    malus::prep::Report report;
    malus::prep::prepare(writeTemporary(data, size, MALUS_EXTENSION), options, report);
  } catch (const malus::Error&) {
  }
  return 0;
}

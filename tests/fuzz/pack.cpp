// Fuzzes the pack reader with the raw bytes, and with corrected hashes and sizes, which are checked first.
#include <algorithm>
#include <span>
#include <vector>

#include "bake/effects/effects.h"
#include "bake/pack/reader.h"
#include "meshprep/base/error.h"
#include "tests/bake/pack/raw_pack.h"
#include "tests/fuzz/target.h"

namespace {

using Bytes = std::vector<std::byte>;

void parse(const Bytes& bytes) {
  try {
    const malus::pack::Pack pack = malus::pack::parse(bytes, "fuzz");
    malus::bake::findEffects(pack.scene);
  } catch (const malus::Error&) {
  }
}

// Corrects magic, version, size and the hashes of the sections within the file. Wrong bounds of sections remain.
void repair(Bytes& bytes) {
  using namespace malus::pack;
  if (bytes.size() < kHeaderBytes) return;
  std::copy(std::begin(kMagic), std::end(kMagic), reinterpret_cast<char*>(bytes.data()));
  test::setNumber(bytes, 8, kFormatVersion);
  test::setNumber(bytes, 16, std::uint64_t{bytes.size()});
  const std::size_t count = std::min<std::size_t>(test::numberAt<std::uint32_t>(bytes, 12), kMaxSections);
  for (std::size_t i = 0; i < count && kHeaderBytes + (i + 1) * kEntryBytes <= bytes.size(); ++i) {
    const std::size_t entry = kHeaderBytes + i * kEntryBytes;
    const auto offset = test::numberAt<std::uint64_t>(bytes, entry + 16),
               size = test::numberAt<std::uint64_t>(bytes, entry + 24);
    if (offset > bytes.size() || size > bytes.size() - offset) continue;
    test::setNumber(bytes, entry + 32,
                    hashBytes(std::span<const std::byte>(bytes).subspan(static_cast<std::size_t>(offset),
                                                                        static_cast<std::size_t>(size))));
  }
  if (kHeaderBytes + count * kEntryBytes <= bytes.size()) test::fixHashes(bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  Bytes bytes(begin, begin + size);
  parse(bytes);
  repair(bytes);
  parse(bytes);
  return 0;
}

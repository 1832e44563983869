// Damaged packs: what reading them answers.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"

namespace malus::pack {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline std::string parseError(const test::Bytes& bytes) {
  return bake::test::errorMessage([&] { parse(bytes, "file.pack"); });
}

// Sections of the scene with all optional sections.
inline const std::vector<test::RawSection>& unusualSections() {
  static const std::vector<test::RawSection> kSections =
      test::takenApart(serialize(bake::test::unusualScene(), {}).bytes);
  return kSections;
}

}  // namespace malus::pack

// Damaged optional sections of packs.
#include <cmath>
#include <limits>

#include "tests/bake/pack/corrupt_pack.h"

namespace malus::pack {
namespace {

using bake::test::contains;
using bake::test::errorMessage;
using test::Bytes;
using test::RawSection;

template <class T>
std::string unusualErrorWith(std::string_view id, std::size_t at, T value) {
  std::vector<RawSection> sections = unusualSections();
  test::setNumber(test::section(sections, id).bytes, at, value);
  return parseError(test::putTogether(sections));
}

TEST(CorruptPack, UnusualSectionsOutOfBounds) {
  EXPECT_EQ(parseError(test::putTogether(unusualSections())), "");
  constexpr std::size_t kRecord = 280, kGold = 4 + kRecord, kLamp = kGold + kRecord, kPolarizer = kLamp + kRecord;
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 0, 4u), "number of surfaces"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 4, -1.0), "absorption"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 4, kNan), "not finite"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 4 + 48, 0.0), "coating.eta"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 4 + 72, 1e6), "coating.thicknessNm"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", 4 + 80, 0.5), "roughness"));  // of glass
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 80, 1.5), "roughness"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kLamp + 72, 1.0), "coating.thicknessNm"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kLamp + 88, 0.5), "axis"));  // not a unit vector
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kLamp + 112, 1.5), "polarization"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 112, 0.5), "polarization"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kPolarizer + 120, 1.5), "transmittanceParallel"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kPolarizer + 168, 1e9), "retardanceDegrees"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 192, 3u), "maps.albedo"));
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 192, 2u), "0 to 1"));             // an albedo of 4
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 200, 1u), "values from 0.001"));  // k = 0
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kGold + 200, 0u), "index map"));          // eta alone
  EXPECT_TRUE(contains(unusualErrorWith("SRFX", kLamp + 196, 2u), "index map"));
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", 0, 300u), "number of textures"));
  constexpr std::size_t kFirst = 4 + 4 + 11;  // after the first name
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", kFirst, 8193u), "width"));
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", kFirst, 0u), "width"));
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", kFirst, 8000u), "texels of texture"));
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", kFirst + 8, -0.5f), "texel"));
  EXPECT_TRUE(contains(unusualErrorWith("TEXR", kFirst + 8, std::numeric_limits<float>::quiet_NaN()), "texel"));
  EXPECT_TRUE(contains(unusualErrorWith("SKYP", 0, 0.5), "sky.sun"));
  EXPECT_TRUE(contains(unusualErrorWith("SKYP", 24, 1.5), "sky.maxDegree"));
  EXPECT_TRUE(contains(unusualErrorWith("WAVE", 8, 0.5), "wavelengthsNm"));
  constexpr std::size_t kInstance = 4 + 4 + 8;  // after the name of the first
  EXPECT_TRUE(contains(unusualErrorWith("INST", 0, 1u << 21), "number of instances"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance, 2u), "'mirrored' is out of range"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 4, kNan), "not finite"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 4, 1e10), "linear.x"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 4, 0.0), "linear part"));  // without an inverse
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 4, 1e4), "1:1000"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 76, 1e16), "translation"));
  EXPECT_TRUE(contains(unusualErrorWith("INST", kInstance + 76, 2e9), "place of instance"));
  // A polarizer without an axis.
  std::vector<RawSection> sections = unusualSections();
  std::erase_if(sections, [](const RawSection& s) { return s.id == "SRFX"; });
  EXPECT_TRUE(contains(parseError(test::putTogether(sections)), "section SRFX is missing"));
}

TEST(CorruptPack, EveryFlippedBitOfOptionalSectionsWithMatchingHashesIsHarmless) {
  std::size_t rejected = 0, accepted = 0;
  for (std::size_t s = 0; s < unusualSections().size(); ++s) {
    if (const std::string& id = unusualSections()[s].id;
        id != "SRFX" && id != "TEXR" && id != "SKYP" && id != "WAVE" && id != "INST" && id != "MAPS")
      continue;
    for (std::size_t i = 0; i < unusualSections()[s].bytes.size(); ++i)
      for (int bit = 0; bit < 8; ++bit) {
        std::vector<RawSection> sections = unusualSections();
        sections[s].bytes[i] ^= static_cast<std::byte>(1 << bit);
        const Bytes bytes = test::putTogether(sections);
        const std::string error = errorMessage([&] {
          const Scene scene = parse(bytes, "file.pack").scene;
          for (const Instance& instance : scene.instances) ASSERT_LT(instance.mesh, 2u);
          for (const Material& m : scene.materials)
            for (const std::int32_t map : {m.maps.albedo, m.maps.eta, m.maps.k}) ASSERT_LT(map, 2);
        });
        error.empty() ? ++accepted : ++rejected;
        ASSERT_TRUE(error.empty() || contains(error, "file.pack")) << error;
      }
  }
  EXPECT_GT(rejected, 100u);
  EXPECT_GT(accepted, 100u);
}

}  // namespace
}  // namespace malus::pack

// Damaged and hostile packs: always an Error with problem and location, never a crash or a large allocation.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/corrupt_pack.h"
#include "tests/bake/pack/raw_pack.h"
#include "tests/largest_memory.h"

namespace malus::pack {
namespace {

using bake::test::contains;
using bake::test::errorMessage;
using bake::test::smallScene;
using test::Bytes;
using test::RawSection;

const Bytes& smallPack() {
  static const Bytes kPack = serialize(smallScene(), {}).bytes;
  return kPack;
}

// Returns the error of the small pack after a change of its sections, with matching hashes.
template <class Change>
std::string errorAfter(Change change) {
  std::vector<RawSection> sections = test::takenApart(smallPack());
  change(sections);
  return parseError(test::putTogether(sections));
}

// Same as above, for one number of one section.
template <class T>
std::string errorWith(std::string_view id, std::size_t at, T value) {
  return errorAfter([&](std::vector<RawSection>& s) { test::setNumber(test::section(s, id).bytes, at, value); });
}

TEST(CorruptPack, SmallPackIsValid) { EXPECT_EQ(parseError(smallPack()), ""); }

TEST(CorruptPack, EveryTruncationIsAnError) {
  for (std::size_t size = 0; size < smallPack().size(); ++size) {
    const Bytes cut(smallPack().begin(), smallPack().begin() + static_cast<std::ptrdiff_t>(size));
    const std::string error = parseError(cut);
    ASSERT_TRUE(contains(error, "file.pack")) << size << ": " << error;
  }
}

TEST(CorruptPack, EveryFlippedBitIsAnError) {
  Bytes bytes = smallPack();
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] ^= static_cast<std::byte>(1 << bit);
      ASSERT_TRUE(contains(parseError(bytes), "file.pack")) << "byte " << i << ", bit " << bit;
      bytes[i] ^= static_cast<std::byte>(1 << bit);
    }
}

TEST(CorruptPack, BytesAfterTheEndAreAnError) {
  Bytes bytes = smallPack();
  bytes.push_back(std::byte{0});
  EXPECT_TRUE(contains(parseError(bytes), "longer than its pack")) << parseError(bytes);
  test::setNumber(bytes, 16, std::uint64_t{bytes.size()});
  test::fixHashes(bytes);
  EXPECT_TRUE(contains(parseError(bytes), "after the last section")) << parseError(bytes);
}

// With matching hashes, any flipped bit of any section is rejected or gives a scene within the schema.
TEST(CorruptPack, EveryFlippedBitWithMatchingHashesIsHarmless) {
  const std::vector<RawSection> whole = test::takenApart(smallPack());
  const std::size_t before = malus::test::largestMemory();
  std::size_t rejected = 0, accepted = 0;
  for (std::size_t s = 0; s < whole.size(); ++s)
    for (std::size_t i = 0; i < whole[s].bytes.size(); ++i)
      for (int bit = 0; bit < 8; ++bit) {
        std::vector<RawSection> sections = whole;
        sections[s].bytes[i] ^= static_cast<std::byte>(1 << bit);
        const Bytes bytes = test::putTogether(sections);
        const std::string error = errorMessage([&] {
          const Scene scene = parse(bytes, "file.pack").scene;
          for (const Mesh& mesh : scene.meshes) {
            ASSERT_LT(mesh.material, scene.materials.size());
            for (const glm::uvec3& t : mesh.triangles)
              ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size()) << s << " " << i << " " << bit;
            for (const glm::dvec3& p : mesh.positions)
              ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
          }
        });
        error.empty() ? ++accepted : ++rejected;
        if (!error.empty()) {
          ASSERT_TRUE(contains(error, "file.pack")) << error;
        }
      }
  EXPECT_GT(rejected, 1000u);
  EXPECT_GT(accepted, 1000u);  // most bits of numbers give another valid number
  EXPECT_LT(malus::test::largestMemory() - before, std::size_t{512} << 20u);
}

// Swapping the contents of two sections but not their table entries is detected before decoding.
TEST(CorruptPack, EveryPairOfSwappedSectionsIsAnError) {
  const std::vector<RawSection>& whole = unusualSections();
  for (std::size_t a = 0; a < whole.size(); ++a)
    for (std::size_t b = a + 1; b < whole.size(); ++b) {
      // With updated hashes, the contents are invalid.
      std::vector<RawSection> sections = whole;
      std::swap(sections[a].bytes, sections[b].bytes);
      EXPECT_TRUE(contains(parseError(test::putTogether(sections)), "file.pack")) << whole[a].id << ' ' << whole[b].id;
      // With the original table, the hashes differ.
      Bytes bytes = test::putTogether(whole);
      const std::size_t first = 40 + 40 * a + 32, second = 40 + 40 * b + 32;  // their hashes
      const auto kept = test::numberAt<std::uint64_t>(bytes, first);
      test::setNumber(bytes, first, test::numberAt<std::uint64_t>(bytes, second));
      test::setNumber(bytes, second, kept);
      test::fixHashes(bytes);
      EXPECT_TRUE(contains(parseError(bytes), "is damaged")) << whole[a].id << ' ' << whole[b].id;
    }
}

TEST(CorruptPack, RandomBytesWithMatchingHashesAreHarmless) {
  const std::vector<RawSection> whole = test::takenApart(smallPack());
  std::mt19937 random(1);
  const std::size_t before = malus::test::largestMemory();
  for (int round = 0; round < 5000; ++round) {
    std::vector<RawSection> sections = whole;
    RawSection& section = sections[random() % sections.size()];
    const std::size_t first = random() % section.bytes.size();
    for (std::size_t i = first; i < std::min(first + 1 + random() % 8, section.bytes.size()); ++i)
      section.bytes[i] = static_cast<std::byte>(random() % 4 == 0 ? 0xff : random() & 0xff);
    if (random() % 4 == 0) section.bytes.resize(random() % section.bytes.size());
    const std::string error = parseError(test::putTogether(sections));
    if (!error.empty()) {
      ASSERT_TRUE(contains(error, "file.pack")) << error;
    }
  }
  EXPECT_LT(malus::test::largestMemory() - before, std::size_t{512} << 20u);
}

TEST(CorruptPack, OtherFilesAreNotPacks) {
  for (const std::string_view text : {"", "M", "\x89PNG\r\n\x1a\n then more than forty bytes of something else",
                                      "MALUSPACK that is not one, forty bytes long or more"}) {
    const std::span<const std::byte> source = std::as_bytes(std::span(text));
    const Bytes bytes(source.begin(), source.end());
    EXPECT_TRUE(contains(parseError(bytes), "file.pack", "not a scene pack")) << parseError(bytes);
  }
}

TEST(CorruptPack, NewerAndOlderVersionsHaveDifferentErrors) {
  const std::vector<RawSection> sections = test::takenApart(smallPack());
  const std::string newer = parseError(test::putTogether(sections, kFormatVersion + 1)),
                    older = parseError(test::putTogether(sections, 0));
  EXPECT_TRUE(contains(newer, "newer than this malus")) << newer;
  EXPECT_TRUE(contains(newer, "version 1 to 2", "found 3")) << newer;
  EXPECT_TRUE(contains(older, "older")) << older;
}

TEST(CorruptPack, VersionIsCheckedFirst) {
  // A later format may store its hashes elsewhere.
  Bytes bytes = smallPack();
  test::setNumber(bytes, 8, std::uint32_t{9});
  EXPECT_TRUE(contains(parseError(bytes), "newer than this malus"));
}

TEST(CorruptPack, UnknownSections) {
  const auto with = [](std::uint32_t flags, std::uint32_t version) {
    return errorAfter([&](std::vector<RawSection>& s) {
      s.push_back({"NEWS", version, flags, Bytes(24, std::byte{7})});
    });
  };
  EXPECT_EQ(with(kOptional, 1), "");
  EXPECT_EQ(with(kOptional, 77), "");
  const std::string error = with(0, 1);
  EXPECT_TRUE(contains(error, "NEWS", "required")) << error;
  EXPECT_EQ(errorAfter([&](std::vector<RawSection>& s) {
              s.insert(s.begin() + 2, {"NEWS", 1, kOptional, Bytes(5, std::byte{1})});
            }),
            "");
}

TEST(CorruptPack, UnknownVersionOfASection) {
  for (const char* id : {"META", "GEOM", "EFCT"}) {
    const std::string error = errorAfter([&](std::vector<RawSection>& s) { test::section(s, id).version = 2; });
    EXPECT_TRUE(contains(error, std::string("section ") + id + " has an unknown version")) << error;
  }
}

TEST(CorruptPack, MissingAndRepeatedSections) {
  for (const char* id : {"META", "CAMR", "ENVR", "LGHT", "MATL", "MESH", "GEOM"}) {
    const std::string error = errorAfter(
        [&](std::vector<RawSection>& s) { std::erase_if(s, [&](const RawSection& r) { return r.id == id; }); });
    EXPECT_TRUE(contains(error, std::string("section ") + id + " is missing")) << error;
  }
  for (const char* id : {"EFCT", "PROV"})
    EXPECT_EQ(errorAfter([&](std::vector<RawSection>& s) {
                std::erase_if(s, [&](const RawSection& r) { return r.id == id; });
              }),
              "");
  for (const char* id : {"META", "PROV"}) {
    const std::string error =
        errorAfter([&](std::vector<RawSection>& s) { s.push_back(RawSection(test::section(s, id))); });
    EXPECT_TRUE(contains(error, std::string("section ") + id + " occurs twice")) << error;
  }
}

TEST(CorruptPack, SwappedSections) {
  // Another order is valid; another id is not.
  EXPECT_EQ(errorAfter([](std::vector<RawSection>& s) { std::swap(s[0], s[5]); }), "");
  const std::size_t count = test::takenApart(smallPack()).size();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      EXPECT_NE(errorAfter([&](std::vector<RawSection>& s) { std::swap(s[a].bytes, s[b].bytes); }), "")
          << a << " " << b;
}

TEST(CorruptPack, TableOfSections) {
  const auto entry = [](std::size_t i, std::size_t field, auto value) {
    Bytes bytes = smallPack();
    test::setNumber(bytes, 40 + 40 * i + field, value);
    test::fixHashes(bytes);
    return parseError(bytes);
  };
  constexpr std::uint64_t kHuge = ~std::uint64_t{0};
  EXPECT_TRUE(contains(entry(1, 16, std::uint64_t{0}), "overlaps"));
  EXPECT_TRUE(contains(entry(1, 16, std::uint64_t{401}), "overlaps"));  // not aligned
  EXPECT_TRUE(contains(entry(1, 16, kHuge - 15), "overlaps"));
  EXPECT_TRUE(contains(entry(1, 24, kHuge), "overlaps"));
  EXPECT_TRUE(contains(entry(0, 24, std::uint64_t{smallPack().size()}), "overlaps"));
  EXPECT_TRUE(contains(entry(1, 32, std::uint64_t{5}), "section CAMR is damaged"));
  EXPECT_TRUE(contains(entry(0, 24, std::uint64_t{1}), "section META is damaged"));
  Bytes many = smallPack();
  test::setNumber(many, 12, std::uint32_t{65});
  test::fixHashes(many);
  EXPECT_TRUE(contains(parseError(many), "number of sections"));
  test::setNumber(many, 12, std::uint32_t{64});
  test::fixHashes(many);
  EXPECT_NE(parseError(many), "");
}

TEST(CorruptPack, PaddingMustBeZero) {
  Bytes bytes = smallPack();
  const auto end = test::numberAt<std::uint64_t>(bytes, 40 + 16) + test::numberAt<std::uint64_t>(bytes, 40 + 24);
  ASSERT_NE(end % 16, 0u);
  bytes[static_cast<std::size_t>(end)] = std::byte{1};
  EXPECT_TRUE(contains(parseError(bytes), "padding is damaged")) << parseError(bytes);
}

TEST(CorruptPack, EverySectionTooShortOrTooLong) {
  for (const RawSection& section : test::takenApart(smallPack())) {
    if (section.id == "GEOM") continue;  // its size is checked per mesh
    EXPECT_NE(errorAfter([&](std::vector<RawSection>& s) { test::section(s, section.id).bytes.pop_back(); }), "")
        << section.id;
    EXPECT_NE(
        errorAfter([&](std::vector<RawSection>& s) { test::section(s, section.id).bytes.push_back(std::byte{0}); }), "")
        << section.id;
    EXPECT_NE(errorAfter([&](std::vector<RawSection>& s) { test::section(s, section.id).bytes.clear(); }), "")
        << section.id;
  }
}

TEST(CorruptPack, CountsTooLarge) {
  const std::size_t before = malus::test::largestMemory();
  constexpr std::uint32_t kHuge = 0xffffffffu;
  for (const std::uint32_t count : {kHuge, 0x10000000u, 3u}) {
    EXPECT_TRUE(contains(errorWith("LGHT", 0, count), "number of lights")) << count;
    if (count != 3u) {
      EXPECT_TRUE(contains(errorWith("MATL", 0, count), "number of materials")) << count;
      EXPECT_TRUE(contains(errorWith("EFCT", 0, count), "number of effects")) << count;
    }
    EXPECT_NE(errorWith("MESH", 0, count), "") << count;
  }
  EXPECT_TRUE(contains(errorWith("META", 0, kHuge), "length of a text"));
  EXPECT_TRUE(contains(errorWith("META", 0, 60000u), "section ends early"));
  EXPECT_TRUE(contains(errorWith("PROV", 0, kHuge), "length of a text"));
  EXPECT_TRUE(contains(errorWith("ENVR", 248, kHuge), "size", "range"));
  EXPECT_TRUE(contains(errorWith("ENVR", 248, 8192u), "environment texels"));
  EXPECT_TRUE(contains(errorWith("ENVR", 248, 0u), "longer than its contents"));
  // MESH: count, name of 11 letters, then material, flags, vertices, triangles, encoding, offset, size.
  constexpr std::size_t kMesh = 4 + 4 + 11;
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 8, kHuge), "vertices", "range"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 12, kHuge), "triangles", "range"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 8, kMaxVertices), "mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 12, kMaxTriangles), "mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 8, 5u), "mesh 'tetrahedron'"));
  EXPECT_LT(malus::test::largestMemory() - before, std::size_t{256} << 20u);
}

TEST(CorruptPack, MeshesOutOfBounds) {
  constexpr std::size_t kMesh = 4 + 4 + 11;
  const std::string material = errorWith("MESH", kMesh, 3u);
  EXPECT_TRUE(contains(material, "material", "tetrahedron", "below 3", "found 3")) << material;
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 4, 4u), "flags"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 4, 0u), "normals of mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 16, 2u), "encoding"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 20, ~std::uint64_t{15}), "geometry of mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 20, std::uint64_t{1}), "geometry of mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 28, ~std::uint64_t{0}), "geometry of mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorWith("MESH", kMesh + 28, std::uint64_t{0}), "mesh 'tetrahedron'"));
  EXPECT_TRUE(contains(errorAfter([](std::vector<RawSection>& s) { test::section(s, "MESH").bytes = Bytes(4); }),
                       "number of meshes"));
}

TEST(CorruptPack, MeshesMustNotShareGeometry) {
  // The second mesh claims the bytes of the first.
  constexpr std::size_t kSecond = 4 + 4 + 11 + 36 + 56 + 4 + 5;
  const std::string error = errorWith("MESH", kSecond + 20, std::uint64_t{0});
  EXPECT_TRUE(contains(error, "geometry of mesh 'sheet'")) << error;
}

TEST(CorruptPack, CameraOutOfBounds) {
  for (std::size_t at = 0; at < 112; at += 8) {
    EXPECT_TRUE(contains(errorWith("CAMR", at, kNan), "not finite")) << at;
    EXPECT_TRUE(contains(errorWith("CAMR", at, kInfinity), "not finite")) << at;
    EXPECT_NE(errorWith("CAMR", at, 1e300), "") << at;
  }
  EXPECT_TRUE(contains(errorWith("CAMR", 24, 0.5), "orthonormal"));
  EXPECT_TRUE(contains(errorWith("CAMR", 40, -1.0), "left-handed"));  // right = -z
  EXPECT_TRUE(contains(errorWith("CAMR", 96, 0.0), "verticalFovDegrees"));
  EXPECT_TRUE(contains(errorWith("CAMR", 96, 180.0), "verticalFovDegrees"));
  EXPECT_TRUE(contains(errorWith("CAMR", 104, 0.0), "mediumEta"));
  // The error contains the byte offset in the file.
  const std::string error = errorWith("CAMR", 96, kNan);
  EXPECT_TRUE(contains(error, "file.pack, section CAMR, byte ")) << error;
}

TEST(CorruptPack, ImageOutOfBounds) {
  std::vector<RawSection> sections = test::takenApart(smallPack());
  const std::size_t end = test::section(sections, "META").bytes.size();
  EXPECT_TRUE(contains(errorWith("META", end - 8, kNan), "not finite"));
  EXPECT_TRUE(contains(errorWith("META", end - 8, 101.0), "exposureEv", "-100 to 100", "found 101"));
  EXPECT_TRUE(contains(errorWith("META", end - 12, 256u), "depth"));
  EXPECT_TRUE(contains(errorWith("META", end - 16, 16385u), "height"));
  EXPECT_TRUE(contains(errorWith("META", end - 16, 0u), "height"));
  EXPECT_TRUE(contains(errorWith("META", end - 20, 0u), "width"));
  EXPECT_TRUE(contains(errorWith("META", end - 44, 1e16), "origin[0]"));
}

TEST(CorruptPack, LightOutOfBounds) {
  for (std::size_t at = 4; at < 4 + 96; at += 8) EXPECT_TRUE(contains(errorWith("LGHT", at, kNan), "not finite")) << at;
  EXPECT_TRUE(contains(errorWith("LGHT", 4, 1e16), "section LGHT"));
  EXPECT_TRUE(contains(errorWith("LGHT", 28, -1.0), "intensity"));
  for (std::size_t at = 0; at < 248; at += 8) EXPECT_TRUE(contains(errorWith("ENVR", at, kNan), "not finite")) << at;
  EXPECT_TRUE(contains(errorWith("ENVR", 0, -1.0), "radiance"));
  EXPECT_TRUE(contains(errorWith("ENVR", 24, -1.0), "ambientIrradiance"));
  EXPECT_TRUE(contains(errorWith("ENVR", 32, 1e16), "irradiance[0]"));
  for (const std::uint16_t half :
       {std::uint16_t{0x7c00}, std::uint16_t{0x7e00}, std::uint16_t{0xbc00}})  // inf, NaN, -1
    EXPECT_TRUE(contains(errorWith("ENVR", 252 + 6, half), "environment texel")) << half;
}

TEST(CorruptPack, LightBeyondOutOfBounds) {
  const auto refused = [](std::size_t at, auto number) {
    std::vector<RawSection> sections = test::takenApart(serialize(bake::test::unusualScene(), {}).bytes);
    test::setNumber(test::section(sections, "BYND").bytes, at, number);
    return errorMessage([&] { parse(test::putTogether(sections), "file.pack"); });
  };
  EXPECT_CONTAINS(refused(0, 5u), "number of depths");
  for (const double share : {-0.1, 1.1, kNan}) EXPECT_CONTAINS(refused(4, share), "share");
  EXPECT_CONTAINS(refused(12, 0.9), "share");  // more than beyond a smaller depth
}

TEST(CorruptPack, StorageOfTexelsOutOfBounds) {
  Scene scene = bake::test::smallScene();
  scene.environment.storage = {false, 0.25};
  const auto refused = [&](std::size_t at, auto number) {
    std::vector<RawSection> sections = test::takenApart(serialize(scene, {}).bytes);
    test::setNumber(test::section(sections, "ENVR").bytes, at, number);
    return errorMessage([&] { parse(test::putTogether(sections), "file.pack"); });
  };
  EXPECT_CONTAINS(refused(252, 2u), "texelFormat");
  EXPECT_CONTAINS(refused(252, 1u), "texelScale");  // floats have no scale
  for (const double scale : {0.0, -1.0, 0.3, 1e60, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_CONTAINS(refused(256, scale), "texelScale");
  scene.environment.storage = {true, 1};
  for (const float texel : {-1.0f, 2e15f, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_CONTAINS(refused(264 + 12, texel), "environment texel");
  EXPECT_CONTAINS(refused(248, 1u), "environment texels");
}

TEST(CorruptPack, MaterialOutOfBounds) {
  constexpr std::size_t kGlass = 4 + 4 + 5;                // after the first name
  constexpr std::size_t kGold = kGlass + 120 + 4 + 4;      // after the second
  constexpr std::size_t kEta = 4, kK = 28, kOutside = 52;  // after the kind
  for (std::size_t at = kGlass + kEta; at + 8 <= kGlass + 116; at += 8)
    EXPECT_TRUE(contains(errorWith("MATL", at, kNan), "not finite")) << at;
  EXPECT_TRUE(contains(errorWith("MATL", kGlass, pack::kMaterialKindCount), "type"));
  EXPECT_TRUE(contains(errorWith("MATL", kGlass + kEta, 1e4), "eta[0]"));
  EXPECT_TRUE(contains(errorWith("MATL", kGlass + kEta, 1e-4), "too small"));
  EXPECT_TRUE(contains(errorWith("MATL", kGlass + kK, 0.5), "dielectric"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + kEta, -0.1), "eta[0]"));
  EXPECT_EQ(errorWith("MATL", kGold + kEta, 0.0), "");  // n = 0 with k > 0
  EXPECT_TRUE(contains(errorWith("MATL", kGold + kK, 1e4), "k[0]"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + kOutside, 0.0), "outsideEta"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + 60, 1.01), "albedo"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + 84, -1.0), "radiance"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + 108, -1.0), "highlight.strength"));
  EXPECT_TRUE(contains(errorWith("MATL", kGold + 116, 4096u), "highlight.exponent"));
}

TEST(CorruptPack, EffectOutOfBounds) {
  const std::string error = errorWith("EFCT", 4 + 4 + 5, 2u);
  EXPECT_TRUE(contains(error, "section EFCT")) << error;
}

TEST(CorruptPack, MissingFileAndFolder) {
  EXPECT_TRUE(contains(errorMessage([] { read("/nowhere/at-all.pack"); }), "/nowhere/at-all.pack"));
  EXPECT_TRUE(contains(errorMessage([] { read("/"); }), "regular file"));
}

}  // namespace
}  // namespace malus::pack

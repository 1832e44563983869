// Maps by texture coordinates in a pack: kept, absent if no material has any, and validated; textures of few values
// take a byte per texel.
#include <algorithm>
#include <limits>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"
#include "tests/messages.h"

namespace malus::pack {
namespace {

using bake::test::smallScene;
using test::RawSection;

// A diffuse material with a map of a texture of `values` different values per channel.
Scene mappedScene(std::uint32_t values, bool isGrey = false) {
  Scene scene = smallScene();
  Texture t;
  t.name = "image";
  t.width = values;
  t.height = 1;
  for (std::uint32_t i = 0; i < values; ++i) {
    const float x = static_cast<float>(i) / static_cast<float>(values);
    t.texels.emplace_back(x, isGrey ? x : 1 - x, x);
  }
  scene.textures = {t};
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [](const Material& m) { return canBeDiffuse(m.kind); });
  MeshMaps& maps = found->meshMaps;
  maps.albedo = {0, 1, Wrap::clamp, Wrap::mirror, {1, 2, 3}, {-4, 5, 6}};
  maps.normal.texture = 0;
  maps.normalScale = -2;
  maps.cutoff = 0.25;
  return scene;
}

std::size_t sectionBytes(const Scene& scene, std::string_view id) {
  std::vector<RawSection> sections = test::takenApart(serialize(scene, {}).bytes);
  return test::section(sections, id).bytes.size();
}

TEST(PackMeshMaps, AreKept) {
  for (const std::uint32_t values : {1u, 256u, 257u, 8192u})
    for (const bool isGrey : {false, true}) {
      const Scene source = mappedScene(values, isGrey), scene = parse(serialize(source, {}).bytes, "test").scene;
      ASSERT_EQ(scene.materials.size(), source.materials.size());
      for (std::size_t i = 0; i < source.materials.size(); ++i)
        EXPECT_EQ(scene.materials[i].meshMaps, source.materials[i].meshMaps);
      EXPECT_EQ(scene.textures[0].texels, source.textures[0].texels) << values;
    }
  Scene many = mappedScene(8192);  // more values than a list has
  many.textures[0].height = 9;
  many.textures[0].texels.clear();
  for (int i = 0; i < 8192 * 9; ++i) many.textures[0].texels.emplace_back(static_cast<float>(i) * 1e-5f);
  EXPECT_EQ(parse(serialize(many, {}).bytes, "test").scene.textures[0].texels, many.textures[0].texels);
}

TEST(PackMeshMaps, FewValuesTakeAByte) {
  Scene scene = mappedScene(256);
  for (int i = 0; i < 6; ++i) {
    std::vector<glm::vec3>& texels = scene.textures[0].texels;
    const std::vector<glm::vec3> copy = texels;
    texels.insert(texels.end(), copy.begin(), copy.end());
    scene.textures[0].height *= 2;
  }
  const std::size_t texels = scene.textures[0].texels.size();
  EXPECT_LT(sectionBytes(scene, "TEXR"), texels * 3 + 4000);
  for (glm::vec3& texel : scene.textures[0].texels) texel = glm::vec3(texel.x);
  EXPECT_LT(sectionBytes(scene, "TEXR"), texels + 2000);
}

TEST(PackMeshMaps, AbsentWithoutAny) {
  const auto sections = test::takenApart(serialize(smallScene(), {}).bytes);
  EXPECT_TRUE(std::none_of(sections.begin(), sections.end(), [](const RawSection& s) { return s.id == kMeshMaps; }));
}

TEST(PackMeshMaps, InvalidValues) {
  const Scene scene = mappedScene(256);
  const auto error = [&](std::string_view id, auto change) {
    std::vector<RawSection> sections = test::takenApart(serialize(scene, {}).bytes);
    change(test::section(sections, id).bytes);
    return malus::test::errorMessage([&] { parse(test::putTogether(sections), "test"); });
  };
  const auto with = [&](std::string_view id, std::size_t at, auto value) {
    return error(id, [&](test::Bytes& bytes) { test::setNumber(bytes, at, value); });
  };
  constexpr std::size_t kMap = 4 * 4 + 2 * 24, kMaterial = 10 * kMap + 16;
  std::size_t first = 4;
  for (const Material& m : scene.materials) {
    if (m.meshMaps.any()) break;
    first += kMaterial;
  }
  EXPECT_CONTAINS(with("MAPS", 0, 77u), "MAPS", "number of materials");
  EXPECT_CONTAINS(with("MAPS", first, 2u), "MAPS", "texture");
  EXPECT_CONTAINS(with("MAPS", first + 4, 2u), "MAPS", "set");
  EXPECT_CONTAINS(with("MAPS", first + 8, 3u), "MAPS", "wrapU");
  EXPECT_CONTAINS(with("MAPS", first + 16, std::numeric_limits<double>::quiet_NaN()), "MAPS");
  EXPECT_CONTAINS(with("MAPS", first + 16, 1e7), "MAPS", "out of range");
  EXPECT_CONTAINS(with("MAPS", first + 2 * kMap, 1u), "MAPS", "'k'");  // of a metal only
  EXPECT_CONTAINS(error("MAPS", [](test::Bytes& bytes) { bytes.pop_back(); }), "MAPS");
  // TEXR: count, name, width, height, channels, values.
  constexpr std::size_t kChannels = 4 + 4 + 5 + 8;
  EXPECT_CONTAINS(with("TEXR", kChannels, 2u), "TEXR", "channels");
  EXPECT_CONTAINS(with("TEXR", kChannels + 4, 70000u), "TEXR", "number of values");
  EXPECT_CONTAINS(with("TEXR", kChannels + 4, 200u), "TEXR");
  EXPECT_CONTAINS(with("TEXR", kChannels + 8, -1.0f), "TEXR", "out of range");
  EXPECT_CONTAINS(with("TEXR", kChannels + 8 + 255 * 4, 2.0f), "'albedo'", "texels from");
}

}  // namespace
}  // namespace malus::pack

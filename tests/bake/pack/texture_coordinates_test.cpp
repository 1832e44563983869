// Texture coordinates and tangents of a pack: kept at their vertices, absent if no mesh has any, and validated.
#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"
#include "tests/messages.h"

namespace malus::pack {
namespace {

using bake::test::smallScene;
using bake::test::unusualScene;
using test::RawSection;

bool hasSection(const Scene& scene) {
  const Pack pack = parse(serialize(scene, {}).bytes, "test");
  return std::any_of(pack.sections.begin(), pack.sections.end(),
                     [](const Section& section) { return section.id == kTextureCoordinates; });
}

TEST(PackTextureCoordinates, StayAtTheirVertices) {
  const Scene source = unusualScene();
  const Mesh& before = source.meshes[0];
  const Scene scene = parse(serialize(source, {}).bytes, "test").scene;
  const Mesh& after = scene.meshes[0];
  ASSERT_EQ(after.positions.size(), before.positions.size());
  ASSERT_EQ(after.tangents.size(), before.tangents.size());
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    const auto nearest = static_cast<std::size_t>(std::min_element(before.positions.begin(), before.positions.end(),
                                                                   [&](const glm::dvec3& a, const glm::dvec3& b) {
                                                                     return glm::distance(a, after.positions[v]) <
                                                                            glm::distance(b, after.positions[v]);
                                                                   }) -
                                                  before.positions.begin());
    for (std::size_t set = 0; set < 2; ++set)
      EXPECT_EQ(after.textureCoordinates[set][v], before.textureCoordinates[set][nearest]) << v << ' ' << set;
    EXPECT_EQ(after.tangents[v], before.tangents[nearest]) << v;
  }
  EXPECT_FALSE(scene.meshes[1].hasTextureAttributes());
}

TEST(PackTextureCoordinates, AbsentWithoutAny) {
  EXPECT_FALSE(hasSection(smallScene()));
  EXPECT_TRUE(hasSection(unusualScene()));
  Scene plain = unusualScene();
  plain.instances.clear();
  const std::uint64_t hash = canonicalGeometryHash(plain);
  plain.meshes[0].textureCoordinates = {};
  plain.meshes[0].tangents.clear();
  EXPECT_FALSE(hasSection(plain));
  EXPECT_NE(canonicalGeometryHash(plain), hash);
  EXPECT_EQ(canonicalGeometryHash(plain), canonicalGeometryHash(smallScene()));
}

TEST(PackTextureCoordinates, InvalidValues) {
  const auto error = [](auto change) {
    std::vector<RawSection> sections = test::takenApart(serialize(unusualScene(), {}).bytes);
    change(test::section(sections, "TCRD").bytes);
    return malus::test::errorMessage([&] { parse(test::putTogether(sections), "test"); });
  };
  const auto with = [&](std::size_t at, auto value) {
    return error([&](test::Bytes& bytes) { test::setNumber(bytes, at, value); });
  };
  EXPECT_CONTAINS(with(0, 8u), "TCRD", "attributes");
  EXPECT_CONTAINS(with(4, std::numeric_limits<float>::quiet_NaN()), "TCRD", "tetrahedron", "out of range");
  EXPECT_CONTAINS(with(4, 2e6f), "TCRD", "out of range");
  constexpr std::size_t kTangents = 4 + 2 * 4 * 8;  // flags, two sets of four coordinates
  EXPECT_CONTAINS(with(kTangents, 2.0f), "TCRD", "unit vector");
  EXPECT_CONTAINS(with(kTangents + 12, 0.0f), "TCRD", "sign");
  EXPECT_CONTAINS(error([](test::Bytes& bytes) { bytes.resize(20); }), "TCRD", "end early");
  EXPECT_CONTAINS(error([](test::Bytes& bytes) { bytes.push_back(std::byte{0}); }), "TCRD");
}

}  // namespace
}  // namespace malus::pack

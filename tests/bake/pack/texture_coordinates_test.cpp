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
    EXPECT_LT(glm::distance(after.tangents[v], before.tangents[nearest]), 1e-3f) << v;
    EXPECT_EQ(after.tangents[v].w, before.tangents[nearest].w) << v;
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

// Entry of the first mesh in TCRD.
constexpr std::size_t kSet0 = 4, kStep0 = kSet0 + 16, kStep1 = kStep0 + 24, kBits = kStep1 + 8;

TEST(PackTextureCoordinates, InvalidValues) {
  const auto error = [](auto change) {
    std::vector<RawSection> sections = test::takenApart(serialize(unusualScene(), {}).bytes);
    change(test::section(sections, "TCRD").bytes);
    return malus::test::errorMessage([&] { parse(test::putTogether(sections), "test"); });
  };
  const auto with = [&](std::size_t at, auto value) {
    return error([&](test::Bytes& bytes) { test::setNumber(bytes, at, value); });
  };
  EXPECT_CONTAINS(with(0, 1u), "TCRD");
  EXPECT_CONTAINS(with(0, 3u), "TCRD");
  EXPECT_CONTAINS(with(kSet0, std::numeric_limits<double>::quiet_NaN()), "TCRD", "set0.u", "not finite");
  EXPECT_CONTAINS(with(kSet0, 0.3), "TCRD", "invalid grid");
  EXPECT_CONTAINS(with(kStep0, 0.3), "TCRD", "invalid grid");
  EXPECT_CONTAINS(with(kStep0, -1.0), "TCRD", "set0.step");
  EXPECT_CONTAINS(error([](test::Bytes& bytes) {
                    test::setNumber(bytes, kSet0 + 8, 0.0);
                    test::setNumber(bytes, kStep0, 524288.0);
                  }),
                  "tetrahedron", "texture coordinate", "out of range");
  EXPECT_CONTAINS(with(kStep0, 0.0), "tetrahedron", "Draco");
  EXPECT_CONTAINS(with(kStep1, 0.0), "tetrahedron", "Draco");
  EXPECT_CONTAINS(with(kBits, 0u), "tetrahedron", "Draco");
  EXPECT_CONTAINS(with(kBits, 1u), "TCRD", "bits");
  EXPECT_CONTAINS(with(kBits, 17u), "TCRD", "tangentBits");
  EXPECT_CONTAINS(error([](test::Bytes& bytes) { bytes.resize(20); }), "TCRD");
  EXPECT_CONTAINS(error([](test::Bytes& bytes) { bytes.push_back(std::byte{0}); }), "TCRD");
  std::vector<RawSection> sections = test::takenApart(serialize(unusualScene(), {}).bytes);
  std::erase_if(sections, [](const RawSection& s) { return s.id == "TCRD"; });
  EXPECT_CONTAINS(malus::test::errorMessage([&] { parse(test::putTogether(sections), "test"); }), "tetrahedron",
                  "Draco");
}

TEST(PackTextureCoordinates, TangentsBeyondTheirBits) {
  Scene scene = unusualScene();
  scene.meshes[0].tangents.assign(4, {0.48f, 0.36f, 0.8f, 1});  // not exact in few bits
  std::vector<RawSection> sections = test::takenApart(serialize(scene, {}).bytes);
  test::setNumber(test::section(sections, "TCRD").bytes, kBits, 4u);
  EXPECT_CONTAINS(malus::test::errorMessage([&] { parse(test::putTogether(sections), "test"); }), "tetrahedron",
                  "tangent is out of range");
}

TEST(PackTextureCoordinates, FlippedBitsAreErrorsOrInRange) {
  const std::vector<RawSection> whole = test::takenApart(serialize(unusualScene(), {}).bytes);
  for (const char* id : {"TCRD", "GEOM"}) {
    std::vector<RawSection> sections = whole;
    test::Bytes& bytes = test::section(sections, id).bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      for (int bit = 0; bit < 8; ++bit) {
        bytes[i] ^= static_cast<std::byte>(1 << bit);
        const std::string error = malus::test::errorMessage([&] {
          for (const Mesh& mesh : parse(test::putTogether(sections), "file.pack").scene.meshes) {
            for (const std::vector<glm::vec2>& set : mesh.textureCoordinates) {
              ASSERT_TRUE(set.empty() || set.size() == mesh.positions.size());
              for (const glm::vec2& uv : set) ASSERT_LE(glm::length(uv), 3 * kMaxTextureCoordinate);
            }
            for (const glm::vec4& t : mesh.tangents) ASSERT_NEAR(glm::length(glm::vec3(t)), 1, 1e-5);
          }
        });
        if (!error.empty()) {
          ASSERT_TRUE(malus::test::contains(error, "file.pack")) << error;
        }
        bytes[i] ^= static_cast<std::byte>(1 << bit);
      }
  }
}

TEST(PackTextureCoordinates, UnchangedMeshesAreReused) {
  const Scene scene = unusualScene();
  const Written first = serialize(scene, {});
  const Pack pack = parse(first.bytes, "test");
  const PreviousPack previous{&pack, first.bytes};
  const Written again = serialize(scene, {}, &previous);
  EXPECT_TRUE(again.meshes[0].reused);
  EXPECT_EQ(again.bytes, first.bytes);
  Scene moved = scene;
  moved.meshes[0].textureCoordinates[0][2].x += 0.25f;
  EXPECT_FALSE(serialize(moved, {}, &previous).meshes[0].reused);
  WriteSettings finer;
  finer.bounds.uvErrorTexels = 1e-3;
  EXPECT_FALSE(serialize(scene, finer, &previous).meshes[0].reused);
}

TEST(PackTextureCoordinates, BoundsAreKeptOrRefused) {
  Scene scene = unusualScene();
  for (std::size_t i = 0; i < 4; ++i) scene.meshes[0].textureCoordinates[0][i] = {0.1f * float(i), 0.7f};
  WriteSettings settings;
  for (const double bound : {0.0625, 1.0, 4.0}) {
    settings.bounds.uvErrorTexels = bound;
    const Written written = serialize(scene, settings);
    EXPECT_LE(written.meshes[0].texture.deviation.uvTexels, bound);
    EXPECT_GT(written.meshes[0].texture.deviation.uvTexels, 0);
    EXPECT_EQ(written.meshes[0].texture.texels, 2);  // of the texture of its material
  }
  scene.meshes[0].textureCoordinates[1] = {{1e6f, 0}, {-1e6f, 0}, {1e-6f, 1e-6f}, {0, 0}};
  settings.bounds.uvErrorTexels = 1e-7;
  EXPECT_CONTAINS(malus::test::errorMessage([&] { serialize(scene, settings); }), "tetrahedron", "--max-uv-error");
  settings.bounds.uvErrorTexels.reset();
  EXPECT_TRUE(serialize(scene, settings).warnings.empty());
}

}  // namespace
}  // namespace malus::pack

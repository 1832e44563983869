// Baking over a previous pack: unchanged meshes are reused, and the bytes equal those of a full bake.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/bake_report.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/previous_pack.h"
#include "meshprep/base/atomic_file.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/shapes.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

constexpr auto kSilent = [](std::string_view) {};

// A pyramid inside the cube, so that its height does not change the bounding box.
std::string pyramid(double height) {
  return fmt::format(
      "v -0.3 -0.3 -0.3\nv 0.3 -0.3 -0.3\nv 0.3 -0.3 0.3\nv -0.3 -0.3 0.3\nv 0 {} 0\n"
      "f 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n",
      height);
}

class Rebake : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("cube.obj", test::kCubeObj);
    folder_.write("square.obj", test::kSquareObj);
    folder_.write("pyramid.obj", pyramid(0.2));
    scene_ = json::parse(R"({
      "malus": 1, "name": "test",
      "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"gold": {"type": "metal", "preset": "gold"}},
      "meshes": [{"name": "cube", "file": "cube.obj", "material": "gold", "instances": [{}, {"translate": [2, 0, 0]}]},
                 {"name": "pyramid", "file": "pyramid.obj", "material": "gold"},
                 {"name": "square", "file": "square.obj", "material": "gold"}]})");
  }
  SceneDescription description() { return readSceneFile(folder_.write("scene.json", scene_.dump())); }

  // Bakes from scratch and over the existing pack; writes the second.
  struct Both {
    pack::Written fresh, again;
    Baked baked;
  };
  Both bakeBoth() {
    const SceneDescription d = description();
    Both both;
    both.baked = bake(d, settings_, kSilent);
    both.fresh = pack::serialize(both.baked.scene, settings_);
    const std::optional<PreviousBake> previous = readPrevious(pack_);
    const bool usable = previous && isOfSameVersions(*previous, both.baked.scene.provenance);
    const pack::PreviousPack source{usable ? &previous->pack : nullptr,
                                    usable ? previous->bytes : std::span<const std::byte>()};
    both.again = pack::write(pack_, both.baked.scene, settings_, usable ? &source : nullptr);
    EXPECT_TRUE(both.again.bytes == both.fresh.bytes);
    EXPECT_TRUE(readFile(pack_) == both.fresh.bytes);
    return both;
  }
  static std::vector<bool> reused(const pack::Written& written) {
    std::vector<bool> list;
    for (const pack::MeshCompression& m : written.meshes) list.push_back(m.reused);
    return list;
  }

  TemporaryFolder folder_;
  json scene_;
  pack::WriteSettings settings_;
  std::filesystem::path pack_ = folder_.path() / "out.pack";
};

using List = std::vector<bool>;

TEST_F(Rebake, OnlyTheChangedMeshIsReencoded) {
  EXPECT_EQ(reused(bakeBoth().again), (List{false, false, false, false}));
  folder_.write("pyramid.obj", pyramid(0.25));
  const Both both = bakeBoth();
  EXPECT_EQ(reused(both.again), (List{true, true, false, true}));
  EXPECT_EQ(both.again.fullRebakeReason, "");
  EXPECT_EQ(bakeJson(both.baked, both.again, "out.pack").at("reencoded"), 1);
  EXPECT_CONTAINS(bakeText(both.baked, both.again, "out.pack", true), "1 of 4 meshes");
  // The errors of a reused mesh are those of its encoding.
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(both.again.meshes[i].deviation.positionMax, both.fresh.meshes[i].deviation.positionMax);
    EXPECT_EQ(both.again.meshes[i].method, both.fresh.meshes[i].method);
    EXPECT_EQ(both.again.meshes[i].sequentialReason, both.fresh.meshes[i].sequentialReason);
  }
  // Other keys, another order or another name reencode no mesh.
  scene_["exposureEv"] = 1;
  std::swap(scene_["meshes"][1], scene_["meshes"][2]);
  scene_["meshes"][1]["name"] = "plate";
  EXPECT_EQ(reused(bakeBoth().again), (List{true, true, true, true}));
}

TEST_F(Rebake, MovedInstanceWithinTheBoxReencodesOneMesh) {
  bakeBoth();
  scene_["meshes"][1]["instances"] = json::parse(R"([{"translate": [0.5, 0, 0]}])");
  EXPECT_EQ(reused(bakeBoth().again), (List{true, true, false, true}));
}

TEST_F(Rebake, SimplificationReencodesOneMesh) {
  prep::Mesh ball = prep::test::sphere(15, 20);
  for (glm::dvec3& p : ball.positions) p *= 0.3;
  folder_.write("ball.obj", prep::test::objText(ball));
  json& mesh = scene_["meshes"][1];
  mesh["file"] = "ball.obj";
  EXPECT_EQ(reused(bakeBoth().again), (List{false, false, false, false}));

  // A changed value of each key is a changed mesh; equal values reuse it.
  const std::vector<std::pair<const char*, double>> changes = {
      {"simplifyError", 0.01}, {"simplifyError", 0.02}, {"simplifyNormal", 10}, {"simplifyTriangles", 580}};
  std::string provenance = makeProvenance(description(), settings_);
  std::size_t triangles = ball.triangles.size();
  for (const auto& [key, value] : changes) {
    mesh[key] = value;
    if (std::string_view(key) == "simplifyTriangles") mesh[key] = static_cast<int>(value);
    EXPECT_NE(makeProvenance(description(), settings_), provenance) << key;  // the earlier pack is out of date
    provenance = makeProvenance(description(), settings_);
    const Both both = bakeBoth();
    EXPECT_EQ(reused(both.again), (List{true, true, false, true})) << key << " " << value;
    EXPECT_NE(both.baked.scene.meshes[2].triangles.size(), triangles) << key << " " << value;
    triangles = both.baked.scene.meshes[2].triangles.size();
    EXPECT_EQ(reused(bakeBoth().again), (List{true, true, true, true})) << key << " " << value;
  }
}

TEST_F(Rebake, MovedGridReencodesAllWithReason) {
  bakeBoth();
  scene_["meshes"][0]["instances"][1]["translate"] = {3, 0, 0};
  const Both both = bakeBoth();
  EXPECT_EQ(reused(both.again), (List{false, false, false, false}));
  EXPECT_CONTAINS(both.again.fullRebakeReason, "grid");
  EXPECT_CONTAINS(bakeText(both.baked, both.again, "out.pack", true), "4 of 4 meshes");
}

TEST_F(Rebake, ChangedBitsReencodeAll) {
  bakeBoth();
  settings_.bounds.positionBits = 21;
  const Both both = bakeBoth();
  EXPECT_EQ(reused(both.again), (List{false, false, false, false}));
  EXPECT_CONTAINS(both.again.fullRebakeReason, "positions", "21 bits", "19");
  settings_.bounds.normalBits = 9;  // the square and the others have normals
  EXPECT_EQ(reused(bakeBoth().again), (List{false, false, false, false}));
}

TEST_F(Rebake, SourceMapIsReused) {
  bakeBoth();
  settings_.keepMap = true;
  EXPECT_EQ(reused(bakeBoth().again), (List{false, false, false, false}));  // the previous pack has none
  folder_.write("pyramid.obj", pyramid(0.25));
  EXPECT_EQ(reused(bakeBoth().again), (List{true, true, false, true}));
  // The same mesh with other source vertex indices.
  pack::Scene scene = bake(description(), settings_, kSilent).scene;
  scene.meshes[3].sourceVertices = {11, 12, 13, 14};
  const std::optional<PreviousBake> previous = readPrevious(pack_);
  const pack::PreviousPack source{&previous->pack, previous->bytes};
  const pack::Written written = pack::serialize(scene, settings_, &source);
  EXPECT_EQ(reused(written), (List{true, true, true, false}));
  EXPECT_TRUE(written.bytes == pack::serialize(scene, settings_).bytes);
  const pack::Pack pack = pack::parse(written.bytes, "test");
  for (const std::uint32_t v : pack.scene.meshes[3].sourceVertices) EXPECT_TRUE(v >= 11 && v <= 14) << v;
}

TEST_F(Rebake, PacksOfOtherVersionsAreNotReused) {
  const std::string provenance = makeProvenance(description(), settings_);
  PreviousBake previous;
  previous.pack.scene.provenance = provenance;
  EXPECT_TRUE(isUpToDate(previous, provenance));
  EXPECT_TRUE(isOfSameVersions(previous, provenance));
  for (const char* key : {"malus", "baker", "draco"}) {
    json changed = json::parse(provenance);
    changed[key] = "another";
    previous.pack.scene.provenance = changed.dump();
    EXPECT_FALSE(isOfSameVersions(previous, provenance)) << key;
  }
  previous.pack.scene.provenance = "not JSON";
  EXPECT_FALSE(isOfSameVersions(previous, provenance));
  EXPECT_FALSE(isUpToDate(previous, provenance));
}

TEST_F(Rebake, DamagedPackIsNotReused) {
  EXPECT_FALSE(readPrevious(pack_).has_value());
  bakeBoth();
  EXPECT_TRUE(readPrevious(pack_).has_value());
  std::vector<std::byte> bytes = readFile(pack_);
  bytes[bytes.size() / 2] ^= std::byte{1};
  writeFile(pack_, bytes);
  EXPECT_FALSE(readPrevious(pack_).has_value());
}

TEST_F(Rebake, SettingsAreInTheProvenance) {
  const SceneDescription d = description();
  const std::string plain = makeProvenance(d, {});
  std::vector<pack::WriteSettings> others(5);
  others[0].bounds.positionError = 1e-4;
  others[1].bounds.normalErrorDegrees = 0.1;
  others[2].bounds.positionBits = 20;
  others[3].bounds.normalBits = 12;
  others[4].keepMap = true;
  for (const pack::WriteSettings& settings : others) EXPECT_NE(makeProvenance(d, settings), plain);
}

TEST_F(Rebake, UnreachableBoundNamesTheMesh) {
  settings_.bounds.positionError = 1e-15;
  const Baked baked = bake(description(), settings_, kSilent);
  const std::string error = test::errorMessage([&] { pack::serialize(baked.scene, settings_); });
  EXPECT_TRUE(error.starts_with("mesh '")) << error;
  EXPECT_CONTAINS(error, "': position error");
  settings_.bounds.positionError = 1e-4;
  const pack::Written written = pack::serialize(baked.scene, settings_);
  EXPECT_LT(written.positionBits, 20);
  for (const pack::MeshCompression& m : written.meshes) EXPECT_LE(m.deviation.positionMax, 1e-4);
}

}  // namespace
}  // namespace malus::bake

// Regression test of the packs of the three scenes: counts, a hash of each section except the provenance (which
// contains versions) and the encodings (whose errors depend on the machine's arc tangent), a hash of the decoded
// geometry, and counts, bytes and geometry hash of each mesh.
//
// A failing test writes the pack that it baked and prints the commands that compare it with the previous one.
//
// After an intended change, MALUS_UPDATE_GOLDEN=1 test_golden rewrites tests/bake/golden.json and fails, so that no
// test run passes while updating. Commit the new file together with the change and explain it there.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/format.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "meshprep/base/atomic_file.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;

const std::filesystem::path kSource = MALUS_SOURCE_DIR;
const std::filesystem::path kGolden = kSource / "tests/bake/golden.json";

// Counts and resolutions given by the paper.
struct Expected {
  const char* name;
  std::uint64_t vertices, triangles;
  std::uint32_t width, height;
};
void PrintTo(const Expected& scene, std::ostream* stream) { *stream << scene.name; }
constexpr Expected kScenes[] = {
    {"glass-wall", 36, 28, 1920, 1080}, {"cornell-box", 74, 38, 2048, 2048}, {"engine", 10448, 12510, 2048, 2048}};

struct Result {
  std::vector<std::byte> bytes;
  pack::Pack pack;
};

Result bakeScene(const std::string& name) {
  Result result;
  const SceneDescription description = readSceneFile(kSource / "scenes" / name / "scene.json");
  const Baked baked = bake(description, {}, [](std::string_view) {});
  result.bytes = pack::serialize(baked.scene, {}).bytes;
  result.pack = pack::parse(result.bytes, name);
  return result;
}

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

json summarize(const pack::Pack& pack) {
  json sections = json::object();
  for (const pack::Section& s : pack.sections)
    if (s.id != pack::kProvenance && s.id != pack::kEncodings)
      sections[s.id] = {{"sizeBytes", s.sizeBytes}, {"hash", hex(s.hash)}};
  json meshes = json::object();
  for (std::size_t i = 0; i < pack.scene.meshes.size(); ++i) {
    const pack::Mesh& mesh = pack.scene.meshes[i];
    pack::Scene alone;
    alone.meshes = {mesh};
    meshes[mesh.name] = {{"vertices", mesh.positions.size()},
                         {"triangles", mesh.triangles.size()},
                         {"encoding", pack.compression[i]},
                         {"sizeBytes", pack.geometry[i].sizeBytes},
                         {"geometryHash", hex(pack::canonicalGeometryHash(alone))}};
  }
  return {{"vertices", pack.scene.vertexCount()},
          {"triangles", pack.scene.triangleCount()},
          {"meshes", meshes},
          {"geometryHash", hex(pack::canonicalGeometryHash(pack.scene))},
          {"sections", sections}};
}

bool updating() {
  const char* set = std::getenv("MALUS_UPDATE_GOLDEN");
  return set != nullptr && std::string_view(set) == "1";
}

json readGolden() {
  std::ifstream stream(kGolden);
  return stream ? json::parse(stream, nullptr, false) : json();
}

// Returns one line per differing leaf.
std::string differences(const json& expected, const json& found) {
  const json before = expected.is_object() ? expected.flatten() : json::object(), after = found.flatten();
  std::string text;
  for (const auto& item : before.items())
    if (!after.contains(item.key()))
      text += fmt::format("  {}: was {}, is removed\n", item.key(), item.value().dump());
    else if (after[item.key()] != item.value())
      text += fmt::format("  {}: was {}, is {}\n", item.key(), item.value().dump(), after[item.key()].dump());
  for (const auto& item : after.items())
    if (!before.contains(item.key())) text += fmt::format("  {}: is new, {}\n", item.key(), item.value().dump());
  return text;
}

// Returns the commands that compare the new pack with that of the commit that last changed golden.json.
std::string comparisonCommands(const std::string& name, const std::filesystem::path& newPack) {
  return fmt::format(
      "To see what changed, bake the scene with the malus of the commit before and compare:\n"
      "  git worktree add /tmp/before $(git log -1 --format=%H -- tests/bake/golden.json)\n"
      "  (build `malus` there) && malus bake /tmp/before/scenes/{0}/scene.json -o /tmp/{0}.pack\n"
      "  malus info /tmp/{0}.pack --diff {1}\n",
      name, newPack.string());
}

class Golden : public testing::TestWithParam<Expected> {};

TEST_P(Golden, Counts) {
  const pack::Scene scene = bakeScene(GetParam().name).pack.scene;
  EXPECT_EQ(scene.name, GetParam().name);
  EXPECT_EQ(scene.vertexCount(), GetParam().vertices);
  EXPECT_EQ(scene.triangleCount(), GetParam().triangles);
  EXPECT_EQ(scene.width, GetParam().width);
  EXPECT_EQ(scene.height, GetParam().height);
  EXPECT_GE(scene.depth, 2u);
}

TEST_P(Golden, Sections) {
  const std::string name = GetParam().name;
  const Result result = bakeScene(name);
  const json found = summarize(result.pack);
  json golden = readGolden();
  if (updating()) {
    if (!golden.is_object()) golden = json::object();
    golden[name] = found;
    std::ofstream stream(kGolden);
    stream << golden.dump(2) << '\n';
    ASSERT_TRUE(stream.flush()) << "cannot write " << kGolden;
    FAIL() << "wrote " << name << " into " << kGolden << "; run again without MALUS_UPDATE_GOLDEN";
  }
  ASSERT_TRUE(golden.is_object()) << kGolden << " is missing or not valid JSON; MALUS_UPDATE_GOLDEN=1 writes it";
  ASSERT_TRUE(golden.contains(name)) << kGolden << " has no entry for " << name;
  const std::string text = differences(golden[name], found);
  if (text.empty()) return;
  const std::filesystem::path newPack =
      std::filesystem::path(testing::TempDir()) / fmt::format("malus-golden-{}.pack", name);
  writeFile(newPack, result.bytes);
  FAIL() << "the pack of " << name << " differs from " << kGolden << ":\n"
         << text << comparisonCommands(name, newPack)
         << "If the change is intended, MALUS_UPDATE_GOLDEN=1 rewrites the file.";
}

TEST_P(Golden, BakingIsDeterministic) {
  const Result a = bakeScene(GetParam().name), b = bakeScene(GetParam().name);
  EXPECT_TRUE(a.bytes == b.bytes);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(kScenes), [](const auto& scene) {
  std::string name = scene.param.name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

TEST(GoldenDifference, NamesTheMeshAndHowToCompare) {
  pack::Scene scene = test::smallScene();
  const json before = summarize(pack::parse(pack::serialize(scene, {}).bytes, "before"));
  scene.meshes[1].positions[2].y = 0.9f;
  const std::string text = differences(before, summarize(pack::parse(pack::serialize(scene, {}).bytes, "after")));
  EXPECT_CONTAINS(text, "  /meshes/sheet/geometryHash: was ");
  EXPECT_CONTAINS(text, "  /sections/GEOM/hash: was ");
  EXPECT_FALSE(test::contains(text, "/meshes/tetrahedron")) << text;
  EXPECT_FALSE(test::contains(text, "/sections/CAMR")) << text;
  EXPECT_CONTAINS(comparisonCommands("engine", "/tmp/today.pack"),
                  "malus info /tmp/engine.pack --diff /tmp/today.pack\n");
}

TEST(GoldenDifference, IsReadable) {
  const json before = {{"vertices", 36}, {"sections", {{"GEOM", {{"hash", "aa"}}}, {"OLD", 1}}}};
  const json after = {{"vertices", 38}, {"sections", {{"GEOM", {{"hash", "bb"}}}}}, {"triangles", 2}};
  EXPECT_EQ(differences(before, after),
            "  /sections/GEOM/hash: was \"aa\", is \"bb\"\n  /sections/OLD: was 1, is removed\n"
            "  /vertices: was 36, is 38\n  /triangles: is new, 2\n");
  EXPECT_EQ(differences(before, before), "");
}

}  // namespace
}  // namespace malus::bake

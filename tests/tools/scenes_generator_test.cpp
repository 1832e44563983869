// tools/scenes/generate writes exactly the committed files.
#include <set>

#include "tests/tools/command.h"

namespace malus::test {
namespace {
namespace fs = std::filesystem;

// Returns the paths of all files below a folder, relative to it.
std::set<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder).string());
  return files;
}

TEST(ScenesGenerator, WritesTheCommittedFiles) {
  const fs::path source = MALUS_SOURCE_DIR;
  const Folder output;
  const Finished finished =
      run({"python3", (source / "tools/scenes/generate").string(), "--out", output.path().string()});
  ASSERT_EQ(finished.exitCode, 0) << finished.err;
  const std::set<std::string> generated = filesBelow(output.path()), committed = filesBelow(source / "scenes");
  EXPECT_TRUE(generated.contains("engine/scene.json"));
  for (const std::string& file : generated) {
    if (!committed.contains(file)) {
      ADD_FAILURE() << "scenes/" << file << " is generated and not committed";
      continue;
    }
    const std::string found = readText(output / file), expected = readText(source / "scenes" / file);
    const auto at = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end()).first - found.begin();
    EXPECT_TRUE(found == expected) << "scenes/" << file << " differs from byte " << at << " on (" << found.size()
                                   << " bytes generated, " << expected.size() << " committed)";
  }
  for (const std::string& file : committed) {
    const std::string extension = fs::path(file).extension();
    const bool isSource = extension == ".json" || extension == ".obj" || extension == ".ply" || extension == ".stl" ||
                          extension == ".off" || extension == ".hdr" || extension == ".glb";
    if (isSource) {
      EXPECT_TRUE(generated.contains(file)) << "scenes/" << file << " is committed and not generated";
    }
  }
}

TEST(ScenesGenerator, UnknownNamesAreAnError) {
  const Folder output;
  const Finished finished = run({"python3", std::string(MALUS_SOURCE_DIR) + "/tools/scenes/generate", "--out",
                                 output.path().string(), "no-such-scene"});
  EXPECT_NE(finished.exitCode, 0);
  EXPECT_TRUE(contains(finished.err, "no-such-scene")) << finished.err;
}

}  // namespace
}  // namespace malus::test

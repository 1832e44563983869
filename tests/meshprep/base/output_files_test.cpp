#include "meshprep/base/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/usage_error.h"

namespace malus {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
 protected:
  Outputs() : folder_(fs::path(testing::TempDir()) / ("malus-outputs-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "sub");
    writeFile(input(), "input");
  }
  ~Outputs() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path input() const { return folder_ / "in.obj"; }
  bool refusesOverInput(const fs::path& output) const {
    OutputFiles files;
    files.addInput(input());
    files.addOutput(output, "--output");
    return refuses(files);
  }
  bool refusesPair(const fs::path& a, const fs::path& b) const {
    OutputFiles files;
    files.addOutput(a, "--output");
    files.addOutput(b, "--report");
    return refuses(files);
  }
  static bool refuses(const OutputFiles& files) {
    try {
      files.check();
    } catch (const UsageError&) {
      return true;
    }
    return false;
  }
  fs::path folder_;
};

TEST_F(Outputs, AreNotInputs) {
  fs::create_symlink("in.obj", folder_ / "symbolic");
  fs::create_symlink("symbolic", folder_ / "twice");
  fs::create_hard_link(input(), folder_ / "hard");
  fs::create_directory_symlink("sub", folder_ / "other");
  for (const char* name : {"in.obj", "./in.obj", "sub/../in.obj", "other/../in.obj", "symbolic", "twice", "hard"})
    EXPECT_TRUE(refusesOverInput(folder_ / name)) << name;
  EXPECT_FALSE(refusesOverInput(folder_ / "out.obj"));
  EXPECT_FALSE(refusesOverInput(folder_ / "sub/in.obj"));
}

TEST_F(Outputs, AreNotMissingInputs) {
  OutputFiles files;
  files.addInput(folder_ / "missing.bin");
  files.addOutput(folder_ / "sub/../missing.bin", "--output");
  EXPECT_TRUE(refuses(files));
}

TEST_F(Outputs, AreFilesOfTheirOwn) {
  fs::create_symlink("new", folder_ / "dangling");
  fs::create_directory_symlink("sub", folder_ / "other");
  EXPECT_TRUE(refusesPair(folder_ / "new", folder_ / "new"));
  EXPECT_TRUE(refusesPair(folder_ / "new", folder_ / "./new"));
  EXPECT_TRUE(refusesPair(folder_ / "new", folder_ / "dangling"));
  EXPECT_TRUE(refusesPair(folder_ / "sub/new", folder_ / "other/new"));
  EXPECT_TRUE(refusesPair(folder_ / "none/new", folder_ / "none/./new"));
  EXPECT_FALSE(refusesPair(folder_ / "new", folder_ / "sub/new"));
  EXPECT_FALSE(refusesPair(folder_ / "new", folder_ / "old"));
}

// Whatever this file system does with names in another case, the check agrees with it, and leaves nothing behind.
TEST_F(Outputs, FollowTheCaseRulesOfTheFileSystem) {
  const std::pair<const char*, const char*> kPairs[] = {{"new", "NEW"}, {"\xc3\xa4", "\xc3\x84"}};
  for (const auto& [a, b] : kPairs) {
    const bool refused = refusesPair(folder_ / a, folder_ / b);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
    writeFile(folder_ / a, "");
    EXPECT_EQ(refused, fs::exists(folder_ / b)) << a;
    fs::remove(folder_ / a);
  }
}

TEST_F(Outputs, AreRegularFiles) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/full", folder_ / "link");
  for (const fs::path& path : {fs::path("/dev/null"), fs::path("/dev/full"), folder_ / "link", folder_ / "pipe",
                               fs::path("/dev/sdzz9"), fs::path("/dev/../dev/sdzz9")})
    EXPECT_TRUE(refusesPair(path, {})) << path;
  OutputFiles folder;
  folder.addOutputFolder("/dev/null", "--output");
  EXPECT_TRUE(refuses(folder));
  OutputFiles fine;
  fine.addOutputFolder(folder_, "--output");
  fine.addOutput(input(), "--output");  // an old result may be replaced
  EXPECT_FALSE(refuses(fine));
}

TEST_F(Outputs, AreWrittenThroughLinks) {
  fs::create_symlink("sub/target", folder_ / "link");
  writeFile(folder_ / "link", "text");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(readTextFile(folder_ / "sub/target"), "text");
}

}  // namespace
}  // namespace malus

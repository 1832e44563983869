// Temporary files of killed writers are removed by the next write; those of living writers are kept.
#include "meshprep/base/unfinished_files.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "tests/meshprep/shapes.h"

namespace malus {
namespace {

namespace fs = std::filesystem;

class UnfinishedFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(folder_)) list.push_back(entry.path().filename().string());
    std::sort(list.begin(), list.end());
    return list;
  }
  void touch(const std::string& name) const { std::ofstream(folder_ / name) << "half of a pack"; }

  const fs::path folder_ = prep::test::temporaryPath(".folder");
  const fs::path output_ = folder_ / "out.pack";
};

// Child process that creates a temporary file and never finishes it.
class Writer {
 public:
  explicit Writer(const fs::path& path) {
    int ready[2];
    if (::pipe(ready) != 0) throw Error("test", "no pipe");
    process_ = ::fork();
    if (process_ == 0) {
      const UnfinishedFile file(path);
      const char done = file.path().empty() ? '0' : '1';
      static_cast<void>(::write(ready[1], &done, 1));
      while (true) ::pause();
    }
    char byte = 0;
    if (::read(ready[0], &byte, 1) != 1) throw Error("test", "the writer did not start");
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Writer() { kill(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

TEST_F(UnfinishedFiles, KeepsFilesOfLivingWritersAndRemovesThoseOfKilledOnes) {
  Writer writer(output_);
  ASSERT_EQ(names().size(), 1u);
  EXPECT_EQ(removeAbandoned(output_), 0);
  writeFile(output_, std::string_view("whole"));
  EXPECT_EQ(names().size(), 2u);
  writer.kill();
  EXPECT_EQ(names().size(), 2u);
  writeFile(output_, std::string_view("whole again"));
  EXPECT_EQ(names(), std::vector<std::string>{"out.pack"});
  EXPECT_EQ(readTextFile(output_), "whole again");
}

TEST_F(UnfinishedFiles, KeepsFilesOfOtherNamesAndHosts) {
  std::string own;
  {
    const UnfinishedFile file(output_);
    own = file.path().filename().string();
    EXPECT_EQ(removeAbandoned(output_), 0);  // locks of the same process count
  }
  EXPECT_TRUE(names().empty());  // removed, because it was not renamed
  ASSERT_TRUE(own.starts_with(".out.") && own.ends_with(".part.pack")) << own;
  const std::string host = own.substr(5, own.find('-') - 5);
  const std::vector<std::string> others = {".other." + host + "-1-0.part.pack",      ".out." + host + "-1-0.part.exr",
                                           ".out." + host + "-x-0.part.pack",        ".out." + host + "-1.part.pack",
                                           ".out.another" + host + "-1-0.part.pack", "out.pack"};
  for (const std::string& name : others) touch(name);
  fs::create_directory(folder_ / (".out." + host + "-2-0.part.pack"));
  touch(".out." + host + "-1-0.part.pack");
  EXPECT_EQ(names().size(), others.size() + 2);
  EXPECT_EQ(removeAbandoned(output_), 1);
  EXPECT_EQ(names().size(), others.size() + 1);
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
}

TEST_F(UnfinishedFiles, FailedWritesLeaveNothing) {
  writeFile(output_, std::string_view("before"));
  EXPECT_THROW(writeBeside(output_,
                           [](const fs::path& file) {
                             std::ofstream(file) << "half";
                             throw Error("test", "stopped");
                           }),
               Error);
  EXPECT_EQ(names(), std::vector<std::string>{"out.pack"});
  EXPECT_EQ(readTextFile(output_), "before");
  EXPECT_THROW(writeFile(folder_ / "missing" / "out.pack", std::string_view("x")), Error);
  EXPECT_EQ(removeAbandoned(folder_ / "missing" / "out.pack"), 0);
}

TEST_F(UnfinishedFiles, NewFilesFollowTheUmask) {
  const mode_t mask = ::umask(022);
  writeFile(output_, std::string_view("x"));
  ::umask(mask);
  EXPECT_EQ(fs::status(output_).permissions(), fs::perms(0644));
}

}  // namespace
}  // namespace malus

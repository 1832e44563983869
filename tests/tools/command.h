// Runs the built `malus` on small files.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/tools/process.h"

namespace malus::test {

inline Finished malus(std::vector<std::string> arguments, const Start& start = {}) {
  arguments.insert(arguments.begin(), MALUS_BINARY);
  return run(arguments, start);
}

// Runs `malus` with a limit on the size of each file that it writes [kilobytes], as on a disk that fills up.
inline Finished malusWithFileLimit(int kilobytes, std::vector<std::string> arguments) {
  // POSIX counts ulimit -f in units of 512 bytes.
  std::vector<std::string> command = {"/bin/sh", "-c", "ulimit -f " + std::to_string(2 * kilobytes) + "; exec \"$@\"",
                                      "sh", MALUS_BINARY};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run(command);
}

inline std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void writeText(const std::filesystem::path& file, std::string_view text) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  ASSERT_TRUE(stream.flush()) << file;
}

// Whether the text contains every one of the parts.
template <class... Parts>
bool contains(std::string_view text, const Parts&... parts) {
  return (... && (text.find(parts) != std::string_view::npos));
}

// A new temporary folder, removed with its contents by the destructor.
class Folder {
 public:
  Folder() {
    static std::atomic<int> counter{0};
    path_ = std::filesystem::path(testing::TempDir()) /
            ("malus-command-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(std::string_view name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

  // Returns the sorted names of the entries.
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) list.push_back(entry.path().filename());
    std::sort(list.begin(), list.end());
    return list;
  }

 private:
  std::filesystem::path path_;
};

// Writes scene.json and its two meshes: a gold cube on a painted floor under a point light. The baked scene has 28
// vertices and 14 triangles.
inline void writeTinyScene(const std::filesystem::path& folder) {
  writeText(folder / "cube.obj",
            "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 1 -0.5\nv -0.5 1 -0.5\n"
            "v -0.5 0 0.5\nv 0.5 0 0.5\nv 0.5 1 0.5\nv -0.5 1 0.5\n"
            "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  writeText(folder / "floor.obj", "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nf 4 3 2 1\n");
  writeText(folder / "scene.json", R"({
  "malus": 1, "name": "tiny", "resolution": [64, 48], "depth": 4,
  "camera": {"position": [2, 2, 5], "target": [0, 0.5, 0], "verticalFovDegrees": 35},
  "environment": {"radiance": [0.4, 0.5, 0.6], "ambientIrradiance": 1},
  "lights": [{"type": "point", "position": [2, 4, 2], "intensity": [20, 20, 20]}],
  "materials": {"gold": {"type": "metal", "preset": "gold"}, "floor": {"type": "paint", "albedo": 0.5}},
  "meshes": [{"name": "cube", "file": "cube.obj", "material": "gold"},
             {"name": "floor", "file": "floor.obj", "material": "floor"}]
})");
}

// Expects a failed command: exit code 1, nothing on stdout, one line on stderr that contains every keyword.
template <class... Keyword>
void expectRefusal(const Finished& finished, const Keyword&... keywords) {
  EXPECT_EQ(finished.exitCode, 1) << finished.err << "signal " << finished.signal;
  EXPECT_EQ(finished.out, "");
  EXPECT_TRUE(finished.err.starts_with("malus: ")) << finished.err;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_TRUE(finished.err.ends_with('\n')) << finished.err;
  for (const std::string_view keyword : {std::string_view(keywords)...})
    EXPECT_TRUE(contains(finished.err, keyword)) << keyword << " / " << finished.err;
}

}  // namespace malus::test

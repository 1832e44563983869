// Cost of reading arbitrary files of a few megabytes: memory proportional to the file size, termination, and an Error
// for invalid meshes. Each file is read and triangulated in a child process with limited memory and an alarm, which is
// far above the usual time.
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "meshprep/clean/triangulate.h"
#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/binary_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

constexpr std::size_t kBytes = 2'000'000;
constexpr unsigned kAlarmSeconds = 60;
constexpr int kRefused = 1;
constexpr int kOutOfMemory = 2;

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  all.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

// Returns the text repeated up to the file size.
std::string fill(const std::string& text) { return times(kBytes / text.size(), text); }

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimited = false;  // the sanitizers reserve terabytes
#else
constexpr bool kLimited = true;
#endif

// Returns the address space before reading: libraries, and what earlier tests left.
std::size_t addressSpace() {
  std::size_t pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Limits the address space, which exceeds the used memory, to 512 MB per 10 MB of the file and 64 MB.
void limitMemory(std::size_t fileBytes) {
  const auto limit = static_cast<rlim_t>(addressSpace() + fileBytes / 10 * 512 + (std::size_t{64} << 20));
  const rlimit both{limit, limit};
  if (kLimited) ::setrlimit(RLIMIT_AS, &both);
}

// Allocates what the heap has free: it is a remainder of earlier tests, and memory that the limit would not count.
void useFreeHeap() {
  const auto mapped = [] {
    const struct mallinfo2 info = ::mallinfo2();
    return info.arena + info.hblkhd;
  };
  for (std::size_t block = std::size_t{1} << 30; block >= 4096; block /= 2)
    for (;;) {
      const std::size_t before = mapped();
      void* const memory = std::malloc(block);
      const bool grew = mapped() > before;
      if (memory == nullptr || grew) {
        std::free(memory);
        break;
      }
    }
}

// Reads and triangulates the file in a child process. Returns 0, kRefused, kOutOfMemory, or 256 + the signal.
int outcome(const std::filesystem::path& path, std::size_t fileBytes) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (kLimited) useFreeHeap();
    limitMemory(fileBytes);
    ::alarm(kAlarmSeconds);
    int code = 0;
    try {
      TriangulateCounts counts;
      triangulate(readMesh(path), counts);
    } catch (const Error&) {
      code = kRefused;
    } catch (const std::bad_alloc&) {
      code = kOutOfMemory;
    }
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
}

void expectOutcome(int expected, std::string_view extension, const std::string& text, const std::string& what) {
  const test::TemporaryFile file(extension, text);
  const int code = outcome(file.path(), text.size());
  EXPECT_NE(code, 256 + SIGALRM) << what << ": does not terminate";
  EXPECT_NE(code, kOutOfMemory) << what << ": needs too much memory";
  EXPECT_EQ(code, expected) << what;
}
void expectRead(std::string_view extension, const std::string& text, const std::string& what) {
  expectOutcome(0, extension, text, what);
}
void expectRefused(std::string_view extension, const std::string& text, const std::string& what) {
  expectOutcome(kRefused, extension, text, what);
}

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kFace = "f 1 2 3\n";

TEST(ReadLimits, EnforcesTheMemoryLimit) {
  if (!kLimited) GTEST_SKIP() << "the sanitizers reserve terabytes";
  // With a tenth of the file size the memory limit is too small.
  const std::string text = fill("v 0 0 0\n") + kFace;
  const test::TemporaryFile file(".obj", times(8, text));
  EXPECT_NE(outcome(file.path(), 0), 0);  // out of memory, or an error
}

TEST(ReadLimits, ObjOfSmallestStatements) {
  const std::string vertices = fill("v 0 0 0\n");
  expectRead(".obj", vertices + kFace, "vertices");
  expectRead(".obj", vertices.substr(0, 160'000) + fill(kFace), "faces");
  expectRefused(".obj", kPoints + fill(kFace), "faces of three vertices");
  expectRead(".obj", vertices.substr(0, 160'000) + "vn 0 0 1\n" + fill("f 1//1 1//1 1//1\n"), "corners with normals");
  expectRead(".obj", kPoints + kFace + fill("vn 0 0 0\n"), "normals");
  expectRead(".obj", kPoints + kFace + fill("vt 0\n"), "texture coordinates");
  expectRead(".obj", kPoints + kFace + fill("\n"), "empty lines");
  expectRead(".obj", kPoints + kFace + fill("\r\n"), "empty lines with CR");
  expectRead(".obj", kPoints + kFace + fill("g x\n"), "groups");
  expectRead(".obj", kPoints + kFace + fill("s 1\n"), "smoothing groups");
  expectRead(".obj", kPoints + kFace + fill("#\n"), "comments");
}

TEST(ReadLimits, ObjOfManyNames) {
  std::string parts = times(20'000, "v 0 0 0\n") + "usemtl " + std::string(255, 'm') + "\n";
  for (int i = 0; parts.size() < kBytes; ++i) parts += fmt::format("g {:x}\nf 1 2 3\n", i);
  expectRead(".obj", parts, "parts");
  std::string names = kPoints + kFace;
  for (int i = 0; names.size() < kBytes; ++i) names += fmt::format("g {:x}\n", i);
  expectRead(".obj", names, "groups without faces");
  std::string files = kPoints + kFace;
  for (int i = 0; files.size() < kBytes; ++i) files += fmt::format("mtllib {:x} {:x}\n", 2 * i, 2 * i + 1);
  expectRead(".obj", files, "material files");
}

TEST(ReadLimits, ObjOfLongLines) {
  expectRead(".obj", kPoints + "f 1 2 3 " + fill("\\\n") + "\n", "continued lines");
  expectRefused(".obj", kPoints + kFace + fill("\\\n"), "continued lines without an end");
  expectRead(".obj", kPoints + kFace + "#" + fill("x"), "a comment");
  expectRefused(".obj", kPoints + kFace + "g " + fill("x"), "a name");
  expectRead(".obj", kPoints + kFace + fill("x"), "a keyword");
  expectRead(".obj", kPoints + kFace + "f " + fill("1/"), "a corner");
  expectRead(".obj", kPoints + kFace + "v 0 0 0" + fill("0"), "a number of zeros");
  expectRead(".obj", kPoints + kFace + "v 0 0 1" + fill("0"), "a number");
  expectRead(".obj", kPoints + kFace + "v x\n" + fill("f 1 2 4\n"), "faces of an invalid vertex");
  expectRefused(".obj", kPoints + kFace + fill("f x\n"), "invalid faces");
  expectRefused(".obj", kPoints + kFace + fill("v x\n"), "invalid vertices");
  expectRead(".obj", kPoints + kFace + fill(" "), "blanks");
}

TEST(ReadLimits, OneFaceOfAllCorners) {
  // A convex polygon; a comb and a self-intersecting polygon, which may be too complex; three distinct positions only.
  std::string convex, comb, random, face = "f";
  std::uint32_t state = 1;
  const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 22u; };
  int count = 0;
  for (; convex.size() + face.size() < kBytes; ++count) {
    const double angle = 6.2831853071795862 * count / 90000;
    convex += fmt::format("v {:.7f} {:.7f} 0\n", std::cos(angle), std::sin(angle));
    comb += fmt::format("v {} {} 0\n", count, count % 2 == 0 ? 100 : 1);
    random += fmt::format("v {} {} 0\n", next(), next());
    face += fmt::format(" {}", count + 1);
  }
  expectRead(".obj", convex + face + "\n", "a convex face");
  for (const std::string& vertices : {comb, random}) {
    const test::TemporaryFile file(".obj", vertices + face + "\n");
    const int code = outcome(file.path(), kBytes);
    EXPECT_TRUE(code == 0 || code == kRefused) << code;
  }
  expectRefused(".obj", kPoints + "f" + fill(" 1 2 3") + "\n", "one face of three vertices");
}

TEST(ReadLimits, PlyTextOfSmallestItems) {
  const auto header = [](std::size_t vertices, std::size_t faces, const std::string& more = "") {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "{}\n"
        "property list uchar int vertex_indices\n{}end_header\n",
        vertices, faces, more);
  };
  const std::string data = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::size_t vertices = kBytes / 6;
  expectRead(".ply", header(vertices, 1) + times(vertices, "0 0 0\n") + "3 0 1 2\n", "vertices");
  const std::size_t faces = kBytes / 8;
  expectRead(".ply", header(20'000, faces) + times(20'000, "0 0 0\n") + times(faces, "3 0 1 2\n"), "faces");
  expectRead(".ply", header(3, 1) + fill("\n") + data, "empty lines");
  expectRead(".ply", header(3, 1, fill("comment\n")) + data, "comments");
  expectRead(".ply", header(3, 1, fill("element a 0\nproperty int b\n")) + data, "elements without data");
  expectRefused(".ply", header(3, 1, fill("property int a\n")) + data, "properties");
  expectRefused(".ply", header(3, 1, fill("element a 9\nproperty int b\n")) + data, "elements");
  expectRefused(".ply", header(3, 1, "comment " + fill("x")), "a header without an end");
  expectRefused(".ply", header(2'000'000'000, 1) + data, "a count");
}

TEST(ReadLimits, PlyBinaryOfSmallestItems) {
  const auto header = [](std::size_t vertices, const std::string& surface) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty char x\nproperty char y\nproperty char z\n{}"
        "end_header\n",
        vertices, surface);
  };
  const std::size_t vertices = kBytes / 3;
  const std::string face = "element face 1\nproperty list uchar uchar vertex_indices\n";
  expectRead(".ply", header(vertices, face) + std::string(3 * vertices, '\1') + std::string("\3\0\1\2", 4), "vertices");
  const std::string list = "property list uchar uchar vertex_indices\n";
  expectRefused(".ply",
                header(3, fmt::format("element face {}\n{}", kBytes / 4, list)) + std::string(9, '\1') +
                    fill(std::string("\3\0\1\2", 4)),
                "faces of three vertices");
  for (const std::size_t known : {std::size_t{3}, std::size_t{65536}}) {
    std::string strip = header(known, "element tristrips 1\nproperty list int ushort vertex_indices\n");
    for (std::size_t i = 0; i < 3 * known; ++i) strip += static_cast<char>(i % 127);
    test::putInteger(strip, kBytes / 2, 4);
    for (std::size_t i = 0; i < kBytes / 2; ++i) test::putInteger(strip, i % 3, 2);
    expectOutcome(known == 3 ? kRefused : 0, ".ply", strip, "a strip");
  }
}

TEST(ReadLimits, OffOfSmallestItems) {
  const std::size_t vertices = kBytes / 6, faces = kBytes / 8;
  expectRead(".off", fmt::format("OFF\n{} 1 0\n", vertices) + times(vertices, "0 0 0\n") + "3 0 1 2\n", "vertices");
  expectRead(".off", fmt::format("OFF\n20000 {} 0\n", faces) + times(20'000, "0 0 0\n") + times(faces, "3 0 1 2\n"),
             "faces");
  expectRead(".off", "OFF\n" + fill("#\n") + "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "comments");
  expectRefused(".off", "OFF\n300000 300000 0\n" + fill("\n"), "counts");
}

TEST(ReadLimits, StlOfSmallestItems) {
  const std::string facet = "facet normal\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  expectRead(".stl", "solid\n" + fill(facet) + "endsolid\n", "facets");
  expectRead(".stl", fill("solid\n" + facet + "endsolid\n"), "solids");
  expectRead(".stl", "solid\n" + facet + "endsolid\n" + fill("\n"), "empty lines");
  std::vector<std::array<float, 9>> triangles(kBytes / 50);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 9; ++k) triangles[i][k] = static_cast<float>((i * 9 + k) * 7919 % 100003);
  expectRead(".stl", test::binaryStl(triangles), "binary facets, all corners different");
}

}  // namespace
}  // namespace malus::prep

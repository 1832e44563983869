// Counts far above a file's size, with matching hashes, never make the reader allocate more than the file's bound.
//
// The bound: kFixedBytes for tables of Draco whose size does not depend on the file, and kPerByte for every byte of it.
// A byte of Draco data may encode 64 triangles and 64 vertices (compress::kMaxPerByte), and decoding takes at most
// 300 bytes per pair; records of other sections need less. A separate program, because it replaces operator new.
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include <glm/geometric.hpp>

#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"
#include "tests/bake/pack/raw_pack.h"

namespace {

std::atomic<std::size_t> gLive{0}, gPeak{0}, gRefusedAbove{SIZE_MAX};

void* allocate(std::size_t size) {
  if (size > gRefusedAbove) throw std::bad_alloc();
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t live = gLive += ::malloc_usable_size(memory);
  std::size_t peak = gPeak;
  while (live > peak && !gPeak.compare_exchange_weak(peak, live)) {
  }
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) gLive -= ::malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

namespace malus::pack {
namespace {

using bake::test::contains;
using test::Bytes;
using test::RawSection;

constexpr std::size_t kFixedBytes = std::size_t{16} << 20;
constexpr std::size_t kPerByte = 64 * 300;

struct Outcome {
  std::string error;
  std::size_t allocated = 0;  // peak bytes above those allocated before
};

Outcome tryParse(const Bytes& bytes) {
  Outcome outcome;
  const std::size_t before = gLive;
  gPeak = before;
  outcome.error = bake::test::errorMessage([&] { parse(bytes, "file.pack"); });
  outcome.allocated = gPeak - before;
  return outcome;
}

std::size_t memoryBound(const Bytes& bytes) { return kFixedBytes + kPerByte * bytes.size(); }

// Parses a pack whose sections were changed; an error is expected.
template <class Change>
void expectRefused(const Scene& scene, std::string_view what, Change change) {
  WriteSettings settings;
  settings.keepMap = true;
  std::vector<RawSection> sections = test::takenApart(serialize(scene, settings).bytes);
  change(sections);
  const Bytes bytes = test::putTogether(sections);
  const Outcome outcome = tryParse(bytes);
  EXPECT_TRUE(contains(outcome.error, "file.pack")) << what << ": " << outcome.error;
  EXPECT_LE(outcome.allocated, memoryBound(bytes)) << what << ", " << bytes.size() << " bytes";
  // The other claims are rejected before anything but names and messages is allocated.
  if (!contains(outcome.error, "Draco data is corrupt")) {
    EXPECT_LE(outcome.allocated, 64 * bytes.size()) << what << ", " << bytes.size() << " bytes";
  }
}

template <class T>
void expectRefused(const Scene& scene, std::string_view id, std::size_t at, T value) {
  expectRefused(scene, fmt::format("{} at {} of {}", value, at, id), [&](std::vector<RawSection>& sections) {
    test::setNumber(test::section(sections, id).bytes, at, value);
  });
}

constexpr std::uint32_t kHuge[] = {0x00100000u, 0x0fffffffu, 0x10000000u, 0x7fffffffu, 0xffffffffu};

TEST(PackMemory, CountingWorks) {
  const std::size_t before = gLive;
  gPeak = before;
  { const std::vector<char> megabyte(1 << 20); }
  EXPECT_GE(gPeak - before, std::size_t{1} << 20);
  EXPECT_EQ(gLive, before);
}

TEST(PackMemory, ValidPacksAreWithinTheBound) {
  for (const Scene& scene : {bake::test::smallScene(), bake::test::unusualScene()}) {
    const Bytes bytes = serialize(scene, {}).bytes;
    const Outcome outcome = tryParse(bytes);
    EXPECT_EQ(outcome.error, "");
    EXPECT_LE(outcome.allocated, memoryBound(bytes));
  }
}

TEST(PackMemory, CountsOfEverySection) {
  const Scene scene = bake::test::unusualScene();
  for (const std::uint32_t count : kHuge)
    for (const char* id : {"LGHT", "MATL", "SRFX", "TEXR", "MESH", "EFCT"}) expectRefused(scene, id, 0, count);
  for (const std::uint32_t count : kHuge) expectRefused(scene, "ENCD", 0, count);
}

TEST(PackMemory, LengthsOfTexts) {
  const Scene scene = bake::test::unusualScene();
  for (const std::uint32_t length : {65'536u, 0x00ffffffu, 0xffffffffu}) {
    for (const char* id : {"MATL", "TEXR", "MESH", "EFCT"}) expectRefused(scene, id, 4, length);
    for (const char* id : {"META", "PROV"}) expectRefused(scene, id, 0, length);
    expectRefused(scene, "ENCD", 4 + 60, length);
  }
  expectRefused(scene, "PROV", 0, std::uint32_t{1} << 24);
}

TEST(PackMemory, TexelsOfTexturesAndOfTheSky) {
  const Scene scene = bake::test::unusualScene();
  constexpr std::size_t kWidth = 4 + 4 + 11;  // after the first texture's name
  for (const std::uint32_t side : {8192u, 0xffffffffu}) {
    expectRefused(scene, "TEXR", kWidth, side);
    expectRefused(scene, "TEXR", kWidth + 4, side);
    expectRefused(scene, "ENVR", 248, side);
  }
  expectRefused(scene, "largest texture", [](std::vector<RawSection>& s) {
    test::setNumber(test::section(s, "TEXR").bytes, kWidth, 8192u);
    test::setNumber(test::section(s, "TEXR").bytes, kWidth + 4, 8192u);
  });
}

// Offset of the counts of the first mesh of the small scene.
constexpr std::size_t kVertices = 4 + 4 + 11 + 4 + 4;

TEST(PackMemory, CountsOfAMeshInItsTable) {
  for (const std::uint32_t count : kHuge) {
    expectRefused(bake::test::smallScene(), "MESH", kVertices, count);
    expectRefused(bake::test::smallScene(), "MESH", kVertices + 4, count);
  }
}

// Draco data of the first mesh replaced by a head that claims counts, then a few bytes; the table claims the same.
Bytes dracoClaim(bool edgebreaker, std::uint32_t vertices, std::uint32_t triangles, std::size_t padding) {
  Bytes draco;
  const auto put = [&](std::initializer_list<unsigned> values) {
    for (const unsigned value : values) draco.push_back(static_cast<std::byte>(value));
  };
  const auto number = [&](std::uint32_t value) {
    for (; value >= 0x80; value >>= 7) put({(value & 0x7f) | 0x80});
    put({value});
  };
  for (const char c : std::string_view("DRACO")) put({static_cast<unsigned char>(c)});
  put({2, 2, 1, edgebreaker ? 1u : 0u, 0, 0});
  if (edgebreaker) {
    put({0});  // the standard traversal
    number(vertices);
    number(triangles);
    put({0});
    number(triangles);  // symbols
    number(0);          // split symbols
  } else {
    number(triangles);
    number(vertices);
    put({1});  // uncompressed indices
  }
  draco.resize(draco.size() + padding, std::byte{0});

  std::vector<RawSection> sections = test::takenApart(serialize(bake::test::smallScene(), {}).bytes);
  Bytes& table = test::section(sections, "MESH").bytes;
  test::setNumber(table, 0, std::uint32_t{1});
  table.resize(kVertices + 28 + 56);
  test::setNumber(table, kVertices - 4, std::uint32_t{0});
  test::setNumber(table, kVertices, vertices);
  test::setNumber(table, kVertices + 4, triangles);
  test::setNumber(table, kVertices + 8, std::uint32_t{edgebreaker});
  test::setNumber(table, kVertices + 12, std::uint64_t{0});
  test::setNumber(table, kVertices + 20, std::uint64_t{draco.size()});
  test::section(sections, "GEOM").bytes = draco;
  return test::putTogether(sections);
}

TEST(PackMemory, CountsThatDracoClaims) {
  for (const bool edgebreaker : {false, true})
    for (const std::size_t padding : {std::size_t{0}, std::size_t{40}, std::size_t{4000}, std::size_t{100'000}})
      for (const std::uint32_t count : {std::uint32_t(padding), std::uint32_t(63 * padding), 1u << 20, 1u << 28})
        for (const auto& [vertices, triangles] : {std::pair{count, count}, {3u, count}, {count, 1u}}) {
          if (vertices == 0) continue;
          const Bytes bytes = dracoClaim(edgebreaker, vertices, triangles, padding);
          const Outcome outcome = tryParse(bytes);
          EXPECT_LE(outcome.allocated, memoryBound(bytes))
              << (edgebreaker ? "edgebreaker, " : "sequential, ") << vertices << " vertices, " << triangles
              << " triangles, " << bytes.size() << " bytes: " << outcome.error;
          if (std::max(vertices, triangles) > 64 * (padding + 30)) {
            EXPECT_TRUE(contains(outcome.error, "Draco", "small")) << outcome.error;
            EXPECT_LE(outcome.allocated, 64 * bytes.size()) << outcome.error;
          }
        }
}

// The bound also holds for the most compressible valid mesh, an even grid, whose triangles need almost no bytes.
TEST(PackMemory, DenseMeshIsWithinTheBound) {
  Scene scene = bake::test::smallScene();
  Mesh mesh;
  constexpr std::uint32_t kSide = 200;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i)
    mesh.positions.emplace_back(static_cast<float>(i / kSide), static_cast<float>(i % kSide), 0.0f);
  for (std::uint32_t i = 0; i + 1 < kSide; ++i)
    for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
      const std::uint32_t a = i * kSide + j;
      mesh.triangles.emplace_back(a, a + 1, a + kSide + 1);
      mesh.triangles.emplace_back(a, a + kSide + 1, a + kSide);
    }
  mesh.name = "grid";
  scene.meshes = {mesh};
  const Written written = serialize(scene, {});
  EXPECT_EQ(written.meshes[0].method, "edgebreaker");
  const Outcome outcome = tryParse(written.bytes);
  EXPECT_EQ(outcome.error, "");
  // 300 bytes per triangle and vertex, see the top of the file.
  EXPECT_LE(outcome.allocated, kFixedBytes + 300 * mesh.triangles.size());
  EXPECT_GT(outcome.allocated, 24 * mesh.triangles.size());
}

// Running out of memory is an error, not a crash.
TEST(PackMemory, RunningOutIsAnError) {
  const Bytes bytes = dracoClaim(true, 1u << 20, 1u << 20, 20'000);
  gRefusedAbove = 1 << 16;
  const Outcome outcome = tryParse(bytes);
  gRefusedAbove = SIZE_MAX;
  EXPECT_TRUE(contains(outcome.error, "file.pack")) << outcome.error;
}

}  // namespace
}  // namespace malus::pack

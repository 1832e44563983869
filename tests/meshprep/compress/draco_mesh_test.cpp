#include "meshprep/compress/draco_mesh.h"

#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include <draco/compression/decode.h>
#include <gtest/gtest.h>

#include "meshprep/normals/crease_normals.h"
#include "tests/meshprep/compress/round_trip.h"
#include "tests/meshprep/shapes.h"

namespace malus::compress {
namespace {

using prep::test::contains;
using prep::test::errorMessage;
using test::roundTrip;
using test::RoundTrip;

TriangleMesh fromMesh(const prep::Mesh& mesh) {
  TriangleMesh result;
  result.positions = mesh.positions;
  result.normals = mesh.normals;
  result.triangles = mesh.triangles;
  return result;
}

TriangleMesh withNormals(prep::Mesh mesh, double creaseDegrees = 40) {
  prep::addCreaseNormals(mesh, creaseDegrees);
  return fromMesh(mesh);
}

Limits counts(const TriangleMesh& mesh) {
  return {static_cast<std::uint32_t>(mesh.positions.size()), static_cast<std::uint32_t>(mesh.triangles.size())};
}

Settings settingsFor(const TriangleMesh& mesh, int positionBits = 20) {
  Settings settings;
  settings.grid = gridFor(mesh.positions, positionBits);
  return settings;
}

// Expects a vertex of `source` within the tolerance of each vertex of `decoded`, and vice versa.
void expectSamePositions(const TriangleMesh& source, const TriangleMesh& decoded, double tolerance) {
  for (const auto& [from, to] : {std::pair{&source, &decoded}, std::pair{&decoded, &source}})
    for (const glm::dvec3& p : from->positions)
      EXPECT_TRUE(std::any_of(to->positions.begin(), to->positions.end(), [&, &position = p](const glm::dvec3& q) {
        return glm::distance(position, q) <= tolerance;
      }));
}

TEST(DracoMesh, EncodesASphereByEdgebreaker) {
  const TriangleMesh mesh = withNormals(prep::test::sphere(31, 64));
  const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh));
  EXPECT_EQ(encoded.method, "edgebreaker");
  EXPECT_GT(encoded.deviation.positionMax, 0);
  EXPECT_LT(encoded.deviation.positionMax, 3e-6f);
  EXPECT_GT(encoded.deviation.normalMaxDegrees, 0);
  EXPECT_LT(encoded.deviation.normalMaxDegrees, 0.06f);
  expectSamePositions(mesh, encoded.decoded, encoded.deviation.positionMax * 1.001);
  const Limits claimed = declaredCounts(encoded.bytes, "x");
  EXPECT_EQ(claimed.vertices, counts(mesh).vertices);
  EXPECT_EQ(claimed.triangles, counts(mesh).triangles);
}

TEST(DracoMesh, WritesFilesThatDracoReads) {
  prep::Mesh loose = prep::test::sphere(15, 32);
  loose.positions.emplace_back(0, 0, 0);
  for (const prep::Mesh& m : {prep::test::sphere(15, 32), loose}) {
    const TriangleMesh mesh = fromMesh(m);
    const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh));
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(encoded.bytes.data()), encoded.bytes.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    ASSERT_TRUE(result.ok()) << result.status().error_msg_string();
    EXPECT_EQ(result.value()->num_points(), mesh.positions.size());
    EXPECT_EQ(result.value()->num_faces(), mesh.triangles.size());
    EXPECT_EQ(buffer.remaining_size(), 0);
  }
}

TEST(DracoMesh, KeepsOrientationAndVolume) {
  const TriangleMesh mesh = fromMesh(prep::test::sphere(31, 64));
  const auto volume = [](const TriangleMesh& m) {
    double sum = 0;
    for (const glm::uvec3& t : m.triangles)
      sum += glm::dot(glm::dvec3(m.positions[t.x]),
                      glm::cross(glm::dvec3(m.positions[t.y]), glm::dvec3(m.positions[t.z]))) /
             6;
    return sum;
  };
  EXPECT_NEAR(volume(roundTrip(mesh, settingsFor(mesh)).decoded), volume(mesh), 1e-4);
  EXPECT_GT(volume(mesh), 4.1);
}

TEST(DracoMesh, EncodesOpenAndDisconnectedMeshes) {
  prep::Mesh open = prep::test::sphere(15, 32);
  open.triangles.resize(open.triangles.size() - 200);
  std::vector<bool> used(open.positions.size());
  for (const prep::Mesh& m :
       {prep::test::cube(), open, prep::test::joined(prep::test::sphere(7, 9), prep::test::cube(1, {5, 5, 5}))}) {
    const TriangleMesh mesh = withNormals(m);
    const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh));
    EXPECT_EQ(encoded.decoded.positions.size(), mesh.positions.size());
    EXPECT_EQ(encoded.decoded.triangles.size(), mesh.triangles.size());
  }
}

TEST(DracoMesh, IsDeterministic) {
  const TriangleMesh mesh = withNormals(prep::test::sphere(15, 32));
  EXPECT_EQ(encode(mesh, settingsFor(mesh)).bytes, encode(mesh, settingsFor(mesh)).bytes);
}

TEST(DracoMesh, DecodesEqualPositionsEquallyInAllMeshes) {
  // Two halves of a sphere on one grid, one with normals: the vertices of their common rim must stay equal.
  const prep::Mesh whole = prep::test::sphere(16, 24);
  std::map<std::vector<float>, int> rim;
  prep::Mesh halves[2];
  for (prep::Mesh& half : halves) half.positions = whole.positions;
  for (const glm::uvec3& t : whole.triangles) {
    const double x = whole.positions[t.x].x + whole.positions[t.y].x + whole.positions[t.z].x;
    halves[x > 0.4 ? 1 : 0].triangles.push_back(t);
  }
  Settings settings;
  settings.grid = {glm::dvec3(-2), 0x1p-15, 18};
  std::map<std::size_t, glm::dvec3> decodedAt[2];
  for (int h = 0; h < 2; ++h) {
    // Unreferenced vertices force the sequential encoding, which keeps the order that this test needs.
    TriangleMesh mesh = fromMesh(halves[h]);
    if (h == 1) mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
    const RoundTrip encoded = roundTrip(mesh, settings);
    EXPECT_EQ(encoded.method, "sequential");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) decodedAt[h][i] = encoded.decoded.positions[i];
  }
  EXPECT_EQ(decodedAt[0], decodedAt[1]);

  // Edgebreaker decodes to the same values.
  const TriangleMesh mesh = fromMesh(whole);
  const RoundTrip encoded = roundTrip(mesh, settings);
  EXPECT_EQ(encoded.method, "edgebreaker");
  for (const glm::dvec3& p : encoded.decoded.positions)
    EXPECT_TRUE(std::any_of(decodedAt[0].begin(), decodedAt[0].end(), [&](const auto& q) { return q.second == p; }));
}

TEST(DracoMesh, FallsBackToSequential) {
  // Many triangles around one edge, so that edgebreaker is smaller, but changes the connectivity.
  prep::Mesh fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 64; ++i) {
    fan.positions.emplace_back(std::cos(i * 0.1), std::sin(i * 0.1), 0.5);
    fan.triangles.emplace_back(0, 1, i + 2);
  }
  prep::Mesh degenerate = prep::test::sphere(15, 32);
  degenerate.triangles.emplace_back(3, 3, 4);
  prep::Mesh loose = prep::test::sphere(15, 32);
  loose.positions.emplace_back(0, 0, 0);
  for (const prep::Mesh& m : {fan, degenerate, loose}) {
    const TriangleMesh mesh = fromMesh(m);
    const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh));
    EXPECT_EQ(encoded.method, "sequential");
    EXPECT_EQ(encoded.decoded.triangles, mesh.triangles);
  }
}

TEST(DracoMesh, KeepsCountsOnCoarseGrids) {
  const TriangleMesh mesh = withNormals(prep::test::sphere(31, 64));
  for (const int bits : {1, 2, 4, 8, 11, 16, 22, 26, 30}) {
    const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh, bits));
    EXPECT_EQ(encoded.decoded.triangles.size(), mesh.triangles.size()) << bits;
    EXPECT_EQ(encoded.decoded.positions.size(), mesh.positions.size()) << bits;
  }
}

TEST(DracoMesh, ReducesNormalErrorsByMoreBits) {
  const TriangleMesh mesh = withNormals(prep::test::sphere(31, 64));
  double last = 180;
  for (const int bits : {4, 8, 10, 12, 14}) {
    Settings settings = settingsFor(mesh);
    settings.normalBits = bits;
    const RoundTrip encoded = roundTrip(mesh, settings);
    EXPECT_LT(encoded.deviation.normalMaxDegrees, last);
    last = encoded.deviation.normalMaxDegrees;
    for (const glm::vec3& n : encoded.decoded.normals) EXPECT_NEAR(glm::length(n), 1, 1e-6);
  }
}

TEST(DracoMesh, FitsAGrid) {
  const std::vector<glm::dvec3> point = {glm::dvec3(3)};
  EXPECT_EQ(gridFor(point, 20).origin, glm::dvec3(3));
  // The step of a grid far from zero is that of its size.
  const TriangleMesh far = fromMesh(prep::test::cube(0.5, {1e6, 1e6, -1e6}));
  EXPECT_LT(encode(far, settingsFor(far, 26)).deviation.positionMax, 3e-8);
  const auto refused = [](const std::vector<glm::dvec3>& positions) {
    return errorMessage([&] { gridFor(positions, 20); });
  };
  EXPECT_FALSE(refused({glm::dvec3(std::numeric_limits<double>::infinity())}).empty());
  EXPECT_TRUE(contains(refused({glm::dvec3(-3e40), glm::dvec3(3e40)}), "too large"));
  EXPECT_TRUE(contains(refused({glm::dvec3(0), glm::dvec3(1e-60)}), "too small"));
  EXPECT_TRUE(contains(refused({glm::dvec3(1e12), glm::dvec3(1e12 + 1)}), "too far"));
}

TEST(DracoMesh, AcceptsTheWholeRangeOfSizes) {
  for (const double size : {4 * kMinExtent, 1e-30, 1e-6, 1e6, 1e30, 0.5 * kMaxExtent})
    for (const double distance : {0.0, 1.0, 1e6, 0.4 * kMaxDistance}) {
      const TriangleMesh mesh = fromMesh(prep::test::cube(0.5 * size, glm::dvec3(distance * size)));
      const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh, 30));
      EXPECT_LE(encoded.deviation.positionMax, size * std::max(2e-9, distance * 1e-15)) << size << " " << distance;
      EXPECT_EQ(encoded.deviation.newDegenerate, 0u) << size << " " << distance;
    }
}

TEST(DracoMesh, RefusesInvalidInput) {
  const TriangleMesh good = withNormals(prep::test::cube());
  const Settings settings = settingsFor(good);
  const auto refused = [&](auto change) {
    TriangleMesh mesh = good;
    Settings changed = settings;
    change(mesh, changed);
    return errorMessage([&] { encode(mesh, changed); });
  };
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.positions[3].y = std::numeric_limits<double>::quiet_NaN(); }),
                       "not finite"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.positions[3].y = 2.5; }), "outside of the grid"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.positions[3].y = -0.5; }), "outside of the grid"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.normals[2] = glm::vec3(0); }), "unit length"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.normals.pop_back(); }), "number of normals"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.triangles[1].z = 24; }), "invalid vertex index"));
  EXPECT_TRUE(contains(refused([](auto& m, auto&) { m.triangles.clear(); }), "empty"));
  EXPECT_TRUE(contains(refused([](auto&, auto& s) { s.grid.positionBits = 0; }), "1 to 30"));
  EXPECT_TRUE(contains(refused([](auto&, auto& s) { s.normalBits = 31; }), "2 to 16"));
  EXPECT_TRUE(contains(refused([](auto&, auto& s) { s.grid.step = 0; }), "grid"));
  EXPECT_TRUE(contains(refused([](auto&, auto& s) { s.grid.step *= 1.5; }), "power of two"));
  EXPECT_TRUE(contains(refused([](auto&, auto& s) { s.grid.origin.x += 0.3 * s.grid.step; }), "origin"));
}

TEST(DracoMesh, RefusesUnexpectedCounts) {
  const TriangleMesh mesh = withNormals(prep::test::cube());
  const RoundTrip encoded = roundTrip(mesh, settingsFor(mesh));
  EXPECT_TRUE(contains(errorMessage([&] {
                         decode(encoded.bytes, {23, 12}, settingsFor(mesh).grid, "a.drc");
                       }),
                       "a.drc: Draco data has unexpected counts"));
  EXPECT_FALSE(errorMessage([&] { decode(encoded.bytes, {24, 13}, settingsFor(mesh).grid, "x"); }).empty());
}

// Limits the memory of this process within a scope. Disabled under the address sanitizer, which maps terabytes.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t bytes) {
#if !defined(__SANITIZE_ADDRESS__)
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = std::min(bytes, before_.rlim_max);
    setrlimit(RLIMIT_AS, &limit);
#else
    static_cast<void>(bytes);
#endif
  }
  ~MemoryLimit() {
#if !defined(__SANITIZE_ADDRESS__)
    setrlimit(RLIMIT_AS, &before_);
#endif
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  [[maybe_unused]] rlimit before_{};
};

// Decodes arbitrary bytes, and expects an error or a valid mesh with these counts.
void expectErrorOrMesh(const std::vector<std::byte>& bytes, const Limits& limits) {
  try {
    const TriangleMesh mesh = decode(bytes, limits, Grid{glm::dvec3(-1), 0x1p-19, kMaxPositionBits}, "damaged");
    ASSERT_EQ(mesh.positions.size(), limits.vertices);
    ASSERT_EQ(mesh.triangles.size(), limits.triangles);
    for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), limits.vertices);
    for (const glm::dvec3& p : mesh.positions)
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
  } catch (const Error& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("damaged")) << error.what();
  }
}

// Returns meshes of both encodings, with and without normals.
std::vector<RoundTrip> samples() {
  std::vector<RoundTrip> result;
  prep::Mesh loose = prep::test::sphere(3, 5);
  loose.positions.emplace_back(0, 0, 0);
  for (const prep::Mesh& m : {prep::test::sphere(3, 5), loose}) {
    TriangleMesh mesh = fromMesh(m);
    result.push_back(roundTrip(mesh, settingsFor(mesh)));
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0.6f, 0.8f));
    result.push_back(roundTrip(mesh, settingsFor(mesh)));
  }
  return result;
}

TEST(DracoMesh, SurvivesEveryFlippedBit) {
  const MemoryLimit limit(rlim_t{4} << 30);
  for (const RoundTrip& sample : samples()) {
    for (std::size_t bit = 0; bit < 8 * sample.bytes.size(); ++bit) {
      std::vector<std::byte> flipped = sample.bytes;
      flipped[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
      expectErrorOrMesh(flipped, counts(sample.decoded));
    }
  }
}

TEST(DracoMesh, SurvivesChangedBytes) {
  const MemoryLimit limit(rlim_t{4} << 30);
  for (const RoundTrip& sample : samples()) {
    for (std::size_t i = 0; i < sample.bytes.size(); ++i)
      for (const unsigned value : {0x00u, 0x01u, 0x7fu, 0x80u, 0xffu}) {
        std::vector<std::byte> changed = sample.bytes;
        changed[i] = static_cast<std::byte>(value);
        expectErrorOrMesh(changed, counts(sample.decoded));
        if (i + 4 > changed.size()) continue;
        std::fill_n(changed.begin() + static_cast<std::ptrdiff_t>(i), 4, static_cast<std::byte>(value));
        expectErrorOrMesh(changed, counts(sample.decoded));
      }
  }
}

TEST(DracoMesh, SurvivesTruncation) {
  const MemoryLimit limit(rlim_t{4} << 30);
  for (const RoundTrip& sample : samples())
    for (std::size_t size = 0; size < sample.bytes.size(); ++size)
      expectErrorOrMesh({sample.bytes.begin(), sample.bytes.begin() + static_cast<std::ptrdiff_t>(size)},
                        counts(sample.decoded));
}

TEST(DracoMesh, RefusesHugeCountsWithoutAllocation) {
  // Sequential header with 2^31 points, and edgebreaker header with 2^32 - 1 split symbols.
  const auto bytes = [](std::initializer_list<unsigned> values) {
    std::vector<std::byte> result;
    for (const char c : std::string_view("DRACO")) result.push_back(static_cast<std::byte>(c));
    for (const unsigned value : values) result.push_back(static_cast<std::byte>(value));
    return result;
  };
  const MemoryLimit limit(rlim_t{4} << 30);
  EXPECT_TRUE(contains(errorMessage([&] {
                         decode(bytes({2, 2, 1, 0, 0, 0, 1, 0x80, 0x80, 0x80, 0x80, 8, 1}), {3, 1}, Grid{}, "x");
                       }),
                       "2147483648"));
  EXPECT_TRUE(
      contains(errorMessage([&] {
                 decode(bytes({2, 2, 1, 1, 0, 0, 0, 3, 1, 0, 1, 0xff, 0xff, 0xff, 0xff, 15}), {3, 1}, Grid{}, "x");
               }),
               "split symbols"));
  EXPECT_TRUE(contains(errorMessage([&] {
                         decode(bytes({2, 2, 1, 0, 0, 0, 1, 0xff, 0xff, 0xff, 0xff, 0xff, 1}), {3, 1}, Grid{}, "x");
                       }),
                       "32 bits"));
  EXPECT_TRUE(contains(errorMessage([&] { decode(bytes({2, 1, 1, 0, 0, 0, 1, 3}), {3, 1}, Grid{}, "x"); }), "version"));
  EXPECT_TRUE(contains(errorMessage([&] {
                         decode(bytes({2, 2, 0, 0, 0, 0, 1, 3}), {3, 1}, Grid{}, "x");
                       }),
                       "not a mesh"));
  EXPECT_TRUE(contains(errorMessage([&] {
                         decode(bytes({2, 2, 1, 0, 0, 0x80, 1, 3}), {3, 1}, Grid{}, "x");
                       }),
                       "metadata"));
  EXPECT_TRUE(contains(errorMessage([&] { decode({}, {3, 1}, Grid{}, "x"); }), "truncated"));
  EXPECT_TRUE(contains(errorMessage([&] { declaredCounts(bytes({2}), "x"); }), "truncated"));
}

}  // namespace
}  // namespace malus::compress

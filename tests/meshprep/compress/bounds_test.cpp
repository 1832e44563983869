// Choice of bits, and the map from the encoded mesh to its source.
#include "meshprep/compress/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/compress/deviation.h"
#include "meshprep/compress/draco_read.h"
#include "meshprep/compress/draco_write.h"
#include "meshprep/compress/grid_rounding.h"
#include "meshprep/compress/reordering.h"
#include "meshprep/compress/rounding.h"
#include "meshprep/normals/crease_normals.h"
#include "tests/meshprep/compress/round_trip.h"
#include "tests/meshprep/shapes.h"

namespace malus::compress {
namespace {

using prep::test::contains;
using prep::test::errorMessage;
using test::roundTrip;
using test::RoundTrip;

TriangleMesh makeMesh(prep::Mesh source, bool normals = true) {
  if (normals) prep::addCreaseNormals(source, 40);
  TriangleMesh mesh;
  mesh.positions = source.positions;
  mesh.normals = source.normals;
  mesh.triangles = source.triangles;
  return mesh;
}

// One slanted triangle of about the given height over a base of 1, between the points of the grid.
TriangleMesh sliver(double height) {
  TriangleMesh mesh;
  mesh.positions = {{0.1234567, 0.2345678, 0.3456789},
                    {1.1234567, 0.2345678, 0.3456789},
                    {0.6234567, 0.2345678 + height, 0.3456789 + 0.7 * height}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Settings settingsFor(const TriangleMesh& mesh, const Bounds& bounds) {
  const MeshView view = mesh;
  const RoundedMesh rounded = roundMeshes({&view, 1}, bounds, Precision::doubles).front();
  return {rounded.grid, rounded.normalBits};
}

// The settings with a grid of half the resolution.
Settings coarser(const TriangleMesh& mesh, Settings settings) {
  settings.grid = gridWithStep(roundPositions(mesh.positions, 2 * settings.grid.step), 2 * settings.grid.step);
  return settings;
}

TEST(Bounds, RaisesNormalBitsToTheDefaultBound) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(63, 128));
  const Settings settings = settingsFor(mesh, {});
  EXPECT_EQ(settings.grid.positionBits, kFirstPositionBits);
  const Encoded encoded = encode(mesh, settings);
  EXPECT_LE(encoded.deviation.normalMaxDegrees, kDefaultNormalErrorDegrees);
  EXPECT_LE(encoded.deviation.tiltMaxDegrees, kDefaultTiltDegrees);
  EXPECT_TRUE(checkBounds(encoded.deviation, settings, {}, true, "sphere").empty());
  // One bit less is too few, unless it is the first number to try.
  Settings fewer = settings;
  if (--fewer.normalBits >= kFirstNormalBits) {
    EXPECT_GT(encode(mesh, fewer).deviation.normalMaxDegrees, kDefaultNormalErrorDegrees);
  }
  EXPECT_GT(settings.normalBits, kFirstNormalBits);  // 12 bits reach 0.058 degrees on a sphere
}

TEST(Bounds, ChoosesTheSmallestNumberWithinAGivenBound) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(31, 64));
  for (const double error : {1e-4, 1e-5, 1e-6}) {
    Bounds bounds;
    bounds.positionError = error;
    const Settings settings = settingsFor(mesh, bounds);
    EXPECT_LE(encode(mesh, settings).deviation.positionMax, error);
    const Deviation worse = encode(mesh, coarser(mesh, settings)).deviation;
    EXPECT_TRUE(worse.positionMax > error || worse.tiltMaxDegrees > kDefaultTiltDegrees) << error;
  }
  for (const double error : {2.0, 0.2, 0.02}) {
    Bounds bounds;
    bounds.normalErrorDegrees = error;
    const Settings settings = settingsFor(mesh, bounds);
    EXPECT_LE(encode(mesh, settings).deviation.normalMaxDegrees, error);
    Settings fewer = settings;
    --fewer.normalBits;
    EXPECT_GT(encode(mesh, fewer).deviation.normalMaxDegrees, error);
  }
}

TEST(Bounds, ThrowsIfAGivenBoundIsOutOfReach) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(15, 32));
  Bounds bounds;
  bounds.positionError = 1e-12;
  Settings settings = settingsFor(mesh, bounds);
  EXPECT_EQ(settings.grid.positionBits, kMaxPositionBits);
  const auto message = [&] {
    return errorMessage([&] { checkBounds(encode(mesh, settings).deviation, settings, bounds, false, "mesh 'ball'"); });
  };
  EXPECT_TRUE(contains(message(), "mesh 'ball': position error")) << message();
  EXPECT_TRUE(contains(message(), "1e-12 m")) << message();
  EXPECT_TRUE(contains(message(), "30 bits")) << message();
  bounds = {};
  bounds.normalErrorDegrees = 1e-5;
  settings = settingsFor(mesh, bounds);
  EXPECT_EQ(settings.normalBits, kMaxNormalBits);
  EXPECT_TRUE(contains(message(), "normal error")) << message();
}

// Half a step along three axes, for every number of bits.
TEST(Bounds, HaveTheErrorOfTheStep) {
  TriangleMesh mesh;
  std::uint64_t state = 7;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11u) * 0x1p-53 * 10;
  };
  for (std::uint32_t i = 0; i < 900; ++i) mesh.positions.emplace_back(random(), random(), random());
  for (std::uint32_t i = 0; i < 300; ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  for (int bits = 20; bits <= kMaxPositionBits; ++bits) {
    Bounds bounds;
    bounds.positionBits = bits;
    const Settings settings = settingsFor(mesh, bounds);
    EXPECT_LE(settings.grid.step, 2 * 10 / std::ldexp(1.0, bits));
    const double error = encode(mesh, settings).deviation.positionMax;
    EXPECT_LE(error, 0.8661 * settings.grid.step) << bits;
    EXPECT_GT(error, 0.6 * settings.grid.step) << bits;
  }
}

TEST(Bounds, KeepsFacesFromLosingAreaAndFlipping) {
  // With 20 bits the three corners become collinear.
  TriangleMesh mesh = sliver(2e-7);
  const Settings coarse{gridFor(mesh.positions, 20), 12};
  Deviation lost = encode(mesh, coarse).deviation;
  EXPECT_EQ(lost.newDegenerate + lost.flipped, 1u);
  EXPECT_EQ(lost.faces, 1u);
  EXPECT_TRUE(contains(errorMessage([&] { checkBounds(lost, coarse, {}, false, "mesh 'sliver'"); }), "'sliver'"));
  lost.faces = 2;  // another face keeps its area
  lost.newDegenerate = 1;
  lost.flipped = 0;
  const std::vector<std::string> warnings = checkBounds(lost, coarse, {}, false, "mesh 'sliver'");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0], "'sliver'", "1 face")) << warnings[0];
  EXPECT_TRUE(contains(errorMessage([&] { checkBounds(lost, coarse, {}, true, "x"); }), "lose their area"));
  const Settings settings = settingsFor(mesh, {});
  EXPECT_GT(settings.grid.positionBits, 20);
  EXPECT_EQ(encode(mesh, settings).deviation.newDegenerate, 0u);
  // A face without area in the source is exempt.
  mesh.positions[2] = mesh.positions[0];
  EXPECT_EQ(settingsFor(mesh, {}).grid.positionBits, kFirstPositionBits);
  EXPECT_EQ(encode(mesh, settingsFor(mesh, {})).deviation.newDegenerate, 0u);
}

// Faces higher than 573 steps at the most bits keep their tilt; a lower one is counted, and refused for glass.
TEST(Bounds, KeepsTheTiltOfEveryFaceThatIsHighEnough) {
  constexpr double kStep = 0x1p-20;  // of 30 bits over 1000 m
  for (const bool high : {true, false}) {
    TriangleMesh mesh = sliver(0);
    for (glm::dvec3& p : mesh.positions) p = roundToStep(p, kStep);
    mesh.positions[2] += glm::dvec3(0, (high ? 600.4 : 20.4) * kStep, 0.3 * kStep);
    mesh.positions.insert(mesh.positions.end(), {{1000, 1000, 1000}, {1000, 1001, 1000}});
    mesh.triangles.push_back({0, 3, 4});
    const Settings settings = settingsFor(mesh, {});
    const Deviation deviation = encode(mesh, settings).deviation;
    EXPECT_EQ(deviation.flipped, 0u);
    EXPECT_EQ(deviation.tilted, high ? 0u : 1u);
    const auto warnings = checkBounds(deviation, settings, {}, false, "mesh 'm'");
    EXPECT_EQ(warnings.size(), high ? 0u : 1u);
    EXPECT_EQ(errorMessage([&] { checkBounds(deviation, settings, {}, true, "mesh 'm'"); }).empty(), high);
    if (high) continue;
    EXPECT_EQ(settings.grid.positionBits, kMaxPositionBits);
    EXPECT_NEAR(deviation.tiltedArea, 0.5 * 20.4 * kStep, 1e-7);
    EXPECT_TRUE(contains(warnings[0], "face 0")) << warnings[0];
  }
}

TEST(Bounds, UsesGivenNumbersOfBits) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(31, 64));
  Bounds bounds;
  bounds.positionBits = 9;
  bounds.normalBits = 7;
  const Settings settings = settingsFor(mesh, bounds);
  EXPECT_EQ(settings.grid.positionBits, 9);
  EXPECT_EQ(settings.normalBits, 7);
  const auto warnings = checkBounds(encode(mesh, settings).deviation, settings, bounds, false, "mesh 'ball'");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(contains(warnings[0], "'ball'", "normal error 1.")) << warnings[0];
  EXPECT_TRUE(contains(warnings[1], "tilt")) << warnings[1];
  bounds.positionBits = 31;
  EXPECT_TRUE(contains(errorMessage([&] { settingsFor(mesh, bounds); }), "1 to 30"));
  bounds = {};
  bounds.positionError = 0;
  EXPECT_TRUE(contains(errorMessage([&] { settingsFor(mesh, bounds); }), "position error"));
}

TEST(Deviation, MeasuresAKnownMove) {
  TriangleMesh source;
  source.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  source.triangles = {{0, 1, 2}};
  source.normals.assign(3, {0, 0, 1});
  std::vector<glm::dvec3> positions = source.positions;
  std::vector<glm::vec3> normals = source.normals;
  EXPECT_EQ(measureDeviation(source, positions, normals).tiltMaxDegrees, 0);
  positions[2].z += 1;  // tilts the face by 45 degrees
  normals[1] = {0, 0.6f, 0.8f};
  const Deviation moved = measureDeviation(source, positions, normals);
  EXPECT_NEAR(moved.positionMax, 1, 1e-6);
  EXPECT_NEAR(moved.tiltMaxDegrees, 45, 1e-4);
  EXPECT_NEAR(moved.normalMaxDegrees, std::asin(0.6) * 180 / std::numbers::pi, 1e-4);
  EXPECT_EQ(moved.flipped, 0u);
  EXPECT_EQ(moved.tilted, 1u);
  EXPECT_NEAR(moved.tiltedArea, 0.5, 1e-9);
  positions = source.positions;
  positions[2].y -= 2;
  EXPECT_EQ(measureDeviation(source, positions, normals).flipped, 1u);
  EXPECT_NEAR(measureDeviation(source, positions, normals).tiltMaxDegrees, 180, 1e-9);
  positions[2].y += 1;
  EXPECT_EQ(measureDeviation(source, positions, normals).newDegenerate, 1u);
  EXPECT_NEAR(measureDeviation(source, positions, normals).degenerateArea, 0.5, 1e-9);
  // A face whose normal floats cannot compute has lost its area.
  EXPECT_EQ(measureDeviation(source, source.positions, normals, 1.1).newDegenerate, 1u);
  EXPECT_EQ(measureDeviation(source, source.positions, normals, 0.9).newDegenerate, 0u);
}

TEST(GridRounding, PredictsDecodedValues) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(15, 32));
  for (const int bits : {3, 12, 20, 24, 30}) {
    Settings settings{gridFor(mesh.positions, bits), std::min(bits, 16)};
    const RoundTrip encoded = roundTrip(mesh, settings);
    const std::vector<glm::dvec3> positions = roundPositions(mesh.positions, settings.grid.step);
    const std::vector<glm::vec3> normals = roundNormals(mesh.normals, settings.normalBits);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      EXPECT_EQ(encoded.decoded.positions[i], positions[encoded.sourceVertices[i]]) << bits;
      EXPECT_EQ(encoded.decoded.normals[i], normals[encoded.sourceVertices[i]]) << bits;
    }
  }
}

// Expects a permutation under which every decoded triangle has the corners of its source.
void expectMap(const TriangleMesh& mesh, const RoundTrip& encoded) {
  std::vector<std::uint32_t> vertices = encoded.sourceVertices, triangles = encoded.sourceTriangles;
  ASSERT_EQ(vertices.size(), mesh.positions.size());
  ASSERT_EQ(triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const glm::uvec3 &t = encoded.decoded.triangles[i], &source = mesh.triangles[triangles[i]];
    const glm::uvec3 mapped(vertices[t.x], vertices[t.y], vertices[t.z]);
    EXPECT_TRUE(mapped == source || glm::uvec3(mapped.y, mapped.z, mapped.x) == source ||
                glm::uvec3(mapped.z, mapped.x, mapped.y) == source)
        << i;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    EXPECT_LE(glm::distance(encoded.decoded.positions[i], mesh.positions[vertices[i]]),
              encoded.deviation.positionMax * 1.001 + 1e-12);
  std::sort(vertices.begin(), vertices.end());
  std::sort(triangles.begin(), triangles.end());
  for (std::size_t i = 0; i < vertices.size(); ++i) EXPECT_EQ(vertices[i], i);
  for (std::size_t i = 0; i < triangles.size(); ++i) EXPECT_EQ(triangles[i], i);
}

TEST(SourceMap, IsAPermutation) {
  prep::Mesh open = prep::test::sphere(15, 32);
  open.triangles.erase(open.triangles.begin() + 100, open.triangles.begin() + 300);
  for (const bool normals : {false, true})
    for (const prep::Mesh& m : {prep::test::sphere(15, 32), prep::test::cube(), open,
                                prep::test::joined(prep::test::sphere(7, 9), prep::test::cube(1, {5, 5, 5})),
                                prep::test::joined(prep::test::cube(), prep::test::cube())}) {  // every position twice
      const TriangleMesh mesh = makeMesh(m, normals);
      const RoundTrip encoded = roundTrip(mesh, {gridFor(mesh.positions, 20), 12});
      EXPECT_EQ(encoded.sequentialReason.empty(), encoded.method == "edgebreaker");
      expectMap(mesh, encoded);
    }
  const TriangleMesh sphere = makeMesh(prep::test::sphere(15, 32));
  const RoundTrip encoded = roundTrip(sphere, {gridFor(sphere.positions, 20), 12});
  EXPECT_EQ(encoded.method, "edgebreaker");
  EXPECT_NE(encoded.decoded.triangles, sphere.triangles);  // the map is not the identity
}

TEST(SourceMap, CoversOpenSurfacesWithAndWithoutNormals) {
  // Draco's order depends on the presence of normals: without them it fills gaps of its vertex list from the end.
  prep::Mesh half = prep::test::sphere(15, 32);
  std::erase_if(half.triangles, [&](const glm::uvec3& t) { return half.positions[t.x].y < 0; });
  std::vector<std::uint32_t> at(half.positions.size(), 0);
  prep::Mesh open;
  for (glm::uvec3 t : half.triangles) {
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& number = at[t[c]];
      if (number == 0)
        open.positions.push_back(half.positions[t[c]]), number = static_cast<std::uint32_t>(open.positions.size());
      t[c] = number - 1;
    }
    open.triangles.push_back(t);
  }
  for (const bool normals : {false, true}) {
    const TriangleMesh mesh = makeMesh(open, normals);
    const RoundTrip encoded = roundTrip(mesh, {gridFor(mesh.positions, 20), 12});
    EXPECT_EQ(encoded.method, "edgebreaker") << encoded.sequentialReason;
    expectMap(mesh, encoded);
  }
}

// As the encoder's input.
std::unique_ptr<draco::Mesh> dracoMesh(const TriangleMesh& mesh) {
  const Grid grid = gridFor(mesh.positions, 20);
  return makeDracoMesh(mesh, roundPositions(mesh.positions, grid.step), grid, {});
}

std::vector<std::uint32_t> identity(std::size_t size) {
  std::vector<std::uint32_t> numbers(size);
  for (std::uint32_t i = 0; i < size; ++i) numbers[i] = i;
  return numbers;
}

TEST(SourceMap, RefusesOtherTriangles) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(15, 32));
  const auto source = dracoMesh(mesh);
  const auto match = [&](const TriangleMesh& other) {
    return matchTriangles(faces(*source), faces(*dracoMesh(other)), identity(mesh.positions.size()));
  };
  EXPECT_EQ(match(mesh), identity(mesh.triangles.size()));
  TriangleMesh changed = mesh;
  std::swap(changed.triangles[3].x, changed.triangles[3].y);  // flipped
  EXPECT_FALSE(match(changed).has_value());
  changed = mesh;
  changed.triangles[3] = changed.triangles[4];  // one triangle twice, one missing
  EXPECT_FALSE(match(changed).has_value());
  changed.triangles = mesh.triangles;
  changed.triangles.pop_back();
  EXPECT_FALSE(match(changed).has_value());

  // The corners of a triangle begin anywhere, and the k-th of equal triangles is the k-th of the source.
  changed = mesh;
  for (glm::uvec3& t : changed.triangles) t = {t.y, t.z, t.x};
  EXPECT_EQ(match(changed), identity(mesh.triangles.size()));
  TriangleMesh twice = mesh;
  twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  EXPECT_EQ(matchTriangles(faces(*dracoMesh(twice)), faces(*dracoMesh(twice)), identity(mesh.positions.size())),
            identity(twice.triangles.size()));
}

TEST(SourceMap, MapsVertices) {
  const TriangleMesh mesh = makeMesh(prep::test::sphere(15, 32));
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  TriangleMesh reversed = mesh;
  for (glm::uvec3& t : reversed.triangles) t = glm::uvec3(count - 1) - t;
  std::vector<std::uint32_t> vertices = identity(count);
  std::reverse(vertices.begin(), vertices.end());
  EXPECT_EQ(matchTriangles(faces(*dracoMesh(mesh)), faces(*dracoMesh(reversed)), vertices),
            identity(mesh.triangles.size()));
  EXPECT_TRUE(isPermutation(vertices));
  vertices[2] = vertices[3];
  EXPECT_FALSE(isPermutation(vertices));
  vertices[2] = count;
  EXPECT_FALSE(isPermutation(vertices));
}

TEST(SourceMap, RefusesOtherValues) {
  constexpr int kNormalBits = 12;
  for (const bool normals : {false, true}) {
    const TriangleMesh mesh = makeMesh(prep::test::sphere(15, 32), normals);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    const auto source = dracoMesh(mesh);
    const std::optional<DracoBytes> bytes = writeDraco(Method::kSequential, *source, kNormalBits);
    ASSERT_TRUE(bytes.has_value());
    draco::Mesh decoded;
    readDraco(bytes->bytes, {count, static_cast<std::uint32_t>(mesh.triangles.size())}, draco::DT_INT32, {}, "test",
              decoded);
    std::vector<std::uint32_t> vertices = identity(count);
    EXPECT_TRUE(haveEqualValues(*source, decoded, vertices, kNormalBits));
    std::swap(vertices[5], vertices[90]);
    EXPECT_FALSE(haveEqualValues(*source, decoded, vertices, kNormalBits));
    vertices = identity(count);
    TriangleMesh changed = mesh;
    changed.positions[7].x += 1e-4;
    EXPECT_FALSE(haveEqualValues(*dracoMesh(changed), decoded, vertices, kNormalBits));
    changed = mesh;
    if (normals) changed.normals[5] = -changed.normals[5];
    EXPECT_EQ(haveEqualValues(*dracoMesh(changed), decoded, vertices, kNormalBits), !normals);
    changed.normals.assign(normals ? 0 : count, glm::vec3(0, 0, 1));
    EXPECT_FALSE(haveEqualValues(*dracoMesh(changed), decoded, vertices, kNormalBits));
  }
}

// Two vertices of equal positions, and two equal triangles: the order is that of the encoder.
TEST(SourceMap, IsKnownForEqualVertices) {
  prep::Mesh pair = prep::test::sphere(15, 32);
  const auto count = static_cast<std::uint32_t>(pair.positions.size());
  const std::vector<glm::uvec3> triangles = pair.triangles;
  pair.positions.insert(pair.positions.end(), pair.positions.begin(), pair.positions.begin() + count);
  for (const glm::uvec3& t : triangles) pair.triangles.push_back(t + count);
  const TriangleMesh mesh = makeMesh(pair, false);
  const RoundTrip encoded = roundTrip(mesh, {gridFor(mesh.positions, 20), 12});
  EXPECT_EQ(encoded.method, "edgebreaker") << encoded.sequentialReason;
  expectMap(mesh, encoded);
}

TEST(SourceMap, GivesTheReasonAgainstEdgebreaker) {
  prep::Mesh degenerate = prep::test::sphere(15, 32);
  degenerate.triangles.emplace_back(3, 3, 4);
  const TriangleMesh mesh = makeMesh(degenerate, false);
  EXPECT_TRUE(contains(encode(mesh, {gridFor(mesh.positions, 20), 12}).sequentialReason, "degenerate"));
  const TriangleMesh one = sliver(1);
  EXPECT_EQ(encode(one, {gridFor(one.positions, 20), 12}).sequentialReason, "edgebreaker is not smaller");
}

}  // namespace
}  // namespace malus::compress

// Texture coordinates and tangents in Draco data: errors in texels within their bound, values unchanged by Draco.
#include "meshprep/compress/texture_rounding.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/compress/bounds.h"
#include "meshprep/compress/draco_mesh.h"
#include "meshprep/compress/mesh_file.h"
#include "tests/meshprep/compress/round_trip.h"
#include "tests/meshprep/shapes.h"

namespace malus::compress {
namespace {

using test::RoundTrip;

using prep::test::errorMessage;

struct Textured {
  TriangleMesh mesh;
  std::vector<glm::vec2> sets[2];
  std::vector<glm::vec4> tangents;
  TextureView view() const { return {{sets[0], sets[1]}, tangents}; }
};

// Drops the vertices of no triangle.
void dropLoose(TriangleMesh& mesh) {
  std::vector<std::uint32_t> number(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) number[t.x] = number[t.y] = number[t.z] = 1;
  std::vector<glm::dvec3> kept;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != 0) {
      number[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(mesh.positions[v]);
    }
  for (glm::uvec3& t : mesh.triangles) t = {number[t.x], number[t.y], number[t.z]};
  mesh.positions = std::move(kept);
}

// A sphere with random coordinates in [-range, range] and random tangents; with seams, vertices occur twice.
Textured randomMesh(std::uint32_t seed, double range, bool hasSeams) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const prep::Mesh sphere = prep::test::sphere(7 + static_cast<int>(seed % 5), 12);
  Textured result;
  result.mesh.positions = sphere.positions;
  result.mesh.triangles = sphere.triangles;
  if (hasSeams) {
    const auto count = static_cast<std::uint32_t>(sphere.positions.size());
    result.mesh.positions.insert(result.mesh.positions.end(), sphere.positions.begin(), sphere.positions.end());
    for (std::size_t i = 0; i < result.mesh.triangles.size() / 2; ++i) result.mesh.triangles[i] += count;
    dropLoose(result.mesh);
  }
  for (std::size_t i = 0; i < result.mesh.positions.size(); ++i) {
    for (std::vector<glm::vec2>& set : result.sets) set.emplace_back(range * uniform(random), range * uniform(random));
    const glm::dvec3 t(uniform(random), uniform(random), uniform(random));
    result.tangents.emplace_back(glm::vec3(glm::normalize(t)), uniform(random) < 0 ? -1.0f : 1.0f);
  }
  return result;
}

Settings settingsFor(const TriangleMesh& mesh) { return {gridFor(mesh.positions, 16), 12}; }

RoundTrip encodeTextured(const Textured& source, const RoundedTextures& rounded) {
  const Settings settings = settingsFor(source.mesh);
  std::vector<glm::dvec3> positions;
  for (const glm::dvec3& p : source.mesh.positions)
    positions.push_back(glm::round(p / settings.grid.step) * settings.grid.step);
  return test::decoded(encode(source.mesh, positions, settings, rounded), source.mesh, settings, rounded.grids);
}

// Requires that each decoded vertex has the rounded attributes of its source.
void expectAttributes(const TriangleMesh& decoded, const Encoded& encoded, const Textured& source, double uvError,
                      double tangentDegrees) {
  for (std::size_t i = 0; i < decoded.positions.size(); ++i) {
    const std::uint32_t v = encoded.sourceVertices[i];
    for (std::size_t set = 0; set < 2; ++set)
      for (int axis = 0; axis < 2; ++axis)
        ASSERT_LE(std::abs(static_cast<double>(decoded.textureCoordinates[set].at(i)[axis]) -
                           static_cast<double>(source.sets[set][v][axis])),
                  uvError);
    const glm::dvec3 a(decoded.tangents.at(i)), b(source.tangents[v]);
    ASSERT_LE(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)), tangentDegrees * 1.0001 * 0.0174532925199433);
    ASSERT_EQ(decoded.tangents[i].w, source.tangents[v].w);
  }
}

TEST(TextureRounding, RandomMeshesKeepTheirBound) {
  std::uint32_t seed = 0;
  for (const double bound : {1.0 / 16, 0.3, 1.0, 4.0})
    for (const double range : {1e-3, 1.0, 50.0, 3000.0})
      for (const double texels : {4.0, 1024.0, 5000.0}) {
        ++seed;
        const Textured source = randomMesh(seed, range, seed % 2 == 0);
        const RoundedTextures rounded = roundTextures(source.view(), texels, bound, 0.05, "x");
        const TextureDeviation deviation = measureTextures(source.view(), rounded, texels);
        EXPECT_LE(deviation.uvTexels, bound);
        EXPECT_LE(deviation.tangentDegrees, 0.05);
        // The step is the largest power of two whose half is within the bound.
        EXPECT_LE(rounded.grids.sets[0].step / 2, bound / texels);
        EXPECT_GT(rounded.grids.sets[0].step, bound / texels);
        const RoundTrip encoded = encodeTextured(source, rounded);
        ASSERT_NO_FATAL_FAILURE(expectAttributes(encoded.decoded, encoded, source, bound / texels, 0.05)) << seed;
      }
}

TEST(TextureRounding, BothEncodingsHaveThem) {
  bool edgebreaker = false, sequential = false;
  for (std::uint32_t seed = 1; seed < 4; ++seed) {
    Textured source = randomMesh(seed, 1, true);
    if (seed == 2) source.mesh.triangles.push_back(source.mesh.triangles[0]);  // not manifold
    for (std::size_t i = 0; i < source.sets[0].size(); ++i) {                  // smooth
      source.sets[0][i] = source.sets[1][i] = glm::vec2(source.mesh.positions[i]);
      source.tangents[i] = {1, 0, 0, 1};
    }
    const RoundTrip encoded = encodeTextured(source, roundTextures(source.view(), 4096, 0.25, 1, "x"));
    (encoded.method == "edgebreaker" ? edgebreaker : sequential) = true;
    ASSERT_NO_FATAL_FAILURE(expectAttributes(encoded.decoded, encoded, source, 0.25 / 4096, 1));
  }
  EXPECT_TRUE(edgebreaker);
  EXPECT_TRUE(sequential);
}

TEST(TextureRounding, SubsetsOfTheAttributes) {
  for (int subset = 0; subset < 8; ++subset) {
    Textured source = randomMesh(3, 300, false);  // above 20 bits: split integers
    if ((subset & 1) == 0) source.sets[0].clear();
    if ((subset & 2) == 0) source.sets[1].clear();
    if ((subset & 4) == 0) source.tangents.clear();
    const RoundedTextures rounded = roundTextures(source.view(), 8192, 1.0 / 16, 0.05, "x");
    EXPECT_EQ(rounded.grids.any(), subset > 0);
    const RoundTrip encoded = encodeTextured(source, rounded);
    EXPECT_EQ(encoded.decoded.textureCoordinates[0].size(), source.sets[0].size());
    EXPECT_EQ(encoded.decoded.textureCoordinates[1].size(), source.sets[1].size());
    EXPECT_EQ(encoded.decoded.tangents.size(), source.tangents.size());
    // Through a file of malus prep.
    const Grid grid = settingsFor(source.mesh).grid;
    const TriangleMesh read = decodeMeshFile(meshFileBytes(encoded.bytes, grid, rounded.grids), "x");
    EXPECT_EQ(read.textureCoordinates, encoded.decoded.textureCoordinates);
    EXPECT_EQ(read.tangents, encoded.decoded.tangents);
    if (subset > 0) {
      EXPECT_CONTAINS(errorMessage([&] { decodeMeshFile(meshFileBytes(encoded.bytes, grid), "x"); }), "Draco");
    }
  }
}

TEST(TextureRounding, AxesAreExact) {
  std::vector<glm::vec4> tangents;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec4 t(0, 0, 0, sign);
      t[axis] = sign;
      tangents.push_back(t);
    }
  const TextureView view{{}, tangents};
  const RoundedTextures rounded = roundTextures(view, 1, 1, 0.05, "x");
  EXPECT_EQ(rounded.grids.tangentBits, kMinTangentBits);
  for (std::size_t i = 0; i < tangents.size(); ++i)
    EXPECT_EQ(decodedTangent(rounded.tangents[i], rounded.grids.tangentBits), tangents[i]);
}

TEST(TextureRounding, RangesThatDoNotFitAreReported) {
  const std::vector<glm::vec2> coordinates = {{-1e6f, 0}, {1e6f, 0}, {0.1f, 0.3f}};
  const TextureView view{{coordinates, {}}, {}};
  const RoundedTextures rounded = roundTextures(view, 4096, 1.0 / 16, 0.05, "x");
  const TextureDeviation deviation = measureTextures(view, rounded, 4096);
  EXPECT_GT(deviation.uvTexels, 1.0 / 16);
  Bounds bounds;
  EXPECT_EQ(checkTextures(deviation, rounded.grids, bounds, "x").size(), 1u);
  bounds.uvErrorTexels = 1.0 / 16;
  EXPECT_CONTAINS(errorMessage([&] { checkTextures(deviation, rounded.grids, bounds, "x"); }), "--max-uv-error");
}

TEST(TextureRounding, InvalidInputsAreRefused) {
  const std::vector<glm::vec2> infinite = {{1, INFINITY}}, large = {{2e6f, 0}}, good = {{0, 0}};
  const std::vector<glm::vec4> notUnit = {{1, 1, 0, 1}}, noSign = {{1, 0, 0, 0}};
  const auto error = [](const TextureView& view, double bound = 1) {
    return errorMessage([&] { roundTextures(view, 1024, bound, 0.05, "x"); });
  };
  EXPECT_CONTAINS(error({{infinite, {}}, {}}), "out of range");
  EXPECT_CONTAINS(error({{large, {}}, {}}), "out of range");
  EXPECT_CONTAINS(error({{}, notUnit}), "invalid tangent");
  EXPECT_CONTAINS(error({{}, noSign}), "invalid tangent");
  for (const double bound : {0.0, -1.0, double{NAN}, double{INFINITY}})
    EXPECT_CONTAINS(error({{good, {}}, {}}, bound), "--max-uv-error");
  TextureGrids grids;
  EXPECT_EQ(errorMessage([&] { requireValid(grids, "x"); }), "");
  grids.sets[1] = {{0.5, 0}, 1};
  EXPECT_CONTAINS(errorMessage([&] { requireValid(grids, "x"); }), "invalid grid");
}

}  // namespace
}  // namespace malus::compress

// Contacts after rounding: a search by pieces finds those of a search in the whole mesh.
#include "meshprep/certify/rounded_contacts.h"

#include <random>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/compress/grid_rounding.h"
#include "meshprep/instances.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using Pairs = std::vector<Intersections::Pair>;

// A mesh at nodes with these transforms, prepared.
Mesh prepared(const Mesh& mesh, const std::vector<json>& nodes) {
  test::GltfFile gltf;
  gltf.addMesh(mesh, "mesh");
  for (json node : nodes) {
    node["mesh"] = 0;
    gltf.addNode(node);
  }
  const test::TemporaryFile file(".glb", gltf.glb());
  Report report;
  return prepareInstances(readSourceScene(file.path()), "file", {}, report);
}

// Contacts by a search in the whole mesh.
Pairs findContacts(const Mesh& mesh, const std::vector<glm::dvec3>& rounded) {
  Mesh whole = mesh;
  whole.positions = rounded;
  Intersections found = findIntersections(whole);
  found.crossing.insert(found.crossing.end(), found.coincident.begin(), found.coincident.end());
  return found.crossing;
}

// A body of two spheres, one inside out in the other at a distance.
Mesh shell(double thickness) {
  Mesh inner = test::flipped(test::sphere(11, 18));
  for (glm::dvec3& p : inner.positions) p *= 1 - thickness;
  return test::joined(test::sphere(11, 18), inner);
}

const std::vector<json> kPlaces = {
    json::object(),
    {{"translation", {5, 0.1, 0}}},
    {{"translation", {0, 7, 0}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}},
    {{"translation", {0, 0, 9}}, {"scale", {2, 2, 2}}},
    {{"translation", {-9, 0, 0}}, {"scale", {-1, 1, 1}}},                                          // mirrored
    {{"translation", {0, -9, 0}}, {"scale", {1, -0.5, 1}}},                                        // another shape
    {{"translation", {30, 31, 3.3}}, {"rotation", {0.36, 0.48, 0, 0.8}}, {"scale", {-3, 3, 3}}}};  // mirrored

TEST(RoundedContacts, AreThoseOfTheWholeMesh) {
  bool someTouch = false, someDoNot = false;
  for (const double thickness : {1e-6, 1e-3, 0.05})
    for (const bool isShell : {false, true}) {
      const Mesh mesh = prepared(isShell ? shell(thickness) : test::sphere(11, 18), kPlaces);
      ASSERT_EQ(mesh.pieces.size(), kPlaces.size());
      RoundedContacts contacts(mesh);
      for (const int exponent : {-2, -5, -8, -10, -14, -18, -22, -30}) {
        const std::vector<glm::dvec3> rounded = compress::roundPositions(mesh.positions, std::ldexp(1.0, exponent));
        const Pairs expected = findContacts(mesh, rounded);
        EXPECT_EQ(contacts.find(rounded), expected) << thickness << ", 2^" << exponent;
        (expected.empty() ? someDoNot : someTouch) = true;
      }
    }
  EXPECT_TRUE(someTouch);
  EXPECT_TRUE(someDoNot);
}

TEST(RoundedContacts, OfOneShapeAreSearchedOnce) {
  std::vector<json> nodes;
  for (int i = 0; i < 50; ++i)
    nodes.push_back({{"translation", {3.1 * i, 0.7 * i, 0}}, {"scale", {i % 2 * 2 - 1, 1, 1}}});
  const Mesh mesh = prepared(test::sphere(31, 64), nodes);
  RoundedContacts contacts(mesh);
  EXPECT_TRUE(contacts.find(compress::roundPositions(mesh.positions, 0x1p-20)).empty());
  EXPECT_LE(contacts.searchedTriangles(), 2 * test::sphere(31, 64).triangles.size());
}

// Bodies at distances that rounding removes, beside others that are apart.
TEST(RoundedContacts, BetweenPiecesAreFound) {
  for (const double gap : {1e-7, 1e-5, 1e-3}) {
    const std::vector<json> nodes = {json::object(),
                                     {{"translation", {1 + gap, 0, 0}}},
                                     {{"translation", {0, 0, 5}}},
                                     {{"translation", {0, 1 + gap, 5}}, {"scale", {1, 1, -1}}}};
    test::GltfFile gltf;
    const Mesh mesh = prepared(test::cube(), nodes);
    RoundedContacts contacts(mesh);
    for (const int exponent : {-4, -12, -20, -30}) {
      const std::vector<glm::dvec3> rounded = compress::roundPositions(mesh.positions, std::ldexp(1.0, exponent));
      EXPECT_EQ(contacts.find(rounded), findContacts(mesh, rounded)) << gap << ", 2^" << exponent;
      EXPECT_EQ(contacts.find(rounded).empty(), std::ldexp(1.0, exponent) < gap) << gap << ", 2^" << exponent;
    }
  }
}

TEST(ClosePairs, IncludeAllThatMayTouch) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Mesh& mesh :
       {test::sphere(7, 12), test::cube(), shell(0.01), test::joined(test::cube(), test::cube(1, {1.004, 0, 0}))})
    for (const double distance : {1e-9, 1e-4, 2e-3, 1e-2, 0.1}) {
      const auto close = findClosePairs(mesh, distance);
      ASSERT_TRUE(close.has_value());
      EXPECT_TRUE(std::is_sorted(close->begin(), close->end()));
      EXPECT_TRUE(distance > 1e-8 || close->empty());
      for (int round = 0; round < 40; ++round) {
        // Move every vertex by the distance, in a random direction.
        Mesh moved = mesh;
        for (glm::dvec3& p : moved.positions)
          p += 0.999999 * distance * glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
        const Pairs touching = findContacts(moved, moved.positions);
        for (const auto& pair : touching) EXPECT_TRUE(std::binary_search(close->begin(), close->end(), pair));
        const Intersections tested = testPairs(moved.positions, moved.triangles, *close);
        EXPECT_EQ(tested.crossing, touching) << distance;
        EXPECT_TRUE(tested.coincident.empty());
      }
    }
}

}  // namespace
}  // namespace malus::prep

#include "tests/meshprep/read/crosscheck.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

constexpr std::string_view kText = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

// Returns the error of the comparison after `change` is applied to a correct scan.
template <class Change>
std::string reportAfter(Change change) {
  std::string bytes(kText);
  Scan scan = scanObj(bytes, "test");
  change(scan.polygons);
  return test::errorMessage([&] { test::requireSameAsOpenMesh(bytes, ".obj", scan); });
}

TEST(Crosscheck, FindsEveryDifference) {
  EXPECT_EQ(reportAfter([](Polygons&) {}), "");
  EXPECT_TRUE(test::contains(reportAfter([](Polygons& p) { p.positions[2].y = 1.001; }), "vertex 2"));
  EXPECT_TRUE(test::contains(reportAfter([](Polygons& p) { p.positions.emplace_back(0); }), "vertices"));
  EXPECT_TRUE(test::contains(reportAfter([](Polygons& p) { p.corners[4] = 1; }), "faces"));
  EXPECT_TRUE(test::contains(reportAfter([](Polygons& p) {
                               p.corners.insert(p.corners.end(), {1, 2, 3});
                               p.closeFace();
                             }),
                             "faces"));
}

// Files of the fuzz targets, each with many features of its format.
class CrosscheckCorpus : public testing::TestWithParam<const char*> {};

TEST_P(CrosscheckCorpus, AgreesWithOpenMesh) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(MALUS_FUZZ_CORPUS) / GetParam())) {
    EXPECT_GT(test::readCrosschecked(entry.path()).faceCount(), 0u) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0u);
}

INSTANTIATE_TEST_SUITE_P(Formats, CrosscheckCorpus, testing::Values("obj", "ply", "stl", "off"));

}  // namespace
}  // namespace malus::prep

#include "tests/cases/checks.h"

#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <glm/geometric.hpp>

#include "meshprep/base/image.h"
#include "meshprep/compress/mesh_file.h"
#include "tests/tools/command.h"

namespace malus::test {

namespace {

using nlohmann::json;

constexpr double kMeshTolerance = 1e-6;  // relative, of volume and area

void expectNear(double found, double expected, double relative, const std::string& name) {
  EXPECT_LE(std::abs(found - expected), relative * std::abs(expected))
      << name << ": " << found << ", expected " << expected;
}

// Colours of one pixel, all three equal to the expected value.
void checkPixel(const image::Image& image, std::size_t pixel, double expected, double relative,
                const std::string& name) {
  for (const char* colour : {"R", "G", "B"}) {
    const int channel = image.channel(colour);
    ASSERT_GE(channel, 0) << name << ": no channel " << colour;
    const float value = image.pixels[pixel * image.channels.size() + static_cast<std::size_t>(channel)];
    expectNear(static_cast<double>(value), expected, relative, name + ", pixel " + std::to_string(pixel));
  }
}

// Positions of an OBJ file.
std::vector<glm::dvec3> objPositions(const std::filesystem::path& file) {
  std::istringstream lines(readText(file));
  std::vector<glm::dvec3> positions;
  std::string word;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    glm::dvec3 p{};
    if (words >> word && word == "v" && words >> p.x >> p.y >> p.z) positions.push_back(p);
  }
  return positions;
}

double farthestFromMesh(const std::vector<glm::dvec3>& source, const std::vector<glm::dvec3>& delivered) {
  double farthest = 0;
  for (const glm::dvec3& s : source) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& d : delivered) nearest = std::min(nearest, glm::length(s - d));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

// Boxes of the bodies: triangles that share a position exactly are of one body.
std::vector<Box> bodyBoxes(const compress::TriangleMesh& mesh) {
  std::vector<std::size_t> body(mesh.positions.size());
  std::iota(body.begin(), body.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (body[i] != i) i = body[i];
    return i;
  };
  std::map<std::array<double, 3>, std::size_t> first;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3& p = mesh.positions[i];
    body[root(i)] = root(first.emplace(std::array{p.x, p.y, p.z}, i).first->second);
  }
  for (const glm::uvec3& t : mesh.triangles) body[root(t.x)] = root(t.y), body[root(t.y)] = root(t.z);
  std::map<std::size_t, Box> boxes;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Box& box = boxes[root(i)];
    box.low = glm::min(box.low, mesh.positions[i]);
    box.high = glm::max(box.high, mesh.positions[i]);
  }
  std::vector<Box> list;
  for (const auto& [id, box] : boxes) list.push_back(box);
  return list;
}

// Largest gap along an axis of the closest pair of boxes; negative: they overlap.
double smallestGap(const std::vector<Box>& boxes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const glm::dvec3 gap = glm::max(boxes[i].low - boxes[j].high, boxes[j].low - boxes[i].high);
      smallest = std::min(smallest, std::max({gap.x, gap.y, gap.z}));
    }
  return smallest;
}

}  // namespace

void expectKeys(const json& object, std::initializer_list<const char*> known) {
  for (const auto& [key, value] : object.items())
    EXPECT_NE(std::find(known.begin(), known.end(), key), known.end()) << "unknown key '" << key << "' in " << object;
}

void checkValue(const json& found, const json& expected, const std::string& name) {
  if (!expected.is_object()) {
    EXPECT_EQ(found, expected) << name;
    return;
  }
  expectKeys(expected, {"equals", "relative", "atMost"});
  ASSERT_TRUE(found.is_number()) << name << " is " << found;
  ASSERT_TRUE(expected.contains("equals") || expected.contains("atMost")) << name;
  if (expected.contains("equals"))
    expectNear(found, expected["equals"], expected.at("relative"), name);
  else
    EXPECT_LE(found.get<double>(), expected["atMost"].get<double>()) << name;
}

void checkText(const std::filesystem::path& file, const json& expected) {
  expectKeys(expected, {"contains", "without"});
  const std::string text = readText(file);
  for (const std::string part : expected.value("contains", json::array()))
    EXPECT_TRUE(contains(text, part)) << file << " lacks '" << part << "'";
  for (const std::string part : expected.value("without", json::array()))
    EXPECT_FALSE(contains(text, part)) << file << " contains '" << part << "'";
}

void checkImage(const std::filesystem::path& file, const json& expected) {
  expectKeys(expected, {"centre", "corner", "every", "relative"});
  const image::Image image = image::read(file);
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  const double relative = expected.at("relative");
  const std::string name = file.filename();
  if (expected.contains("centre"))
    checkPixel(image, height / 2 * width + width / 2, expected["centre"], relative, name);
  if (expected.contains("corner")) checkPixel(image, 0, expected["corner"], relative, name);
  if (!expected.contains("every")) return;
  for (std::size_t i = 0; i < width * height; ++i) checkPixel(image, i, expected["every"], relative, name);
}

void checkMesh(const std::filesystem::path& file, const json& expected) {
  expectKeys(expected, {"triangles", "volume", "area", "source", "within", "bodiesApart"});
  const std::string bytes = readText(file);
  const compress::TriangleMesh mesh = compress::decodeMeshFile(std::as_bytes(std::span(bytes)), file.string());
  ASSERT_FALSE(mesh.triangles.empty());
  const glm::dvec3 origin = mesh.positions[mesh.triangles[0].x];
  double volume = 0, area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x] - origin, b = mesh.positions[t.y] - origin,
                     c = mesh.positions[t.z] - origin;
    const double twice = glm::length(glm::cross(b - a, c - a));
    EXPECT_GT(twice, 0) << "a triangle without area";
    area += twice / 2;
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  EXPECT_EQ(mesh.triangles.size(), expected.at("triangles").get<std::size_t>());
  if (expected.contains("volume")) expectNear(volume, expected["volume"], kMeshTolerance, "volume");
  if (expected.contains("area")) expectNear(area, expected["area"], kMeshTolerance, "area");
  if (expected.contains("source")) {
    const std::vector<glm::dvec3> source = objPositions(file.parent_path() / expected["source"].get<std::string>());
    EXPECT_FALSE(source.empty());
    EXPECT_LE(farthestFromMesh(source, mesh.positions), expected.at("within").get<double>());
  }
  if (expected.contains("bodiesApart")) {
    const std::vector<Box> boxes = bodyBoxes(mesh);
    EXPECT_GE(boxes.size(), 2u);
    EXPECT_GE(smallestGap(boxes), expected["bodiesApart"].get<double>());
  }
}

}  // namespace malus::test

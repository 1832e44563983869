#include "meshprep/cli.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/clean/intersections.h"
#include "meshprep/compress/mesh_file.h"
#include "meshprep/prepare.h"
#include "tests/meshprep/read/gltf_files.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;
using test::TemporaryFile;

// Runs `malus prep ...`; returns what it prints.
std::string run(std::vector<std::string> arguments) {
  CLI::App app;
  addPrepCommand(app);
  arguments.insert(arguments.begin(), "prep");
  std::reverse(arguments.begin(), arguments.end());
  testing::internal::CaptureStdout();
  try {
    app.parse(arguments);
  } catch (...) {
    testing::internal::GetCapturedStdout();
    throw;
  }
  std::fflush(stdout);
  return testing::internal::GetCapturedStdout();
}

class PrepCommand : public testing::Test {
 protected:
  void TearDown() override {
    std::filesystem::remove(output_);
    std::filesystem::remove(report_);
    std::filesystem::remove(map_);
  }
  const TemporaryFile input_{".obj", test::objText(test::cube())};
  const std::filesystem::path output_ = test::temporaryPath(".mesh.drc");
  const std::filesystem::path report_ = test::temporaryPath(".json");
  const std::filesystem::path map_ = test::temporaryPath(".json");
};

TEST_F(PrepCommand, WritesAMeshAndAReport) {
  const std::string printed =
      run({input_.path().string(), "-o", output_.string(), "--report", report_.string(), "--json"});
  const nlohmann::json json = nlohmann::json::parse(printed);
  EXPECT_EQ(json, nlohmann::json::parse(readTextFile(report_)));
  EXPECT_EQ(json["output"]["vertices"], 24);
  EXPECT_EQ(json["output"]["triangles"], 12);
  EXPECT_LT(json["errors"]["positionMax"].get<double>(), 2e-6);
  EXPECT_LT(json["errors"]["normalMaxDegrees"].get<double>(), 0.06);
  const std::vector<std::byte> bytes = readFile(output_);
  EXPECT_EQ(json["compression"]["bytes"], bytes.size());
  const compress::TriangleMesh mesh = compress::decodeMeshFile(bytes, "file");
  EXPECT_EQ(mesh.normals.size(), 24u);
}

TEST_F(PrepCommand, KeepsTextureCoordinatesOnRequest) {
  std::string text = test::objText(test::cube());
  text += "vt 0 0\nvt 0.3 0\nvt 0 0.7\nf 1/1 2/2 3/3\n";
  const TemporaryFile file(".obj", text);
  const std::vector<std::string> arguments = {file.path().string(), "-o", output_.string(), "--json", "--open-surface"};
  run(arguments);
  EXPECT_TRUE(compress::decodeMeshFile(readFile(output_), "file").textureCoordinates[0].empty());
  for (const char* bound : {"0.0625", "4"}) {
    std::vector<std::string> bounded = arguments;
    bounded.insert(bounded.end(), {"--max-uv-error", bound});
    const nlohmann::json json = nlohmann::json::parse(run(bounded));
    const compress::TriangleMesh mesh = compress::decodeMeshFile(readFile(output_), "file");
    EXPECT_EQ(mesh.textureCoordinates[0].size(), mesh.positions.size());
    EXPECT_LE(json["errors"]["uvMaxTexels"].get<double>(), std::stod(bound));
    EXPECT_GT(json["errors"]["uvMaxTexels"].get<double>(), 0);
  }
  std::vector<std::string> bad = arguments;
  bad.insert(bad.end(), {"--max-uv-error", "0"});
  EXPECT_ANY_THROW(run(bad));
}

TEST_F(PrepCommand, PrintsATable) {
  const std::string printed = run({input_.path().string(), "-o", output_.string(), "--flat"});
  EXPECT_TRUE(contains(printed, "before"));
  EXPECT_TRUE(compress::decodeMeshFile(readFile(output_), "file").normals.empty());
}

TEST_F(PrepCommand, Simplifies) {
  const TemporaryFile sphere(".obj", test::objText(test::sphere(20, 30)));
  const std::vector<std::string> arguments = {sphere.path().string(), "-o", output_.string(), "--simplify-error",
                                              "0.05"};
  EXPECT_TRUE(contains(run(arguments), "deviation"));
  std::vector<std::string> json = arguments;
  json.insert(json.end(),
              {"--simplify-triangles", "400", "--simplify-normal", "60", "--json", "--source-map", map_.string()});
  const nlohmann::json report = nlohmann::json::parse(run(json));
  EXPECT_EQ(report["simplification"]["trianglesBefore"], 1200);
  EXPECT_EQ(report["simplification"]["trianglesAfter"], report["output"]["triangles"]);
  EXPECT_LE(report["output"]["triangles"], 400);
  EXPECT_LE(report["simplification"]["maxDeviation"].get<double>(), 0.05);
  EXPECT_EQ(nlohmann::json::parse(readTextFile(map_))["triangles"].size(), report["output"]["triangles"]);
  for (const char* bad : {"0", "-1", "nan", "x"}) {
    json[4] = bad;
    EXPECT_ANY_THROW(run(json)) << bad;
  }
}

TEST_F(PrepCommand, WritesTheSourceMap) {
  run({input_.path().string(), "-o", output_.string(), "--source-map", map_.string()});
  const nlohmann::json map = nlohmann::json::parse(readTextFile(map_));
  const compress::TriangleMesh mesh = compress::decodeMeshFile(readFile(output_), "file");
  ASSERT_EQ(map.at("vertices").size(), 24u);  // three per vertex of the file
  ASSERT_EQ(map.at("triangles").size(), 12u);
  // Indices refer to the file, or to the prepared mesh if it has no sources.
  Report report;
  const Mesh prepared = prepare(input_.path(), {}, report), cube = test::cube();
  const auto& positions = prepared.sourceVertices.empty() ? prepared.positions : cube.positions;
  const auto& triangles = prepared.sourceFaces.empty() ? prepared.triangles : cube.triangles;
  const auto& corners = prepared.sourceFaces.empty() ? prepared.positions : cube.positions;
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_LT(glm::distance(mesh.positions[i], positions.at(map["vertices"][i].get<std::size_t>())), 1e-5);
  for (std::size_t i = 0; i < 12; ++i) {
    const glm::uvec3 source = triangles.at(map["triangles"][i].get<std::size_t>());
    glm::dvec3 before(0), after(0);
    for (int c = 0; c < 3; ++c) before += corners.at(source[c]), after += mesh.positions[mesh.triangles[i][c]];
    EXPECT_LT(glm::distance(before, after), 1e-5) << i;
  }
}

TEST_F(PrepCommand, KeepsBoundsOrFails) {
  const TemporaryFile ball(".obj", test::objText(test::sphere(31, 64)));
  const auto prepared = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {ball.path().string(), "-o", output_.string(), "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return nlohmann::json::parse(run(arguments));
  };
  const nlohmann::json coarse = prepared({"--position-error", "0.01", "--normal-error", "5"}),
                       fine = prepared({"--position-error", "1e-6", "--normal-error", "0.01"});
  EXPECT_LE(coarse["errors"]["positionMax"], 0.01);
  EXPECT_LE(fine["errors"]["positionMax"], 1e-6);
  EXPECT_LE(fine["errors"]["normalMaxDegrees"], 0.01);
  EXPECT_LT(coarse["compression"]["positionBits"], fine["compression"]["positionBits"]);
  EXPECT_LT(coarse["compression"]["normalBits"], fine["compression"]["normalBits"]);
  EXPECT_LT(coarse["compression"]["bytes"], fine["compression"]["bytes"]);
  EXPECT_TRUE(fine["compression"]["warnings"].empty());
  EXPECT_TRUE(contains(errorMessage([&] {
                         prepared({"--position-bits", "8", "--position-error", "1e-9"});
                       }),
                       "position error exceeds"));
  EXPECT_EQ(prepared({"--position-bits", "9"})["compression"]["positionBits"], 9);
  EXPECT_THROW(prepared({"--position-error", "0"}), CLI::ParseError);
  EXPECT_THROW(prepared({"--normal-error", "-1"}), CLI::ParseError);
}

// Signed volume of a decoded mesh, relative to its first corner.
double volume(const compress::TriangleMesh& mesh) {
  double sum = 0;
  const glm::dvec3 o = mesh.positions.front();
  for (const glm::uvec3& t : mesh.triangles)
    sum += glm::dot(mesh.positions[t.x] - o, glm::cross(mesh.positions[t.y] - o, mesh.positions[t.z] - o)) / 6;
  return sum;
}

// A certified mesh is delivered as it was certified: at map coordinates, with narrow gaps, of any size.
TEST_F(PrepCommand, DeliversWhatIsCertified) {
  const auto delivered = [&](const Mesh& mesh) {
    const TemporaryFile file(".obj", test::objText(mesh));
    const nlohmann::json json = nlohmann::json::parse(
        run({file.path().string(), "-o", output_.string(), "--certify", "glass", "--json", "--flat"}));
    EXPECT_EQ(json["errors"]["degenerate"], 0);
    EXPECT_EQ(json["errors"]["flipped"], 0);
    EXPECT_LE(json["errors"]["tiltMaxDegrees"], 0.1);
    return compress::decodeMeshFile(readFile(output_), "file");
  };
  EXPECT_NEAR(volume(delivered(test::cube(1, {2e7, 1, 1}))), 1, 1e-6);
  Mesh sphere = test::sphere(15, 32);
  const double source = volume({sphere.positions, {}, sphere.triangles, {}, {}});
  for (glm::dvec3& p : sphere.positions) p += glm::dvec3(500000.3, 5400000.7, 100.2);
  EXPECT_NEAR(volume(delivered(sphere)), source, 1e-4);
  for (const double size : {1e-30, 1e30})
    EXPECT_NEAR(volume(delivered(test::cube(size))) / (size * size * size), 1, 1e-5) << size;
  const compress::TriangleMesh apart = delivered(test::joined(test::cube(), test::cube(1, {1 + 1e-7, 0, 0})));
  Mesh check;
  check.positions = apart.positions;
  check.triangles = apart.triangles;
  EXPECT_TRUE(findIntersections(check).crossing.empty());
  EXPECT_NEAR(volume(apart), 2, 1e-6);
}

TEST_F(PrepCommand, RefusesWhatRoundingCloses) {
  const TemporaryFile apart(".obj", test::objText(test::joined(test::cube(), test::cube(1, {1 + 1e-5, 0, 0}))));
  const std::string error = errorMessage([&] {
    run({apart.path().string(), "-o", output_.string(), "--certify", "glass", "--position-bits", "12"});
  });
  EXPECT_TRUE(contains(error, "touch", "12 position bits", " m apart")) << error;
  EXPECT_FALSE(std::filesystem::exists(output_));
  const TemporaryFile tiny(".obj", test::objText(test::cube(1e-60)));
  EXPECT_TRUE(contains(errorMessage([&] { run({tiny.path().string(), "-o", output_.string()}); }), "too small"));
  const TemporaryFile nested(".obj", test::objText(test::joined(test::cube(3), test::cube(1, {1, 1, 1}))));
  EXPECT_TRUE(contains(errorMessage([&] {
                         run({nested.path().string(), "-o", output_.string(), "--certify", "glass"});
                       }),
                       "solid inside a solid"));
}

// The same for instances, mirrored ones included: a pair is kept apart or refused, whatever else the file places.
TEST_F(PrepCommand, CertifiesInstancesAsDelivered) {
  const auto file = [](double gap) {
    test::GltfFile gltf;
    gltf.addMesh(test::cube(), "cube");
    for (const double z : {0.0, 3.0, 6.0, 9.0}) gltf.addNode({{"mesh", 0}, {"translation", {0, 0, z}}});
    gltf.addNode({{"mesh", 0}, {"translation", {1 + gap, 0, 0}}});
    gltf.addNode({{"mesh", 0}, {"translation", {2 + gap, 0, 9}}, {"scale", {-1, 1, 1}}});
    return gltf;
  };
  const TemporaryFile apart(".glb", file(1e-6).glb());  // a step of 20 bits is 8e-6 m
  run({apart.path().string(), "-o", output_.string(), "--certify", "glass", "--flat"});
  const compress::TriangleMesh delivered = compress::decodeMeshFile(readFile(output_), "file");
  Mesh check;
  check.positions = delivered.positions;
  check.triangles = delivered.triangles;
  EXPECT_EQ(delivered.triangles.size(), 6 * 12u);
  EXPECT_TRUE(findIntersections(check).crossing.empty());
  EXPECT_TRUE(findIntersections(check).coincident.empty());
  EXPECT_NEAR(volume(delivered), 6, 1e-4);

  std::filesystem::remove(output_);
  const std::vector<std::string> coarse = {
      apart.path().string(), "-o", output_.string(), "--certify", "glass", "--flat", "--position-bits", "16"};
  EXPECT_CONTAINS(errorMessage([&] { run(coarse); }), "touch");
  EXPECT_FALSE(std::filesystem::exists(output_));
  const TemporaryFile touching(".glb", file(0).glb());  // positions in common
  EXPECT_CONTAINS(errorMessage([&] {
                    run({touching.path().string(), "-o", output_.string(), "--certify", "glass"});
                  }),
                  "certified");
}

TEST_F(PrepCommand, IsDeterministic) {
  run({input_.path().string(), "-o", output_.string()});
  const std::vector<std::byte> first = readFile(output_);
  run({input_.path().string(), "-o", output_.string()});
  EXPECT_EQ(first, readFile(output_));
}

TEST_F(PrepCommand, LeavesNoFileAfterErrors) {
  const TemporaryFile bad(".obj", "v nan 0 0\n");
  EXPECT_TRUE(contains(errorMessage([&] { run({bad.path().string(), "-o", output_.string()}); }), "finite"));
  EXPECT_FALSE(std::filesystem::exists(output_));
  EXPECT_FALSE(errorMessage([&] { run({input_.path().string(), "-o", "/no/such/folder/x.drc"}); }).empty());
}

TEST_F(PrepCommand, RefusesInvalidArguments) {
  EXPECT_THROW(run({input_.path().string()}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--crease", "200"}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--position-bits", "31"}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--weld", "-1"}), CLI::ParseError);
}

TEST_F(PrepCommand, CertifiesGlassOrFails) {
  const std::string printed = run({input_.path().string(), "-o", output_.string(), "--certify", "glass", "--json"});
  EXPECT_EQ(nlohmann::json::parse(printed)["certificate"]["granted"], true);

  Mesh open = test::cube();
  open.triangles.pop_back();
  const TemporaryFile file(".obj", test::objText(open));
  std::filesystem::remove(output_);
  const std::string error = errorMessage([&] {
    run({file.path().string(), "-o", output_.string(), "--certify", "glass", "--report", report_.string()});
  });
  EXPECT_TRUE(contains(error, "3 open edges")) << error;
  EXPECT_FALSE(std::filesystem::exists(output_));
  const nlohmann::json report = nlohmann::json::parse(readTextFile(report_));
  EXPECT_EQ(report["certificate"]["granted"], false);
  EXPECT_EQ(report["certificate"]["problems"].size(), 1u);
  EXPECT_NO_THROW(run({file.path().string(), "-o", output_.string(), "--certify", "glass", "--fill-holes", "3"}));
}

TEST_F(PrepCommand, ReportsIntersectionsUnlessSkipped) {
  const TemporaryFile file(".obj", test::objText(test::joined(test::cube(), test::cube(1, {0.5, 0.3, 0.2}))));
  const auto crossing = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {file.path().string(), "-o", output_.string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const nlohmann::json json = nlohmann::json::parse(run(arguments));
    for (const nlohmann::json& step : json["steps"])
      if (step["name"] == "faces-crossing") return step["count"].get<int>();
    return -1;
  };
  EXPECT_GT(crossing({}), 0);
  EXPECT_EQ(crossing({"--skip", "intersections"}), -1);  // not inspected
  EXPECT_EQ(crossing({"--skip", "weld,junctions,intersections"}), -1);
  EXPECT_THROW(crossing({"--skip", "everything"}), CLI::ValidationError);
}

TEST_F(PrepCommand, UsesTheRequestedNormals) {
  const TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\ns 1\nf 1//1 2//1 3//1\n");
  const auto normal = [&](const char* kind) {
    run({file.path().string(), "-o", output_.string(), "--normals", kind});
    return compress::decodeMeshFile(readFile(output_), "file").normals[0];
  };
  EXPECT_NEAR(normal("authored").x, 0.6, 1e-3);
  EXPECT_NEAR(normal("smoothing").z, 1, 1e-3);
  EXPECT_NEAR(normal("crease").z, 1, 1e-3);
}

TEST_F(PrepCommand, AcceptsFormerOptions) {
  const TemporaryFile ball(".obj", test::objText(test::sphere(15, 32)));
  const std::vector<std::string> files = {ball.path().string(), "-o", output_.string()};
  const auto bytes = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = files;
    arguments.insert(arguments.end(), options.begin(), options.end());
    run(arguments);
    return readFile(output_);
  };
  EXPECT_EQ(bytes({"--max-normal-error", "2", "--sheet"}), bytes({"--normal-error", "2", "--open-surface"}));
  EXPECT_NE(bytes({"--max-normal-error", "2"}), bytes({"--max-normal-error", "0.01"}));
  EXPECT_THROW(bytes({"--max-normal-error", "0"}), CLI::ParseError);
  EXPECT_THROW(bytes({"--max-normal-error", "1", "--normal-error", "1"}), CLI::ParseError);
}

TEST_F(PrepCommand, RefusesFormerOptionsOfTwoMeanings) {
  const TemporaryFile ball(".obj", test::objText(test::sphere(15, 32)));
  for (const auto& [former, name] :
       {std::pair("--max-error", "--position-error"), std::pair("--keep-map", "--source-map")})
    for (const std::vector<std::string>& value : {std::vector<std::string>{}, std::vector<std::string>{"1"}}) {
      std::vector<std::string> arguments = {ball.path().string(), "-o", output_.string(), former};
      arguments.insert(arguments.end(), value.begin(), value.end());
      try {
        run(arguments);
        ADD_FAILURE() << former << " was accepted";
      } catch (const CLI::ValidationError& error) {
        EXPECT_TRUE(contains(error.what(), former) && contains(error.what(), name)) << error.what();
      }
      EXPECT_FALSE(std::filesystem::exists(output_)) << former;
    }
}

}  // namespace
}  // namespace malus::prep

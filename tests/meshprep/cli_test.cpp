#include "meshprep/cli.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/compress/draco_mesh.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorOf;
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
  }
  const TemporaryFile input_{".obj", test::objText(test::cube())};
  const std::filesystem::path output_ = test::temporaryPath(".mesh.drc");
  const std::filesystem::path report_ = test::temporaryPath(".json");
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
  const compress::TriangleMesh mesh = compress::decode(bytes, {24, 12}, "file");
  EXPECT_EQ(mesh.normals.size(), 24u);
}

TEST_F(PrepCommand, FlatTable) {
  const std::string printed = run({input_.path().string(), "-o", output_.string(), "--flat"});
  EXPECT_TRUE(contains(printed, "before       after"));
  EXPECT_TRUE(compress::decode(readFile(output_), {8, 12}, "file").normals.empty());
}

TEST_F(PrepCommand, SameInputSameBytes) {
  run({input_.path().string(), "-o", output_.string()});
  const std::vector<std::byte> first = readFile(output_);
  run({input_.path().string(), "-o", output_.string()});
  EXPECT_EQ(first, readFile(output_));
}

TEST_F(PrepCommand, ErrorsLeaveNoFile) {
  const TemporaryFile bad(".obj", "v nan 0 0\n");
  EXPECT_TRUE(contains(errorOf([&] { run({bad.path().string(), "-o", output_.string()}); }), "finite"));
  EXPECT_FALSE(std::filesystem::exists(output_));
  EXPECT_FALSE(errorOf([&] { run({input_.path().string(), "-o", "/no/such/folder/x.drc"}); }).empty());
}

TEST_F(PrepCommand, UsageErrorsAreThoseOfCli11) {
  EXPECT_THROW(run({input_.path().string()}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--crease", "200"}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--position-bits", "31"}), CLI::ParseError);
  EXPECT_THROW(run({input_.path().string(), "-o", output_.string(), "--weld", "-1"}), CLI::ParseError);
}

}  // namespace
}  // namespace malus::prep

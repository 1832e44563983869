#include "meshprep/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

Report example() {
  Report report;
  report.source = "a.obj";
  report.input.vertices = 36;
  report.input.faces = 12;
  report.output.vertices = 24;
  report.output.triangles = 11;
  report.steps = {{"vertices-welded", 28, {}},
                  {"faces-dropped-duplicate", 1, {{{}, {7, 3}, {1, 2, 3}, "", "a.obj:9"}}},
                  {"faces-flipped", 0, {}}};
  report.components = {{12, true, true, 0, 1.5, true, false, {}, 0}};
  return report;
}

TEST(Report, WritesAllFieldsAsJson) {
  Report report = example();
  nlohmann::json json = toJson(report);
  EXPECT_EQ(json["input"]["vertices"], 36);
  EXPECT_EQ(json["input"]["faces"], 12);
  EXPECT_EQ(json["output"]["vertices"], 24);
  EXPECT_EQ(json["output"]["triangles"], 11);
  ASSERT_EQ(json["steps"].size(), 3u);
  EXPECT_EQ(json["steps"][1]["name"], "faces-dropped-duplicate");
  EXPECT_EQ(json["steps"][1]["count"], 1);
  EXPECT_EQ(json["components"][0]["closed"], true);
  EXPECT_EQ(json["components"][0]["signedVolume"], 1.5);
  EXPECT_FALSE(json.contains("errors"));
  EXPECT_FALSE(json.contains("certificate"));
  EXPECT_FALSE(json["steps"][0].contains("findings"));
  const nlohmann::json finding = json["steps"][1]["findings"][0];
  EXPECT_EQ(finding["faces"], (std::vector<int>{7, 3}));
  EXPECT_EQ(finding["at"], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(finding["sourceLocation"], "a.obj:9");

  report.certificate = {true, {{2, "3 open edges", "first at a", "close it"}}};
  json = toJson(report);
  EXPECT_EQ(json["certificate"]["granted"], false);
  EXPECT_EQ(json["certificate"]["problems"][0]["component"], 2);
  EXPECT_TRUE(test::contains(toText(report), "component 2", "3 open edges", "first at a", "close it"));

  report.compression.method = "sequential";
  report.compression.sequentialReason = "edgebreaker is not smaller";
  report.compression.bytes = 330;
  report.compression.positionBits = 21;
  report.compression.normalBits = 13;
  report.compression.warnings = {"faces are tilted"};
  report.errors.positionMax = 1e-6;
  report.errors.normalMaxDegrees = 0.05;
  report.errors.tiltMaxDegrees = 0.25;
  json = toJson(report);
  EXPECT_EQ(json["errors"]["positionMax"], 1e-6);
  EXPECT_EQ(json["errors"]["normalMaxDegrees"], 0.05);
  EXPECT_EQ(json["errors"]["tiltMaxDegrees"], 0.25);
  EXPECT_EQ(json["compression"]["bytes"], 330);
  EXPECT_EQ(json["compression"]["bytesPerTriangle"], 30);
  EXPECT_EQ(json["compression"]["positionBits"], 21);
  const std::string text = toText(report);
  EXPECT_TRUE(test::contains(text, "30.00 per triangle")) << text;
  EXPECT_TRUE(test::contains(text, "sequential", "edgebreaker is not smaller")) << text;
  EXPECT_TRUE(test::contains(text, "21 positions, 13 normals")) << text;
  EXPECT_TRUE(test::contains(text, "tilt of a face", "0.25 degrees")) << text;
  EXPECT_TRUE(test::contains(text, "warning: faces are tilted")) << text;
}

TEST(Report, PrintsStepsWithFindings) {
  const std::string text = toText(example());
  EXPECT_TRUE(test::contains(text, "vertices ", " 36 ", " 24"));
  EXPECT_TRUE(test::contains(text, "faces-dropped-duplicate"));
  EXPECT_FALSE(test::contains(text, "faces-flipped"));
  EXPECT_TRUE(test::contains(text, "faces 7, 3", "(1, 2, 3)", "a.obj:9"));
  EXPECT_EQ(text.back(), '\n');
}

TEST(Report, CountsAStep) {
  EXPECT_EQ(example().count("vertices-welded"), 28u);
  EXPECT_EQ(example().count("no-such-step"), 0u);
}

}  // namespace
}  // namespace malus::prep

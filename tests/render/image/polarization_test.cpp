#include "render/image/polarization.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake/pack/writer.h"
#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/base/usage_error.h"
#include "render/cli.h"
#include "render/embree/renderer.h"
#include "render/image/output.h"
#include "render/reference/renderer.h"
#include "render/sweep_cli.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

namespace fs = std::filesystem;
using pack::MaterialKind;
constexpr double kPi = std::numbers::pi;
constexpr double kN = 1.5;
const double kBrewster = std::atan(kN) * 180 / kPi;
// R_s at Brewster's angle, where R_p = 0: ((1 - n^2) / (1 + n^2))^2.
constexpr double kBrewsterRs = (1 - kN * kN) / (1 + kN * kN) * ((1 - kN * kN) / (1 + kN * kN));

// A glass mirror at Brewster's angle under a white sky; the camera is rotated about its line of sight by `roll`
// degrees, clockwise as the photographer sees it, so that what it sees turns counter-clockwise.
pack::Scene brewsterMirror(double roll, std::uint32_t side = 1) {
  pack::Scene scene = test::emptyScene(4);
  scene.width = scene.height = side;
  scene.environment.radiance = glm::dvec3(1);
  test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, kN));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 10);
  const double a = kBrewster * kPi / 180, r = roll * kPi / 180;
  test::look(scene, {0, std::cos(a), std::sin(a)}, {0, 0, 0});
  pack::Camera& c = scene.camera;
  const glm::dvec3 right = c.right, up = c.up;
  c.right = right * std::cos(r) - up * std::sin(r);
  c.up = up * std::cos(r) + right * std::sin(r);
  return scene;
}

double green(const pack::Scene& scene, const render::Analyser& analyser, const char* method) {
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.analyser = analyser;
  return std::string(method) == "reference" ? reference::render(scene, parameters, 1).pixels[1]
                                            : embree::Renderer(scene, 1).render(method, parameters).pixels[1];
}

image::Image asImage(const pack::Scene& scene, const render::RenderResult& result) {
  pack::Pack pack;
  pack.scene = scene;
  return render::toImage(result, pack, render::defaultParameters(scene), "embree", "stokes");
}

TEST(Polarization, NumbersOfAStokesVector) {
  using render::angleOfLinearPolarization;
  using render::degreeOfLinearPolarization;
  EXPECT_DOUBLE_EQ(degreeOfLinearPolarization(2, 0.6, 0.8), 0.5);
  EXPECT_EQ(degreeOfLinearPolarization(1, 1, 1e-7), 1);  // rounding
  EXPECT_EQ(degreeOfLinearPolarization(0, 0, 0), 0);
  EXPECT_EQ(degreeOfLinearPolarization(-1, 1, 0), 0);
  EXPECT_EQ(degreeOfLinearPolarization(std::nan(""), 1, 0), 0);
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double f = degrees * kPi / 180;
    EXPECT_NEAR(angleOfLinearPolarization(std::cos(2 * f), std::sin(2 * f)), f, 1e-15) << degrees;
  }
  EXPECT_EQ(angleOfLinearPolarization(0, 0), 0);
  EXPECT_DOUBLE_EQ(angleOfLinearPolarization(-1, -0.0), kPi / 2);
  EXPECT_EQ(angleOfLinearPolarization(1, -0.0), 0);
  EXPECT_EQ(angleOfLinearPolarization(1, -1e-300), 0);  // pi itself is not in the range
  EXPECT_EQ(angleOfLinearPolarization(std::nan(""), 0), 0);
}

TEST(Polarization, ColourMapOfDolpRisesFromDarkToBright) {
  using render::dolpColour;
  using Colour = std::array<std::uint8_t, 3>;
  EXPECT_EQ(dolpColour(0), (Colour{68, 1, 84}));  // viridis' ends and middle
  EXPECT_EQ(dolpColour(1), (Colour{253, 231, 37}));
  EXPECT_NEAR(dolpColour(0.5)[0], 33, 2);
  EXPECT_NEAR(dolpColour(0.5)[1], 145, 2);
  EXPECT_NEAR(dolpColour(0.5)[2], 140, 2);
  EXPECT_EQ(dolpColour(7), dolpColour(1));
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = dolpColour(i / 100.0);
    const double luma = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
    EXPECT_GT(luma, before);
    before = luma;
  }
}

TEST(Polarization, ColourMapOfAolpGoesRoundAndFades) {
  using render::aolpColour;
  EXPECT_EQ(aolpColour(0, 1), aolpColour(kPi, 1));
  std::set<std::array<std::uint8_t, 3>> seen;
  for (int degrees = 0; degrees < 180; ++degrees) {
    const auto c = aolpColour(degrees * kPi / 180, 1), next = aolpColour((degrees + 1) * kPi / 180, 1);
    seen.insert(c);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(c[i] - next[i]), 8) << degrees;  // no jump
      EXPECT_TRUE(c[i] > 0 && c[i] < 255) << degrees;     // within sRGB
    }
    EXPECT_EQ(aolpColour(degrees * kPi / 180, 0), (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(aolpColour(degrees * kPi / 180, render::kAolpFadeDolp), c);
  }
  EXPECT_GT(seen.size(), 170u);
  const auto red = aolpColour(0, 1), green = aolpColour(kPi / 4, 1), cyan = aolpColour(kPi / 2, 1),
             violet = aolpColour(3 * kPi / 4, 1);
  EXPECT_GT(red[0], std::max(red[1], red[2]) + 60);
  EXPECT_GT(std::min(green[0], green[1]), green[2] + 60);
  EXPECT_GT(std::min(cyan[1], cyan[2]), cyan[0] + 60);
  EXPECT_GT(violet[2], violet[1] + 30);
}

TEST(Polarization, BrewsterMirrorIsWhollyPolarizedAlongItsPlane) {
  for (const double roll : {0.0, 20.0, 45.0, 90.0, 150.0}) {
    const pack::Scene scene = brewsterMirror(roll);
    for (const bool reference : {true, false}) {
      const render::RenderParameters parameters = render::defaultParameters(scene);
      const image::Image image =
          asImage(scene, reference ? reference::render(scene, parameters, 1)
                                   : embree::Renderer(scene, 1).render("stokes-linear", parameters));
      const image::Image dolp = render::dolpChannels(image), aolp = render::aolpChannels(image);
      EXPECT_EQ(dolp.channels, (std::vector<std::string>{"DoLP.R", "DoLP.G", "DoLP.B"}));
      EXPECT_EQ(aolp.channels, (std::vector<std::string>{"AoLP.R", "AoLP.G", "AoLP.B"}));
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(dolp.pixels[c], 1, 2e-6) << roll;
        const double off = std::abs(static_cast<double>(aolp.pixels[c]) - roll * kPi / 180);
        EXPECT_LT(std::min(off, kPi - off), 2e-6) << roll;
        EXPECT_LT(static_cast<double>(aolp.pixels[c]), kPi);
      }
      EXPECT_EQ(render::dolpColours(image), (std::vector<std::uint8_t>{253, 231, 37}));
    }
  }
}

TEST(Polarization, GreyOfTheColoursIsWeighted) {
  // Red fully polarized at 0, green unpolarized, blue fully at 90 degrees.
  image::Image image;
  image.width = image.height = 1;
  image.channels = {"S0.R", "S0.G", "S0.B", "S1.R", "S1.G", "S1.B", "S2.R", "S2.G", "S2.B"};
  image.pixels = {1, 1, 1, 1, 0, -1, 0, 0, 0};
  EXPECT_EQ(render::dolpChannels(image).pixels, (std::vector<float>{1, 0, 1}));
  EXPECT_EQ(render::aolpChannels(image).pixels, (std::vector<float>{0, 0, static_cast<float>(kPi / 2)}));
  const auto grey = render::luminanceStokes(image).front();
  EXPECT_NEAR(grey[0], 1, 1e-12);
  EXPECT_NEAR(grey[1], 0.2126 - 0.0722, 1e-12);
  image.channels[0] = "X";
  EXPECT_THROW(render::dolpChannels(image), Error);
}

TEST(Filters, CircularAnalyserSeesNoLinearState) {
  for (const double roll : {0.0, 30.0}) {
    const pack::Scene scene = brewsterMirror(roll);
    for (const render::Handedness hand : {render::Handedness::right, render::Handedness::left})
      for (const char* method : {"reference", "stokes", "stokes-linear", "sp", "fresnel"})
        EXPECT_NEAR(green(scene, render::circularAnalyser(hand), method), kBrewsterRs / 4, 2e-6) << method;
  }
}

TEST(Filters, WavePlateInFrontOfAPolarizerOverABrewsterMirror) {
  // Light along x, 1/2 R_s (1, 1, 0, 0). A quarter wave at 45 makes it circular: any polarizer passes half. A
  // half wave at a turns it to 2 a.
  const pack::Scene scene = brewsterMirror(0);
  for (const char* method : {"reference", "stokes", "stokes-linear"})
    for (const double f : {0.0, 30.0, 90.0}) {
      EXPECT_NEAR(green(scene, render::behindWavePlate(render::linearPolarizer(f), {45, 90}), method), kBrewsterRs / 4,
                  2e-6);
      for (const double a : {0.0, 20.0, 45.0})
        EXPECT_NEAR(green(scene, render::behindWavePlate(render::linearPolarizer(f), {a, 180}), method),
                    kBrewsterRs / 2 * std::pow(std::cos((2 * a - f) * kPi / 180), 2), 2e-6)
            << method << " " << f << " " << a;
      EXPECT_NEAR(green(scene, render::behindWavePlate(render::kNoFilter, {30, 90}), method), kBrewsterRs / 2, 2e-6);
    }
}

// Light of a white sky from a Brewster mirror to a gold mirror, whose planes of incidence are 45 degrees apart,
// to the camera. By hand: the glass sends 1/2 R_s (1, 1, 0, 0), which in the gold's frame is 1/2 R_s (1, 0, +-1, 0);
// gold, [[Re X, -Im X], [Im X, Re X]] on (S2, S3), makes S3 = +-1/2 R_s Im X of it.
TEST(Filters, GoldBehindGlassIsSeenByTheCircularAnalyser) {
  const glm::dvec3 eta(0.18, 0.54, 1.33), k(3.43, 2.23, 1.86);
  for (const double side : {1.0, -1.0}) {
    pack::Scene scene = test::emptyScene(4);
    scene.environment.radiance = glm::dvec3(1);
    test::addMaterial(scene, test::dielectric(MaterialKind::mirrorGlass, kN));
    test::addMaterial(scene, test::metal(eta, k));
    const double gold = 60 * kPi / 180, glass = kBrewster * kPi / 180;
    const glm::dvec3 in(0, 0, -1), n1(0, std::sin(gold), std::cos(gold)), d = in - 2 * glm::dot(in, n1) * n1;
    test::addSquare(scene, 1, {0, 0, 0}, n1, 0.5);
    const glm::dvec3 s = glm::normalize(glm::cross(d, n1)), t = glm::cross(s, d);
    const glm::dvec3 across = (t + s * side) / std::sqrt(2.0);
    test::addSquare(scene, 0, d * 5.0, -d * std::cos(glass) + across * std::sin(glass), 0.5);
    test::look(scene, {0, 0, 3}, {0, 0, 0});

    // Fresnel's equations of gold for green, with the index n - i k; written here anew.
    const std::complex<double> n(eta.y, -k.y), c(std::cos(gold)), sine2(std::sin(gold) * std::sin(gold));
    std::complex<double> root = std::sqrt(n * n - sine2);
    if (root.imag() > 0) root = -root;
    const std::complex<double> rs = (c - root) / (c + root), rp = (n * n * c - root) / (n * n * c + root);
    const double a = (std::norm(rs) + std::norm(rp)) / 2, xIm = (rp * std::conj(rs)).imag();
    const double right = green(scene, render::circularAnalyser(render::Handedness::right), "reference"),
                 left = green(scene, render::circularAnalyser(render::Handedness::left), "reference");
    EXPECT_NEAR(right + left, kBrewsterRs / 2 * a, 1e-6);
    EXPECT_NEAR(std::abs(right - left), kBrewsterRs / 2 * std::abs(xIm), 1e-6);
    EXPECT_GT(std::abs(right - left), 0.02);
    // In the gold's frame, x = s and y = t, the glass's plane of incidence is along t + side s, so its light is
    // along s - side t: S2 = -side, of which gold makes S3 = Im X S2.
    EXPECT_EQ(right > left, -side * xIm > 0);
    for (const render::Handedness hand : {render::Handedness::right, render::Handedness::left}) {
      const render::Analyser direct = render::circularAnalyser(hand);
      EXPECT_NEAR(green(scene, direct, "stokes"), hand == render::Handedness::right ? right : left, 2e-6);
      // Without S3 it sees half of the light.
      EXPECT_NEAR(green(scene, direct, "stokes-linear"), kBrewsterRs / 4 * a, 2e-6);
      // The same filter made of a plate and a polarizer, at any axis.
      for (const double axis : {0.0, 33.0})
        EXPECT_NEAR(
            green(scene,
                  render::behindWavePlate(
                      render::linearPolarizer(axis + (hand == render::Handedness::right ? 45 : -45)), {axis, 90}),
                  "stokes"),
            green(scene, direct, "stokes"), 1e-6);
    }
  }
}

// ---- The commands ----

struct Outcome {
  std::string out, warnings;
};
Outcome run(std::vector<std::string> arguments) {
  CLI::App app;
  render::addRenderCommand(app);
  render::addSweepCommand(app);
  std::reverse(arguments.begin(), arguments.end());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  try {
    app.parse(arguments);
  } catch (...) {
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
    throw;
  }
  std::fflush(stdout);
  Outcome outcome;
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.warnings = testing::internal::GetCapturedStderr();
  return outcome;
}

class FilterCommands : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("malus_filters_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    pack::write(pack(), brewsterMirror(0, 4), {});
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string pack() const { return file("mirror.pack"); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  // The message of a usage error, and nothing written.
  std::string usage(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", pack()});
    return usageError(arguments);
  }
  std::string usageError(const std::vector<std::string>& arguments) {
    std::string message = "no usage error";
    try {
      run(arguments);
    } catch (const CLI::ParseError& error) {
      message = error.what();
    } catch (const UsageError& error) {
      message = error.what();
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "files beside the pack: " << message;
    return message;
  }
  double greenIn(const std::string& name) const {
    const image::Image image = image::read(file(name));
    return image.pixels[static_cast<std::size_t>(image.channel("G"))];
  }
  fs::path folder_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(FilterCommands, RenderPutsTheFilterInFront) {
  const std::string out = file("a.exr");
  const auto rendered = [&](std::vector<std::string> filter) {
    filter.insert(filter.begin(), {"render", pack(), "--method", "stokes", "-o", out});
    EXPECT_EQ(run(filter).warnings, "");
    return greenIn("a.exr");
  };
  EXPECT_NEAR(rendered({"--polarizer", "0"}), kBrewsterRs / 2, 3e-5);
  EXPECT_NEAR(rendered({"--polarizer", "90"}), 0, 3e-5);
  EXPECT_NEAR(rendered({"--analyser", "right"}), kBrewsterRs / 4, 3e-5);
  EXPECT_NEAR(rendered({"--polarizer", "90", "--wave-plate", "45,180"}), kBrewsterRs / 2, 3e-5);
  EXPECT_NEAR(rendered({"--polarizer", "90", "--wave-plate", "-45,+180"}), kBrewsterRs / 2, 3e-5);
  EXPECT_NEAR(rendered({"--polarizer=90", "--wave-plate=45"}), kBrewsterRs / 4, 3e-5);
}

TEST_F(FilterCommands, RenderWarnsOfLightThatAMethodDoesNotCarry) {
  const auto warnings = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", pack(), "-o", file("a.exr")});
    return run(more).warnings;
  };
  EXPECT_TRUE(has(warnings({"--method", "stokes-linear", "--analyser", "left"}), "S3"));
  EXPECT_NEAR(greenIn("a.exr"), kBrewsterRs / 4, 3e-5);
  EXPECT_TRUE(has(warnings({"--method", "fresnel", "--polarizer", "30"}), "S1, S2"));
  EXPECT_TRUE(has(warnings({"--method", "schlick", "--polarizer", "30", "--wave-plate", "0"}), "S1, S2, S3"));
  EXPECT_TRUE(has(warnings({"--method", "sp", "--polarizer", "45", "--wave-plate", "0"}), "S3"));
  EXPECT_TRUE(has(warnings({"--method", "stokes", "--wave-plate", "0"}), "no intensity"));
  EXPECT_EQ(warnings({"--method", "sp", "--polarizer", "45"}), "");
  EXPECT_EQ(warnings({"--backend", "reference", "--analyser", "left"}), "");
  EXPECT_EQ(warnings({"--method", "fresnel"}), "");
}

TEST_F(FilterCommands, RenderRefusesImpossibleCombinations) {
  const std::string out = file("a.png");
  EXPECT_TRUE(has(usage({"-o", out, "--method", "stokes", "--polarizer", "0", "--analyser", "right"}), "linear"));
  EXPECT_TRUE(has(usage({"-o", out, "--analyser", "up"}), "right"));
  for (const char* plate : {"x", "", "1,", ",1", "1,2,3", "nan", "1,inf", "1 2", "1e999"})
    EXPECT_TRUE(has(usage({"-o", out, "--polarizer", "0", "--wave-plate", plate}), "AXIS[,RETARDANCE]")) << plate;
  EXPECT_TRUE(has(usage({}), "no image"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--output-dolp", file("d.jpg")}), ".exr or .png"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--mosaic", file("m.exr")}), ".png or .tif"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--output-dolp", out, "--output-aolp", out}), "same file"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--mosaic", out, "--polarizer", "0"}), "every pixel"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--mosaic", out, "--mosaic-bits", "10"}), "12"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "--mosaic", out, "--width", "3"}), "even"));
  EXPECT_TRUE(has(usage({"--method", "stokes", "-o", out, "--mosaic-bits", "8"}), "--mosaic"));
  for (const char* option : {"--output-dolp", "--output-aolp", "--mosaic"})
    for (const char* method : {"fresnel", "sp", "sp-malus"}) {
      const std::string message = usage({option, out, "--method", method});
      for (const char* part : {option, "stokes", "stokes-linear", "--backend reference"})
        EXPECT_TRUE(has(message, part)) << message;
    }
}

TEST_F(FilterCommands, RenderWritesPolarizationAndMosaic) {
  run({"render", pack(), "--method", "stokes", "--output-dolp", file("d.exr"), "--output-aolp", file("a.exr"),
       "--mosaic", file("m.png"), "--mosaic-bits", "12", "--mosaic-channel", "G", "--exposure", "1"});
  const image::Image d = image::read(file("d.exr")), a = image::read(file("a.exr")), m = image::read(file("m.png"));
  EXPECT_NEAR(d.pixels[static_cast<std::size_t>(d.channel("DoLP.G"))], 1, 1e-4);
  const double off = a.pixels[static_cast<std::size_t>(a.channel("AoLP.G"))];
  EXPECT_LT(std::min(off, kPi - off), 1e-3);
  // 1/2 R_s along x, times 2: rows 90 45 / 135 0.
  const double full = kBrewsterRs * 4095;
  const double expected[] = {0, full / 2, 0, full / 2, full / 2, full};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(m.pixels[i] * 65535, expected[i], 1) << i;
  run({"render", pack(), "--backend", "reference", "--output-dolp", file("d.png"), "--output-aolp", file("a.png")});
  EXPECT_NEAR(image::read(file("d.png")).pixels[0] * 255, 253, 1);
  const auto red = render::aolpColour(0, 1);
  EXPECT_NEAR(image::read(file("a.png")).pixels[0] * 255, red[0], 1);
}

TEST_F(FilterCommands, SweepTurnsAPolarizer) {
  const Outcome outcome =
      run({"sweep", pack(), "-o", file("frames"), "--frames", "12", "--width", "2", "--exposure", "2", "--json"});
  const nlohmann::json json = nlohmann::json::parse(readTextFile(folder_ / "frames" / "sweep.json"));
  EXPECT_EQ(nlohmann::json::parse(outcome.out), json);
  EXPECT_EQ(json["method"], "stokes-linear");  // a single mirror reflects no circular light
  EXPECT_TRUE(has(json["substitutedFor"].get<std::string>(), "stokes"));
  EXPECT_EQ(json["exposureEv"], 2);
  ASSERT_EQ(json["frames"].size(), 12u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "frames"), {}), 13);
  for (int i = 0; i < 12; ++i) {
    const nlohmann::json& frame = json["frames"][static_cast<std::size_t>(i)];
    EXPECT_DOUBLE_EQ(frame["degrees"].get<double>(), i * 15.0);
    const image::Image shown = image::read(folder_ / "frames" / frame["file"].get<std::string>());
    EXPECT_EQ(shown.width, 2);
    // Malus's law, then two stops and the sRGB curve; below the shoulder of the display curve.
    const double x = 4 * kBrewsterRs / 2 * std::pow(std::cos(i * 15.0 * kPi / 180), 2);
    EXPECT_NEAR(shown.pixels[1] * 255, 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055), 1)
        << i;
  }
  // A shorter sweep into the same folder warns of frames that are left.
  EXPECT_TRUE(has(run({"sweep", pack(), "-o", file("frames"), "--frames", "3"}).warnings, "frame-003.png"));
}

TEST_F(FilterCommands, SweepRefusesBadInput) {
  EXPECT_TRUE(has(usageError({"sweep", pack(), "-o", file("frames"), "--frames", "0"}), "frames"));
  EXPECT_TRUE(has(usageError({"sweep", pack(), "-o", file("frames"), "--method", "fresnel"}), "--backend reference"));
  EXPECT_TRUE(has(usageError({"sweep", pack()}), "--output"));
  EXPECT_THROW(run({"sweep", pack(), "-o", pack()}), Error);  // a file
  EXPECT_THROW(run({"sweep", file("none.pack"), "-o", file("frames")}), Error);
  EXPECT_THROW(run({"sweep", pack(), "-o", file("frames"), "--region", "0", "0", "9", "9"}), Error);
  EXPECT_FALSE(fs::exists(folder_ / "frames"));
}

TEST_F(FilterCommands, SweepThatFailsLeavesWholeFilesAndNoList) {
  run({"sweep", pack(), "-o", file("frames"), "--frames", "2"});
  const fs::path frames = folder_ / "frames";
  fs::remove(frames / "frame-001.png");
  fs::create_directory(frames / "frame-001.png");  // cannot be replaced by a file
  EXPECT_THROW(run({"sweep", pack(), "-o", frames.string(), "--frames", "4"}), Error);
  EXPECT_FALSE(fs::exists(frames / "sweep.json"));
  for (const auto& entry : fs::directory_iterator(frames)) {
    if (entry.is_regular_file()) {
      EXPECT_NO_THROW(image::read(entry.path())) << entry.path();
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(frames), {}), 2);
}

}  // namespace
}  // namespace malus

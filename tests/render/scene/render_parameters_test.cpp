#include "render/scene/render_parameters.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace malus::render {
namespace {

TEST(RenderParameters, LinearPolarizerIsHalfAndTurnsByTwiceItsAngle) {
  EXPECT_NEAR(linearPolarizer(0)[1], 0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(90)[1], -0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(45)[2], 0.5, 1e-15);
  EXPECT_NEAR(linearPolarizer(-45)[2], -0.5, 1e-15);
  for (const double degrees : {0.0, 17.0, 90.0, 133.0}) {
    const Analyser a = linearPolarizer(degrees), b = linearPolarizer(degrees + 180);
    EXPECT_EQ(a[0], 0.5);
    EXPECT_NEAR(std::hypot(a[1], a[2]), 0.5, 1e-15);
    EXPECT_EQ(a[3], 0);
    EXPECT_NEAR(a[1], b[1], 1e-14);
    EXPECT_NEAR(a[2], b[2], 1e-14);
  }
}

// Mueller matrices as one writes them, for the rows of the analysers.
using Matrix = std::array<std::array<double, 4>, 4>;
constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
Matrix turn(double degrees) {
  const double c = std::cos(2 * radians(degrees)), s = std::sin(2 * radians(degrees));
  return {{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}}};
}
Matrix horizontalPolarizer() { return {{{0.5, 0.5, 0, 0}, {0.5, 0.5, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}; }
Matrix retarder(double degrees) {
  const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
  return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, c, s}, {0, 0, -s, c}}};
}
Matrix about(double degrees, const Matrix& m) { return product(turn(-degrees), product(m, turn(degrees))); }
Matrix circular(double sign) {
  return {{{0.5, 0, 0, 0.5 * sign}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0.5 * sign, 0, 0, 0.5}}};
}

void expectRow(const Analyser& row, const Matrix& m) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(row[i], m[0][i], 2e-15) << "component " << i;
}

TEST(RenderParameters, AnalysersAreFirstRowsOfTheirMuellerMatrices) {
  expectRow(circularAnalyser(Handedness::right), circular(1));
  expectRow(circularAnalyser(Handedness::left), circular(-1));
  for (const double f : {0.0, 22.5, 45.0, 61.0, 90.0, 135.0, -30.0}) {
    expectRow(linearPolarizer(f), about(f, horizontalPolarizer()));
    for (const double axis : {0.0, 15.0, 45.0, 90.0, -70.0, 210.0})
      for (const double delay : {90.0, 180.0, 33.0, -90.0, 0.0, 450.0}) {
        const Matrix plate = about(axis, retarder(delay));
        SCOPED_TRACE(testing::Message() << "filter " << f << " axis " << axis << " retardance " << delay);
        expectRow(behindWavePlate(linearPolarizer(f), {axis, delay}), product(about(f, horizontalPolarizer()), plate));
        expectRow(behindWavePlate(circularAnalyser(Handedness::left), {axis, delay}), product(circular(-1), plate));
      }
  }
}

TEST(RenderParameters, QuarterWaveInFrontOfALinearPolarizerPassesCircularLight) {
  const Analyser right{0.5, 0, 0, 0.5}, left{0.5, 0, 0, -0.5};
  EXPECT_EQ(behindWavePlate(linearPolarizer(45), {}), right);  // exactly: no trace of the other components
  EXPECT_EQ(behindWavePlate(linearPolarizer(-45), {}), left);
  EXPECT_EQ(behindWavePlate(linearPolarizer(45), {90, 90}), left);
  EXPECT_EQ(behindWavePlate(linearPolarizer(45), {0, -90}), left);
  // A half wave mirrors the polarizer about its axis.
  EXPECT_EQ(behindWavePlate(linearPolarizer(0), {45, 180}), linearPolarizer(90));
}

TEST(RenderParameters, PlateAloneChangesNothing) {
  for (const double axis : {0.0, 30.0, 90.0}) EXPECT_EQ(behindWavePlate(kNoFilter, {axis, 90}), kNoFilter);
}

}  // namespace
}  // namespace malus::render

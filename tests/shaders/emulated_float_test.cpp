// The emulation itself: it stays within the specification's bounds, reaches them, and without them is IEEE arithmetic.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using emulation::Choice;
using emulation::device;
using emulation::Float;

// Range of the results of `operation` over many choices, in units of `unit` around `exact`.
template <class F>
std::pair<double, double> measureRange(F operation, double exact, double unit) {
  double low = 1e9, high = -1e9;
  const auto add = [&](float x) {
    low = std::min(low, (double(x) - exact) / unit);
    high = std::max(high, (double(x) - exact) / unit);
  };
  device.choose(Choice::random, 7);
  for (int i = 0; i < 4000; ++i) add(operation());
  for (const Choice choice : {Choice::largest, Choice::smallest}) {
    device.choose(choice, 7);
    add(operation());
  }
  return {low, high};
}

void expectRange(std::pair<double, double> range, double bound, double reached, const char* what) {
  EXPECT_GE(range.first, -bound) << what;
  EXPECT_LE(range.second, bound) << what;
  EXPECT_LE(range.first, -reached) << what;
  EXPECT_GE(range.second, reached) << what;
}

TEST(EmulatedFloatTest, ErrorsAreWithinTheBoundsAndReachThem) {
  using emulation::unitInLastPlace;
  const auto ulps = [](auto operation, double exact) { return measureRange(operation, exact, unitInLastPlace(exact)); };
  const Float x(1.1f), y(1.7f);
  const double a = x.value, b = y.value;
  expectRange(ulps([&] { return (x + y).value; }, a + b), 1, 0.01, "sum");
  expectRange(ulps([&] { return (x * y).value; }, a * b), 1, 0.01, "product");
  expectRange(ulps([&] { return (x / y).value; }, a / b), 2.5, 1.5, "quotient");
  expectRange(ulps([&] { return emulation::squareRoot(y.value); }, std::sqrt(b)), 6.5, 3, "root");
  expectRange(ulps([&] { return emulation::exponential(-3.7f); }, std::exp(double(-3.7f))), 3 + 2 * 3.71, 9, "exp");
  expectRange(ulps([&] { return emulation::logarithm(0.1f); }, std::log(double(0.1f))), 3, 2, "log");
  expectRange(measureRange([] { return emulation::logarithm(1.0f); }, 0, 0x1p-21), 1, 0.9, "log near 1");
  // A half has 11 bits.
  expectRange(measureRange([] { return emulation::unpackHalf(emulation::packHalf(0.7f)); }, double(0.7f), 0x1p-11), 1,
              0.1, "half");
}

TEST(EmulatedFloatTest, ExactResultsAndSpecialValues) {
  const float infinity = std::numeric_limits<float>::infinity(), denormal = 1e-40f;
  for (const Choice choice : {Choice::random, Choice::largest, Choice::smallest}) {
    device.choose(choice, 8);
    EXPECT_EQ((Float(1) + Float(0.5)).value, 1.5f);
    EXPECT_EQ((Float(3) * Float(0.25)).value, 0.75f);
    EXPECT_EQ((Float(0) / Float(3)).value, 0);
    EXPECT_EQ((Float(1) / Float(0)).value, infinity);
    EXPECT_EQ((Float(-1) / Float(0)).value, -infinity);
    EXPECT_TRUE(std::isnan((Float(0) / Float(0)).value));
    EXPECT_EQ(emulation::squareRoot(0), 0);
    EXPECT_TRUE(std::isnan(emulation::squareRoot(-1)));
    EXPECT_EQ(emulation::exponential(-1000), 0);
    EXPECT_EQ(emulation::logarithm(0), -infinity);
    EXPECT_EQ(emulation::unpackFraction(emulation::packFraction(0)), 0);
    EXPECT_LE(emulation::unpackFraction(emulation::packFraction(1)), 1);
  }
  device.choose(Choice::largest, 8);
  EXPECT_EQ((Float(denormal) + Float(0)).value, 0) << "flushed";
  EXPECT_FALSE(Float(0) < Float(denormal));
}

TEST(EmulatedFloatTest, ProductsAreContractedAtRandom) {
  device.choose(Choice::random, 9);
  // a^2 - round(a^2) is 0 with two roundings of the same direction, and the rounding error if contracted.
  const Float a(1 + 0x1p-12f + 0x1p-20f);
  int fused = 0, separate = 0;
  for (int i = 0; i < 1000; ++i) {
    const Float product = a * a;
    const float rest = (product - Float(product.value)).value;
    (rest == 0 ? separate : fused) += 1;
    EXPECT_LE(std::abs(rest), 0x1p-23f);
  }
  EXPECT_GT(fused, 200);
  EXPECT_GT(separate, 200);
}

TEST(EmulatedFloatTest, SameSeedSameResults) {
  const auto run = [](std::uint64_t seed) {
    device.choose(Choice::random, seed);
    Float x(0.7);
    for (int i = 0; i < 100; ++i) x = x / Float(1.3) * Float(1.3);
    return x.value;
  };
  const float first = run(1);
  EXPECT_NE(run(2), first);
  EXPECT_EQ(run(1), first);
}

// The forms that the optics avoid lose their digits here, so that a test on this type detects them.
TEST(EmulatedFloatTest, UnstableFormsAreDetected) {
  device.choose(Choice::random, 10);
  double plain = 0, stable = 0;
  for (int i = 0; i < 1000; ++i) {
    // 1 - R^2 at grazing incidence, and T (2 - T).
    const Float t(1e-6f * static_cast<float>(1 + i % 7)), r = Float(1) - t;
    const double transmitted = t.value, want = transmitted * (2 - transmitted);
    plain = std::max(plain, std::abs(double((Float(1) - r * r).value) / want - 1));
    stable = std::max(stable, std::abs(double((t * (Float(2) - t)).value) / want - 1));
  }
  EXPECT_GT(plain, 1e-2);
  EXPECT_LT(stable, 4 * double(std::numeric_limits<float>::epsilon()));
}

// Without the specification's freedom it is the float build, bit by bit.
TEST(EmulatedFloatTest, IeeeChoiceEqualsTheFloatBuild) {
  static constexpr char kLabel[] = "ieee";
  using O = EmulatedOptics<EmulatedDevice<Choice::ieee, 0>, kLabel>;
  Draw draw(40);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&](double a, double b) { return static_cast<float>(draw.between(a, b)); };
    const float c = number(0, 1), n1 = number(1, 2), n2 = number(0.1, 3), k = number(0, 4);
    const auto r = O::conductorReflectance(c, n1, n2, k), want = f32::conductorReflectance(c, n1, n2, k);
    ASSERT_TRUE(r.rs == want.rs && r.rp == want.rp && r.xRe == want.xRe && r.xIm == want.xIm);
    const auto film = O::thinFilm(c, n1, n2 + 1, k, n2, k).through,
               filmWant = f32::thinFilm(c, n1, n2 + 1, k, n2, k).through;
    ASSERT_TRUE(film.rs == filmWant.rs && film.xIm == filmWant.xIm);
    const auto d = toReal3<F32>(draw.direction()), n = toReal3<F32>(draw.direction());
    ASSERT_EQ(O::sDirection(d, n), f32::sDirection(d, n));
    float cos2, sin2, cosWant, sinWant;
    O::cameraFrameRotation(d, n, cos2, sin2);
    f32::cameraFrameRotation(d, n, cosWant, sinWant);
    ASSERT_TRUE(cos2 == cosWant && sin2 == sinWant);
  }
}

}  // namespace
}  // namespace malus::test

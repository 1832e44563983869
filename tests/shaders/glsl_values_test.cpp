// The optics compiled by glslang and run on the device, in float and in double, against the C++ build: one
// compute shader calls every function (values.h), C++ calls the same. No device is a failure, and so is any
// message of the validation layers.
#include <cstdlib>
#include <cstring>

#include "render/vulkan/glsl_compiler.h"
#include "shaders/sources.h"
#include "tests/shaders/compute_device.h"
#include "tests/shaders/optics_types.h"
#include "tests/shaders/values_source.h"

#include "shaders/optics/language_begin.h"
namespace malus::f32 {
#include "tests/shaders/values.h"
}
namespace malus::f64 {
#include "tests/shaders/values.h"
}
#include "shaders/optics/language_end.h"

namespace malus::test {
namespace {

constexpr const char* kText =
    "#version 460\n"
    "#include \"shaders/gpu/language.glsl\"\n"
    "#include \"shaders/optics/math.h\"\n"
    "#include \"shaders/optics/all.h\"\n"
    "#include \"tests/shaders/values.h\"\n"
    "layout(local_size_x = 64) in;\n"
    "layout(set = 0, binding = 0, scalar) readonly buffer Input { Given given[]; };\n"
    "layout(set = 0, binding = 1, scalar) writeonly buffer Output { Values values[]; };\n"
    "void main() { uint i = gl_GlobalInvocationID.x; if (i < given.length()) values[i] = computeValues(given[i]); }\n";

struct Single {
  using real = float;
  using real3 = f32::real3;
  using Given = f32::Given;
  using Values = f32::Values;
  static Values values(const Given& g) { return f32::computeValues(g); }
  static constexpr const char* kMacros = "";
};
struct Double {
  using real = double;
  using real3 = f64::real3;
  using Given = f64::Given;
  using Values = f64::Values;
  static Values values(const Given& g) { return f64::computeValues(g); }
  static constexpr const char* kMacros = "#define MALUS_DOUBLE\n";
};

// Thousands of inputs: random ones, and every special cosine with every special pair of indices.
template <class T>
std::vector<typename T::Given> inputs() {
  using real = typename T::real;
  using real3 = typename T::real3;
  Draw draw(60);
  std::vector<typename T::Given> list;
  const auto direction = [&] {
    const oracle::Vec d = draw.direction();
    return real3(static_cast<real>(d[0]), static_cast<real>(d[1]), static_cast<real>(d[2]));
  };
  const auto filled = [&] {
    typename T::Given g;
    g.c = static_cast<real>(draw.unit());
    g.n1 = static_cast<real>(draw.between(1, 2.5));
    g.n2 = static_cast<real>(draw.between(0.05, 2.5));
    g.k2 = static_cast<real>(draw.between(0, 4));
    g.d = direction();
    g.n = direction();
    g.interpolated = g.n + direction() * real(0.5);
    g.radiance = real3(static_cast<real>(draw.unit()), static_cast<real>(draw.unit()), static_cast<real>(draw.unit()));
    const double a = draw.between(0, 6.3);
    g.cos2 = static_cast<real>(std::cos(a));
    g.sin2 = static_cast<real>(std::sin(a));
    return g;
  };
  const real next = std::nextafter(real(1), real(0)), half = static_cast<real>(std::sqrt(0.5));
  const double pairs[][2] = {{1, 1.5},     {1.5, 1},    {1.5, 1.5},  {1, 1.0001},
                             {1.25, 0.75}, {1e-3, 1e3}, {1e3, 1e-3}, {10, 1e-3}};
  for (const real c :
       {real(0), real(1e-6), real(0.5), static_cast<real>(1 / std::sqrt(3.25)), half, real(0.8), next, real(1)})
    for (const auto& pair : pairs)
      for (const double k : {0.0, 1e-4, 1.0, 1e3}) {
        typename T::Given g = filled();
        g.c = c;
        g.n1 = static_cast<real>(pair[0]);
        g.n2 = static_cast<real>(pair[1]);
        g.k2 = static_cast<real>(k);
        list.push_back(g);
      }
  const real3 axes[] = {
      {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {real(0.6), real(0.8), real(-0.0)}};
  for (const real3& d : axes)
    for (const real3& n : axes) {
      typename T::Given g = filled();
      g.d = d;
      g.n = n;
      list.push_back(g);
    }
  while (list.size() < 4000) list.push_back(filled());
  return list;
}

// The numbers of a struct, one after the other.
template <class T, class S>
std::vector<typename T::real> numbers(const S& s) {
  std::vector<typename T::real> list(sizeof(S) / sizeof(typename T::real));
  std::memcpy(list.data(), &s, sizeof(S));
  return list;
}

template <class T>
void compare(const ComputeDevice& device) {
  using real = typename T::real;
  using Given = typename T::Given;
  using Values = typename T::Values;
  const std::string preamble = std::string(
                                   "#extension GL_EXT_scalar_block_layout : require\n"
                                   "#extension GL_GOOGLE_include_directive : require\n") +
                               T::kMacros;
  const auto spirv = vulkan::compileGlsl(kText, preamble, vulkan::Stage::compute, "values", [](std::string_view path) {
    return path == "tests/shaders/values.h" ? kValuesSource : shaders::source(path);
  });
  const std::vector<Given> given = inputs<T>();
  std::vector<std::byte> bytes(given.size() * sizeof(Given));
  std::memcpy(bytes.data(), given.data(), bytes.size());
  const auto groups = static_cast<std::uint32_t>((given.size() + 63) / 64);
  const std::vector<std::byte> output = device.run(spirv, bytes, given.size() * sizeof(Values), groups);

  constexpr real kEps = std::numeric_limits<real>::epsilon();
  Worst worst(std::string("values") + (sizeof(real) == 4 ? "Float" : "Double"), double(kEps));
  std::size_t different = 0;
  Draw draw(61);
  for (std::size_t i = 0; i < given.size(); ++i) {
    Values onDevice;
    std::memcpy(&onDevice, output.data() + i * sizeof(Values), sizeof(Values));
    const auto got = numbers<T>(onDevice), want = numbers<T>(T::values(given[i]));
    if (got == want) continue;
    // Effect of rounded inputs on each number: a device's division may have an error of 2.5 ulp, magnified where
    // the optics is ill conditioned (critical angle, normal incidence).
    std::vector<real> spread(want.size(), real(0));
    for (int trial = 0; trial < 24; ++trial) {
      auto moved = numbers<T>(given[i]);
      for (real& v : moved) v *= 1 + real(2) * kEps * static_cast<real>(draw.between(-1, 1));
      moved[0] = std::min(moved[0], real(1));
      Given near;
      std::memcpy(&near, moved.data(), sizeof(near));
      const auto values = numbers<T>(T::values(near));
      for (std::size_t j = 0; j < want.size(); ++j) spread[j] = std::max(spread[j], std::abs(values[j] - want[j]));
    }
    for (std::size_t j = 0; j < want.size(); ++j) {
      if (got[j] == want[j] || (std::isnan(got[j]) && std::isnan(want[j]))) continue;
      ++different;
      const real beyond = std::abs(got[j] - want[j]) - 2 * spread[j];
      if ((beyond > 0 || std::isnan(beyond)) && j + 2 < want.size())
        worst.add(beyond / std::max(std::abs(want[j]), real(1)));
      // The last two numbers are decoded from 16 bits, where a tie may round to the next step.
      const real allowed = j + 2 < want.size() ? 16 * kEps : real(0x1p-10);
      EXPECT_LE(beyond, allowed * std::max(std::abs(want[j]), real(1)))
          << "input " << i << ", number " << j << ": " << got[j] << " on the device, " << want[j] << " in C++";
      EXPECT_FALSE(std::isnan(got[j])) << "input " << i << ", number " << j;
    }
    if (::testing::Test::HasFailure()) return;
  }
  ::testing::Test::RecordProperty("different", std::to_string(different));
}

TEST(GlslValuesTest, FloatAndDoubleEqualCpp) {
  // The bundle has no validation layers, and its devices may lack double arithmetic.
  const bool inBundle = std::getenv("MALUS_IN_BUNDLE") != nullptr;
  ASSERT_TRUE(inBundle || std::getenv("MALUS_VALIDATION") != nullptr) << "ctest sets it";
  const vulkan::Instance instance(0);
  ASSERT_TRUE(inBundle || instance.isValidating());
  {
    const ComputeDevice device(instance);
    compare<Single>(device);
    ASSERT_TRUE(inBundle || device.hasDouble());
    if (device.hasDouble()) compare<Double>(device);
  }
  EXPECT_NO_THROW(instance.requireNoMessages());
}

}  // namespace
}  // namespace malus::test

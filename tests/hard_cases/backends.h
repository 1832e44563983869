// Backends of the optics: float and double, compiled as C++ and by glslang for the device. A typed test runs on all
// four. With MALUS_EMULATED_PRECISION: the precision that the Vulkan specification guarantees, emulated.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "shaders/methods/methods.h"
#include "tests/shaders/chains.h"

#define GIVEN_PARAMETER(T) const T& given
#define GIVEN given
#include "shaders/optics/language_begin.h"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace malus::f32 {
#include "tests/hard_cases/probes.h"

#include "tests/hard_cases/iterative_probe.h"

#include "hard_case_methods.h"
}  // namespace malus::f32
namespace malus::f64 {
#include "tests/hard_cases/probes.h"

#include "tests/hard_cases/iterative_probe.h"

#include "hard_case_methods.h"
}  // namespace malus::f64
#ifdef MALUS_EMULATED_PRECISION
namespace malus::emulated {
#include "tests/hard_cases/probes.h"

#include "tests/hard_cases/iterative_probe.h"

#include "hard_case_methods.h"
}  // namespace malus::emulated
#endif
#pragma GCC diagnostic pop
#include "shaders/optics/language_end.h"
#undef GIVEN_PARAMETER
#undef GIVEN

namespace malus::test {

// Runs a probe on the device that MALUS_DEVICE names: `call` names its function, `method` the method that the
// probe's text needs ("" for none). Input and output are arrays of the probe's structs. Throws Error.
std::vector<std::byte> runOnDevice(bool doublePrecision, std::string_view method, std::string_view in,
                                   std::string_view out, std::string_view call, const std::vector<std::byte>& input,
                                   std::size_t outputBytes, std::size_t count);

template <class Out, class In>
std::vector<Out> onDevice(bool doublePrecision, std::string_view method, std::string_view in, std::string_view out,
                          std::string_view call, const std::vector<In>& given) {
  std::vector<std::byte> bytes(given.size() * sizeof(In));
  std::memcpy(bytes.data(), given.data(), bytes.size());
  const std::vector<std::byte> output =
      runOnDevice(doublePrecision, method, in, out, call, bytes, given.size() * sizeof(Out), given.size());
  std::vector<Out> result(given.size());
  std::memcpy(result.data(), output.data(), output.size());
  return result;
}

template <class Out, class In, class F>
std::vector<Out> mapped(const std::vector<In>& given, F f) {
  std::vector<Out> result;
  result.reserve(given.size());
  for (const In& g : given) result.push_back(f(g));
  return result;
}

// Names of the methods, from the list in shaders/CMakeLists.txt.
inline std::vector<std::string> everyMethod() {
  std::vector<std::string> names;
#define MALUS_NAME(M) names.emplace_back(f32::M::kName);
  MALUS_FOR_EACH_METHOD(MALUS_NAME)
#undef MALUS_NAME
  return names;
}

// kRoundings: how many times the roundings of IEEE arithmetic are allowed; a device's division and root may be
// 2.5 ulp off (Vulkan specification, precision of SPIR-V instructions). kPackingRoundings: the same for 16 bits;
// kFlushesHalves: denormal halves may become 0; kInterfaces: number of random interfaces.
#define MALUS_BACKEND(Name, Optics, space, isDouble)                                                       \
  struct Cpp##Name : Optics {                                                                              \
    static constexpr const char* kBackend = "Cpp" #Name;                                                   \
    static constexpr double kPackingRoundings = 1;                                                         \
    static constexpr bool kFlushesHalves = false;                                                          \
    static constexpr std::size_t kInterfaces = 1000000;                                                    \
    static constexpr double kRoundings = 1;                                                                \
    using SurfaceIn = space::SurfaceIn;                                                                    \
    using SurfaceOut = space::SurfaceOut;                                                                  \
    using FrameIn = space::FrameIn;                                                                        \
    using FrameOut = space::FrameOut;                                                                      \
    using BounceIn = space::BounceIn;                                                                      \
    using ChainIn = space::ChainIn;                                                                        \
    using ChainOut = space::ChainOut;                                                                      \
    using IterativeIn = space::IterativeIn;                                                                \
    using IterativeOut = space::IterativeOut;                                                              \
    using HandOverIn = space::HandOverIn;                                                                  \
    using HandOverOut = space::HandOverOut;                                                                \
    static std::vector<SurfaceOut> surfaces(const std::vector<SurfaceIn>& g) {                             \
      return mapped<SurfaceOut>(g, space::surfaceProbe);                                                   \
    }                                                                                                      \
    static std::vector<FrameOut> frames(const std::vector<FrameIn>& g) {                                   \
      return mapped<FrameOut>(g, space::frameProbe);                                                       \
    }                                                                                                      \
    static std::vector<IterativeOut> loops(const std::vector<IterativeIn>& g) {                            \
      return mapped<IterativeOut>(g, space::iterativeProbe);                                               \
    }                                                                                                      \
    static std::vector<ChainOut> chains(std::string_view method, const std::vector<ChainIn>& g) {          \
      return mapped<ChainOut>(g, space::methodProbes(method).chain);                                       \
    }                                                                                                      \
    static std::vector<HandOverOut> handOvers(std::string_view method, const std::vector<HandOverIn>& g) { \
      return mapped<HandOverOut>(g, space::methodProbes(method).handOver);                                 \
    }                                                                                                      \
  };                                                                                                       \
  struct Glsl##Name : Cpp##Name {                                                                          \
    static constexpr const char* kBackend = "Glsl" #Name;                                                  \
    static constexpr double kRoundings = 2.5;                                                              \
    static std::vector<SurfaceOut> surfaces(const std::vector<SurfaceIn>& g) {                             \
      return onDevice<SurfaceOut>(isDouble, "", "SurfaceIn", "SurfaceOut", "surfaceProbe(given[at])", g);  \
    }                                                                                                      \
    static std::vector<FrameOut> frames(const std::vector<FrameIn>& g) {                                   \
      return onDevice<FrameOut>(isDouble, "", "FrameIn", "FrameOut", "frameProbe(given[at])", g);          \
    }                                                                                                      \
    static std::vector<IterativeOut> loops(const std::vector<IterativeIn>& g) {                            \
      return onDevice<IterativeOut>(isDouble, "", "IterativeIn", "IterativeOut", "iterativeProbe(at)", g); \
    }                                                                                                      \
    static std::vector<ChainOut> chains(std::string_view method, const std::vector<ChainIn>& g) {          \
      return onDevice<ChainOut>(isDouble, method, "ChainIn", "ChainOut", "chainProbe(at)", g);             \
    }                                                                                                      \
    static std::vector<HandOverOut> handOvers(std::string_view method, const std::vector<HandOverIn>& g) { \
      return onDevice<HandOverOut>(isDouble, method, "HandOverIn", "HandOverOut", "handOverProbe(at)", g); \
    }                                                                                                      \
  };
MALUS_BACKEND(Float, F32, f32, false)
MALUS_BACKEND(Double, F64, f64, true)

#ifdef MALUS_EMULATED_PRECISION
// Inputs and outputs are those of the float build.
template <class Optics>
struct Emulated : CppFloat {
  static constexpr const char* kBackend = Optics::kName;
  static constexpr double kRoundings = Optics::kRoundings;
  static constexpr double kPackingRoundings = 2;
  static constexpr bool kFlushesHalves = true;
  static constexpr std::size_t kInterfaces = 40000;
  template <class Out, class In, class F>
  static std::vector<Out> emulate(const std::vector<In>& given, F f) {
    using EmulatedIn = std::remove_cvref_t<typename FirstArgument<F>::Type>;
    Optics::enter();
    return mapped<Out>(given, [&](const In& g) { return emulatedCast<Out>(f(emulatedCast<EmulatedIn>(g))); });
  }
  static std::vector<SurfaceOut> surfaces(const std::vector<SurfaceIn>& g) {
    return emulate<SurfaceOut>(g, emulated::surfaceProbe);
  }
  static std::vector<FrameOut> frames(const std::vector<FrameIn>& g) {
    return emulate<FrameOut>(g, emulated::frameProbe);
  }
  static std::vector<IterativeOut> loops(const std::vector<IterativeIn>& g) {
    return emulate<IterativeOut>(g, emulated::iterativeProbe);
  }
  static std::vector<ChainOut> chains(std::string_view method, const std::vector<ChainIn>& g) {
    return emulate<ChainOut>(g, emulated::methodProbes(method).chain);
  }
  static std::vector<HandOverOut> handOvers(std::string_view method, const std::vector<HandOverIn>& g) {
    return emulate<HandOverOut>(g, emulated::methodProbes(method).handOver);
  }

 private:
  template <class F>
  struct FirstArgument;
  template <class R, class A>
  struct FirstArgument<R (*)(A)> {
    using Type = A;
  };
};
using Backends = ::testing::Types<Emulated<EmulatedRandom>, Emulated<EmulatedOther>, Emulated<EmulatedLargest>,
                                  Emulated<EmulatedSmallest>>;
#else
using Backends = ::testing::Types<CppFloat, CppDouble, GlslFloat, GlslDouble>;
#endif
struct BackendNames {
  template <class T>
  static std::string GetName(int) {
    return T::kBackend;
  }
};
#define MALUS_HARD_CASES(Name)            \
  template <class T>                      \
  class Name : public ::testing::Test {}; \
  TYPED_TEST_SUITE(Name, Backends, BackendNames)

// Abbreviations of a test: B the backend, kEps the type's spacing at 1, R(x) its rounding of x, kUnit the size that
// errors are given in: eps times the factor by which the backend's arithmetic may be worse than IEEE's.
#define MALUS_BACKEND_TYPES                                                    \
  using B = TypeParam;                                                         \
  using real = typename B::real;                                               \
  using real3 [[maybe_unused]] = typename B::real3;                            \
  [[maybe_unused]] constexpr real kEps = std::numeric_limits<real>::epsilon(); \
  [[maybe_unused]] constexpr double kUnit = B::kRoundings * double(kEps);      \
  [[maybe_unused]] const auto R = [](oracle::Real x) { return static_cast<real>(x); }

// Converts a path of the oracle to a rounded chain of the optics, and such a chain back to a path.
template <class B>
typename B::ChainIn chainFromPath(const Path& path, double radiance = 1, std::size_t colour = 1) {
  using real = typename B::real;
  typename B::ChainIn chain{};
  chain.d = toReal3<B>(path.d[0]);
  chain.radiance = static_cast<real>(radiance);
  chain.count = static_cast<real>(path.bounces.size());
  for (std::size_t i = 0; i < path.bounces.size(); ++i) {
    const Bounce& b = path.bounces[i];
    chain.bounces[i] = {toReal3<B>(b.n), static_cast<real>(b.n1), static_cast<real>(b.n2[colour].real()),
                        static_cast<real>(-b.n2[colour].imag()),
                        static_cast<real>(b.transmits ? 2
                                          : b.metal   ? 1
                                                      : 0)};
  }
  return chain;
}
template <class Chain>
Path pathFromChain(const Chain& chain) {
  Path path;
  path.d.push_back(oracle::unit(toVec(chain.d)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(chain.count); ++i) {
    const auto& b = chain.bounces[i];
    const oracle::Complex n2(b.n2, static_cast<double>(b.kind) == 1 ? -oracle::Real(b.k2) : 0);
    extend(path,
           {{},
            static_cast<double>(b.n1),
            {n2, n2, n2},
            static_cast<double>(b.kind) == 1,
            static_cast<double>(b.kind) == 2},
           oracle::unit(toVec(b.n)));
  }
  return path;
}

}  // namespace malus::test

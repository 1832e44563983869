// The optics on emulation::Float, and calls of them with floats.
#pragma once

#include <cstring>
#include <tuple>
#include <utility>

#include "shaders/optics/optics.h"
#include "tests/shaders/emulated_float.h"

#include "shaders/optics/language_begin.h"
namespace malus::emulated {
#include "tests/shaders/emulated_math.h"

#include "shaders/optics/all.h"
}  // namespace malus::emulated
#include "shaders/optics/language_end.h"

namespace malus::test {

// Factor by which an operation may be less exact than IEEE arithmetic, whose relative error is at most eps/2: 2 for
// + - *, 2 * 2.5 for a quotient, 2 * (2 + 2.5) for a root. The tests' bounds count roundings of eps/2.
inline constexpr int kEmulatedRoundings = 9;

template <emulation::Choice kChoiceValue, std::uint64_t kSeedValue>
struct EmulatedDevice {
  static constexpr emulation::Choice kChoice = kChoiceValue;
  static void enter() { emulation::device.choose(kChoiceValue, kSeedValue); }
};

// Conversion between a struct of floats and the same struct of emulation::Float.
template <class To, class From>
To emulatedCast(const From& from) {
  if constexpr (std::is_same_v<To, From>) {
    return from;
  } else if constexpr (std::is_integral_v<To> && std::is_integral_v<From>) {
    return static_cast<To>(from);
  } else if constexpr (std::is_same_v<To, f32::RefractionTerms> || std::is_same_v<From, f32::RefractionTerms>) {
    using real = decltype(To::eta);
    To to;
    to.eta = emulatedCast<real>(from.eta);
    to.etaSq = emulatedCast<real>(from.etaSq);
    to.etaSqM1 = emulatedCast<real>(from.etaSqM1);
    to.sinSq = emulatedCast<real>(from.sinSq);
    to.t = emulatedCast<real>(from.t);
    to.tau = emulatedCast<real>(from.tau);
    to.total = from.total;
    to.matched = from.matched;
    return to;
  } else {
    using emulation::Float;
    constexpr bool kFromFloats = sizeof(To) > sizeof(From);
    constexpr std::size_t kCount = (kFromFloats ? sizeof(From) : sizeof(To)) / sizeof(float);
    static_assert(sizeof(To) + sizeof(From) == kCount * (sizeof(float) + sizeof(Float)));
    static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
    To to;
    for (std::size_t i = 0; i < kCount; ++i) {
      float plain;
      Float wrapped;
      const char* source = reinterpret_cast<const char*>(&from);
      char* target = reinterpret_cast<char*>(&to);
      if constexpr (kFromFloats) {
        std::memcpy(&plain, source + i * sizeof(float), sizeof(float));
        wrapped = Float(plain);
        std::memcpy(target + i * sizeof(Float), &wrapped, sizeof(Float));
      } else {
        std::memcpy(&wrapped, source + i * sizeof(Float), sizeof(Float));
        std::memcpy(target + i * sizeof(float), &wrapped.value, sizeof(float));
      }
    }
    return to;
  }
}

// Calls an emulated function as the function of the float build that has the signature Plain.
template <class D, class Plain, class Emulated, Emulated* kFunction>
struct EmulatedCall;
template <class D, class R, class... A, class E, class... B, E (*kFunction)(B...)>
struct EmulatedCall<D, R(A...), E(B...), kFunction> {
  R operator()(A... a) const {
    D::enter();
    std::tuple<std::remove_cvref_t<B>...> given{argument<A, std::remove_cvref_t<B>>(a)...};
    return call(given, std::forward_as_tuple(a...), std::index_sequence_for<A...>());
  }

 private:
  template <class T>
  static constexpr bool kIsWritten = std::is_lvalue_reference_v<T> && !std::is_const_v<std::remove_reference_t<T>>;

  template <class T, class To>
  static To argument(const std::remove_reference_t<T>& a) {
    if constexpr (kIsWritten<T>) {
      return To{};
    } else {
      return emulatedCast<To>(a);
    }
  }
  template <class Given, class Target, std::size_t... I>
  static R call(Given& given, Target target, std::index_sequence<I...>) {
    const auto writeBack = [&]<class T>(std::type_identity<T>, auto& to, const auto& from) {
      if constexpr (kIsWritten<T>) to = emulatedCast<std::remove_reference_t<T>>(from);
    };
    if constexpr (std::is_void_v<R>) {
      kFunction(std::get<I>(given)...);
      (writeBack(std::type_identity<A>(), std::get<I>(target), std::get<I>(given)), ...);
    } else {
      const R result = emulatedCast<R>(kFunction(std::get<I>(given)...));
      (writeBack(std::type_identity<A>(), std::get<I>(target), std::get<I>(given)), ...);
      return result;
    }
  }
};

}  // namespace malus::test

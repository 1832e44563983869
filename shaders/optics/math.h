// Every operation that the shared files call beside + - * / on real and real3. A build on another number type (a SIMD
// packet, the two-lane type of the tests) supplies these instead of this file. The shared files therefore contain no
// `if` on data but `if (anyM(mask))`, no `?:`, no swizzles, no constructors and no trigonometry.

#include "shaders/optics/scalar_math.h"

#ifdef __cplusplus
FN real sqrtR(real x) { return std::sqrt(x); }
FN real absR(real x) { return std::abs(x); }
FN real floorR(real x) { return std::floor(x); }
FN real expR(real x) { return std::exp(x); }
FN real logR(real x) { return std::log(x); }
#else
FN real sqrtR(real x) { return sqrt(x); }
FN real absR(real x) { return abs(x); }
FN real floorR(real x) { return floor(x); }
FN real expR(real x) { return real(exp(float(x))); }
FN real logR(real x) { return real(log(float(x))); }
#endif

// Words of methods with packed payloads (float only). Numbers of 16 bits, two in a word: bits of a half float, rounded
// to nearest, and of a fraction in [-1, 1] in steps of 1/32767. A whole number, and the bits of a float.
#ifdef __cplusplus
FN word halfBits(real x) { return glm::packHalf1x16(static_cast<float>(x)); }
FN real halfValue(word bits) { return static_cast<real>(glm::unpackHalf1x16(static_cast<std::uint16_t>(bits))); }
FN word fractionBits(real x) { return glm::packSnorm1x16(static_cast<float>(x)); }
FN real fractionValue(word bits) { return static_cast<real>(glm::unpackSnorm1x16(static_cast<std::uint16_t>(bits))); }
FN word wordOfReal(real x) { return static_cast<word>(x); }
FN real realOfWord(word x) { return static_cast<real>(x); }
FN word floatBits(real x) { return glm::floatBitsToUint(static_cast<float>(x)); }
FN real floatValue(word bits) { return static_cast<real>(glm::uintBitsToFloat(bits)); }
#else
FN word halfBits(real x) { return packHalf2x16(vec2(float(x), 0.0)); }
FN real halfValue(word bits) { return real(unpackHalf2x16(bits).x); }
FN word fractionBits(real x) { return packSnorm2x16(vec2(float(x), 0.0)); }
FN real fractionValue(word bits) { return real(unpackSnorm2x16(bits).x); }
FN word wordOfReal(real x) { return word(x); }
FN real realOfWord(word x) { return real(x); }
FN word floatBits(real x) { return floatBitsToUint(float(x)); }
FN real floatValue(word bits) { return real(uintBitsToFloat(bits)); }
#endif

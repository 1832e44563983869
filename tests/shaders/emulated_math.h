// The functions of shaders/optics/math.h on emulation::Float. No include guard: included inside a namespace.
using real = emulation::Float;
using real3 = emulation::Three;
using mask = bool;
using word = std::uint32_t;

#include "shaders/optics/scalar_math.h"

FN real sqrtR(real x) { return real(emulation::squareRoot(x.value)); }
FN real absR(real x) { return real(std::abs(emulation::device.flush(x.value))); }
FN real floorR(real x) { return real(std::floor(emulation::device.flush(x.value))); }
FN real expR(real x) { return real(emulation::exponential(x.value)); }
FN real logR(real x) { return real(emulation::logarithm(x.value)); }

FN word halfBits(real x) { return emulation::packHalf(x.value); }
FN real halfValue(word bits) { return real(emulation::unpackHalf(bits)); }
FN word fractionBits(real x) { return emulation::packFraction(x.value); }
FN real fractionValue(word bits) { return real(emulation::unpackFraction(bits)); }
FN word wordOfReal(real x) { return static_cast<word>(x.value); }
FN real realOfWord(word x) { return real(emulation::device.round(x)); }
FN word floatBits(real x) { return glm::floatBitsToUint(static_cast<float>(x.value)); }
FN real floatValue(word bits) { return real(glm::uintBitsToFloat(bits)); }

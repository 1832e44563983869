// Every operation that the shared files call beside + - * / on real and real3. A build on another number type (a SIMD
// packet, the two-lane type of the tests) supplies these instead of this file. The shared files therefore contain no
// `if` on data but `if (anyM(mask))`, no `?:`, no swizzles, no constructors and no trigonometry.

FN real3 make3(real x, real y, real z) {
  real3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}
FN real3 splat3(real x) { return make3(x, x, x); }

FN mask lessR(real a, real b) { return a < b; }
FN mask lessEqualR(real a, real b) { return a <= b; }
FN mask equalR(real a, real b) { return a == b; }
FN mask andM(mask a, mask b) { return a && b; }
FN mask orM(mask a, mask b) { return a || b; }
FN mask notM(mask a) { return !a; }
// Whether the mask is true in any lane: to skip work that no lane needs. What the skipped block writes is selected by
// the same mask.
FN bool anyM(mask a) { return a; }

FN real selectR(mask m, real a, real b) { return m ? a : b; }
FN real minR(real a, real b) { return a < b ? a : b; }
FN real maxR(real a, real b) { return a > b ? a : b; }

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

FN real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real3 cross3(real3 a, real3 b) { return make3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

// Numbers of 16 bits, two in a word, for methods with packed payloads (float only): bits of a half float, rounded to
// nearest, and of a fraction in [-1, 1] in steps of 1/32767.
#ifdef __cplusplus
FN word halfBits(real x) { return glm::packHalf1x16(static_cast<float>(x)); }
FN real halfValue(word bits) { return static_cast<real>(glm::unpackHalf1x16(static_cast<std::uint16_t>(bits))); }
FN word fractionBits(real x) { return glm::packSnorm1x16(static_cast<float>(x)); }
FN real fractionValue(word bits) { return static_cast<real>(glm::unpackSnorm1x16(static_cast<std::uint16_t>(bits))); }
FN word wordOfReal(real x) { return static_cast<word>(x); }
FN real realOfWord(word x) { return static_cast<real>(x); }
#else
FN word halfBits(real x) { return packHalf2x16(vec2(float(x), 0.0)); }
FN real halfValue(word bits) { return real(unpackHalf2x16(bits).x); }
FN word fractionBits(real x) { return packSnorm2x16(vec2(float(x), 0.0)); }
FN real fractionValue(word bits) { return real(unpackSnorm2x16(bits).x); }
FN word wordOfReal(real x) { return word(x); }
FN real realOfWord(word x) { return real(x); }
#endif
FN word joinWord(word low, word high) { return (low & 0xffffu) | (high << 16); }
FN mask equalW(word a, word b) { return a == b; }
FN mask hasBit(word w, int bit) { return ((w >> bit) & 1u) == 1u; }
FN word lowHalf(word w) { return w & 0xffffu; }
FN word highHalf(word w) { return w >> 16; }

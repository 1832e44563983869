// The functions of shaders/optics/math.h on emulation::Float. No include guard: included inside a namespace.
using real = emulation::Float;
using real3 = emulation::Three;
using mask = bool;
using word = std::uint32_t;

FN real3 make3(real x, real y, real z) { return {x, y, z}; }
FN real3 splat3(real x) { return {x, x, x}; }

FN mask lessR(real a, real b) { return a < b; }
FN mask lessEqualR(real a, real b) { return a <= b; }
FN mask equalR(real a, real b) { return a == b; }
FN mask andM(mask a, mask b) { return a && b; }
FN mask orM(mask a, mask b) { return a || b; }
FN mask notM(mask a) { return !a; }
FN bool anyM(mask a) { return a; }

FN real selectR(mask m, real a, real b) { return m ? a : b; }
FN real minR(real a, real b) { return a < b ? a : b; }
FN real maxR(real a, real b) { return a > b ? a : b; }
FN real sqrtR(real x) { return real(emulation::squareRoot(x.value)); }
FN real absR(real x) { return real(std::abs(emulation::device.flush(x.value))); }
FN real floorR(real x) { return real(std::floor(emulation::device.flush(x.value))); }
FN real expR(real x) { return real(emulation::exponential(x.value)); }
FN real logR(real x) { return real(emulation::logarithm(x.value)); }

FN real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real3 cross3(real3 a, real3 b) { return make3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

FN word halfBits(real x) { return emulation::packHalf(x.value); }
FN real halfValue(word bits) { return real(emulation::unpackHalf(bits)); }
FN word fractionBits(real x) { return emulation::packFraction(x.value); }
FN real fractionValue(word bits) { return real(emulation::unpackFraction(bits)); }
FN word wordOfReal(real x) { return static_cast<word>(x.value); }
FN real realOfWord(word x) { return real(emulation::device.round(x)); }
FN word joinWord(word low, word high) { return (low & 0xffffu) | (high << 16); }
FN mask equalW(word a, word b) { return a == b; }
FN mask hasBit(word w, int bit) { return ((w >> bit) & 1u) == 1u; }
FN word lowHalf(word w) { return w & 0xffffu; }
FN word highHalf(word w) { return w >> 16; }

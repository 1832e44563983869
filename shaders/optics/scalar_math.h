// The part of math.h that needs operators alone: for every scalar number type with a mask of type bool.

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

FN real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real3 cross3(real3 a, real3 b) { return make3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }

FN word joinWord(word low, word high) { return (low & 0xffffu) | (high << 16); }
FN mask equalW(word a, word b) { return a == b; }
FN mask hasBit(word w, int bit) { return ((w >> bit) & 1u) == 1u; }
FN word lowHalf(word w) { return w & 0xffffu; }
FN word highHalf(word w) { return w >> 16; }
FN word andW(word a, word b) { return a & b; }
FN word orW(word a, word b) { return a | b; }
FN word xorW(word a, word b) { return a ^ b; }
FN word shiftRightW(word a, int bits) { return a >> bits; }
// Modulo 2^32.
FN word addW(word a, word b) { return a + b; }
FN word timesW(word a, word factor) { return a * factor; }

// The words of the shared language (shaders/optics/CONVENTIONS.md) on SIMD lanes, by Highway: one value per lane of the
// processor's registers. Included once per instruction set, in its namespace; no include guard.
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Words = hn::RebindToUnsigned<Floats>;
using Ints = hn::RebindToSigned<Floats>;
static constexpr std::size_t kLanes = HWY_MIN(HWY_LANES(float), 16);

struct mask {
  hn::Mask<Floats> m;
  mask() = default;
  HWY_INLINE mask(hn::Mask<Floats> value) : m(value) {}
  HWY_INLINE mask(bool everywhere) : m(hn::FirstN(Floats(), everywhere ? kLanes : 0)) {}
};

struct real {
  hn::Vec<Floats> v;
  real() = default;
  HWY_INLINE real(hn::Vec<Floats> value) : v(value) {}
  HWY_INLINE real(float everywhere) : v(hn::Set(Floats(), everywhere)) {}
  HWY_INLINE explicit real(double everywhere) : real(static_cast<float>(everywhere)) {}
  HWY_INLINE explicit real(int everywhere) : real(static_cast<float>(everywhere)) {}
  HWY_INLINE explicit real(std::uint32_t everywhere) : real(static_cast<float>(everywhere)) {}
  friend HWY_INLINE real operator+(real a, real b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE real operator-(real a, real b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE real operator*(real a, real b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE real operator/(real a, real b) { return hn::Div(a.v, b.v); }
};

struct word {
  hn::Vec<Words> v;
  word() = default;
  HWY_INLINE word(hn::Vec<Words> value) : v(value) {}
  HWY_INLINE word(std::uint32_t everywhere) : v(hn::Set(Words(), everywhere)) {}
};

struct real3 {
  real x, y, z;
  real3() = default;
  HWY_INLINE real3(real a, real b, real c) : x(a), y(b), z(c) {}
  HWY_INLINE real3(const glm::vec3& everywhere) : x(everywhere.x), y(everywhere.y), z(everywhere.z) {}
  friend HWY_INLINE real3 operator+(const real3& a, const real3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend HWY_INLINE real3 operator-(const real3& a, const real3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend HWY_INLINE real3 operator*(const real3& a, const real3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend HWY_INLINE real3 operator*(const real3& a, real b) { return {a.x * b, a.y * b, a.z * b}; }
};

FN real3 make3(real x, real y, real z) { return {x, y, z}; }
FN real3 splat3(real x) { return {x, x, x}; }

FN mask lessR(real a, real b) { return hn::Lt(a.v, b.v); }
FN mask lessEqualR(real a, real b) { return hn::Le(a.v, b.v); }
FN mask equalR(real a, real b) { return hn::Eq(a.v, b.v); }
FN mask andM(mask a, mask b) { return hn::And(a.m, b.m); }
FN mask orM(mask a, mask b) { return hn::Or(a.m, b.m); }
FN mask notM(mask a) { return hn::Not(a.m); }
FN bool anyM(mask a) { return !hn::AllFalse(Floats(), a.m); }
FN std::size_t countM(mask a) { return hn::CountTrue(Floats(), a.m); }

FN real selectR(mask m, real a, real b) { return hn::IfThenElse(m.m, a.v, b.v); }
// As `a < b ? a : b` for NaN and zeros too, which is what the instructions of x86 do.
#if HWY_ARCH_X86
FN real minR(real a, real b) { return hn::Min(a.v, b.v); }
FN real maxR(real a, real b) { return hn::Max(a.v, b.v); }
#else
FN real minR(real a, real b) { return selectR(lessR(a, b), a, b); }
FN real maxR(real a, real b) { return selectR(lessR(b, a), a, b); }
#endif
FN real sqrtR(real a) { return hn::Sqrt(a.v); }
FN real absR(real a) { return hn::Abs(a.v); }
FN real floorR(real a) { return hn::Floor(a.v); }

// Lane by lane: the same result as in the scalar build.
template <class Function>
FN real perLane(real a, Function function) {
  HWY_ALIGN float lane[kLanes];
  hn::Store(a.v, Floats(), lane);
  for (float& x : lane) x = function(x);
  return hn::Load(Floats(), lane);
}
FN real expR(real a) {
  return perLane(a, [](float x) HWY_ATTR { return std::exp(x); });
}
FN real logR(real a) {
  return perLane(a, [](float x) HWY_ATTR { return std::log(x); });
}

FN real dot3(const real3& a, const real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real3 cross3(const real3& a, const real3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

FN word lowHalf(word w) { return hn::And(w.v, hn::Set(Words(), 0xffffu)); }
FN word highHalf(word w) { return hn::ShiftRight<16>(w.v); }
FN word joinWord(word low, word high) { return hn::Or(lowHalf(low).v, hn::ShiftLeft<16>(high.v)); }
FN word andW(word a, word b) { return hn::And(a.v, b.v); }
FN word orW(word a, word b) { return hn::Or(a.v, b.v); }
FN word xorW(word a, word b) { return hn::Xor(a.v, b.v); }
FN word shiftRightW(word a, int bits) { return hn::ShiftRightSame(a.v, bits); }
FN word addW(word a, word b) { return hn::Add(a.v, b.v); }
FN word timesW(word a, std::uint32_t factor) { return hn::Mul(a.v, hn::Set(Words(), factor)); }
// The same where all lanes have one word.
FN std::uint32_t addW(std::uint32_t a, std::uint32_t b) { return a + b; }
FN std::uint32_t timesW(std::uint32_t a, std::uint32_t factor) { return a * factor; }
FN mask equalW(word a, word b) { return hn::RebindMask(Floats(), hn::Eq(a.v, b.v)); }
FN mask hasBit(word w, int bit) {
  return hn::RebindMask(Floats(), hn::TestBit(w.v, hn::Set(Words(), 1u << static_cast<unsigned>(bit))));
}
FN word selectW(mask m, word a, word b) { return hn::IfThenElse(hn::RebindMask(Words(), m.m), a.v, b.v); }

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
FN word halfBits(real x) {
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  return hn::PromoteTo(Words(), hn::BitCast(bits, hn::DemoteTo(halves, x.v)));
}
FN real halfValue(word w) {
  const hn::Rebind<hwy::float16_t, Floats> halves;
  const hn::Rebind<std::uint16_t, Floats> bits;
  return hn::PromoteTo(Floats(), hn::BitCast(halves, hn::DemoteTo(bits, hn::BitCast(Ints(), lowHalf(w).v))));
}
#else  // no instructions for half floats, or not with this rounding
FN word halfBits(real x) {
  HWY_ALIGN float value[kLanes];
  HWY_ALIGN std::uint32_t bits[kLanes];
  hn::Store(x.v, Floats(), value);
  for (std::size_t i = 0; i < kLanes; ++i) bits[i] = glm::packHalf1x16(value[i]);
  return hn::Load(Words(), bits);
}
FN real halfValue(word w) {
  HWY_ALIGN std::uint32_t bits[kLanes];
  HWY_ALIGN float value[kLanes];
  hn::Store(w.v, Words(), bits);
  for (std::size_t i = 0; i < kLanes; ++i) value[i] = glm::unpackHalf1x16(static_cast<std::uint16_t>(bits[i]));
  return hn::Load(Floats(), value);
}
#endif
// Steps of 1/32767, rounded to the nearest, halves away from 0.
FN word fractionBits(real x) {
  const real scaled = minR(maxR(x, -1.0f), 1.0f) * 32767.0f;
  const real half = hn::CopySign(real(0.5f).v, scaled.v);
  return lowHalf(hn::BitCast(Words(), hn::ConvertTo(Ints(), (scaled + half).v)));
}
FN real fractionValue(word w) {
  const hn::Vec<Ints> extended = hn::ShiftRight<16>(hn::BitCast(Ints(), hn::ShiftLeft<16>(w.v)));
  return maxR(real(hn::ConvertTo(Floats(), extended)) * (1.0f / 32767.0f), -1.0f);
}
FN word wordOfReal(real x) { return hn::BitCast(Words(), hn::ConvertTo(Ints(), x.v)); }
FN real realOfWord(word w) { return hn::ConvertTo(Floats(), hn::BitCast(Ints(), w.v)); }
FN word floatBits(real x) { return hn::BitCast(Words(), x.v); }
FN real floatValue(word w) { return hn::BitCast(Floats(), w.v); }

// Structs of lanes are arrays of registers: every member is a real or a word.
template <class Struct>
static constexpr std::size_t kFields = sizeof(Struct) / sizeof(real);

template <class Struct>
FN real getField(const Struct& s, std::size_t i) {
  real field;
  std::memcpy(&field, reinterpret_cast<const char*>(&s) + i * sizeof(real), sizeof field);
  return field;
}
template <class Struct>
FN void setField(Struct& s, std::size_t i, real field) {
  std::memcpy(reinterpret_cast<char*>(&s) + i * sizeof(real), &field, sizeof field);
}

template <class Struct>
FN Struct selectFields(mask m, const Struct& a, const Struct& b) {
  Struct result;
  for (std::size_t i = 0; i < kFields<Struct>; ++i) setField(result, i, selectR(m, getField(a, i), getField(b, i)));
  return result;
}

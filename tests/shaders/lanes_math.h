// The functions of shaders/optics/math.h on two lanes. No include guard: included once for each scalar.
using real = lanes::Lane2<scalar>;
using real3 = lanes::Three<scalar>;
using mask = lanes::Mask2;
using word = lanes::Word2;

FN real3 make3(real x, real y, real z) { return {x, y, z}; }
FN real3 splat3(real x) { return {x, x, x}; }

FN mask lessR(real a, real b) { return {a.lane[0] < b.lane[0], a.lane[1] < b.lane[1]}; }
FN mask lessEqualR(real a, real b) { return {a.lane[0] <= b.lane[0], a.lane[1] <= b.lane[1]}; }
FN mask equalR(real a, real b) { return {a.lane[0] == b.lane[0], a.lane[1] == b.lane[1]}; }
FN mask andM(mask a, mask b) { return {a.lane[0] && b.lane[0], a.lane[1] && b.lane[1]}; }
FN mask orM(mask a, mask b) { return {a.lane[0] || b.lane[0], a.lane[1] || b.lane[1]}; }
FN mask notM(mask a) { return {!a.lane[0], !a.lane[1]}; }
FN bool anyM(mask a) { return a.lane[0] || a.lane[1]; }

FN real selectR(mask m, real a, real b) {
  return {m.lane[0] ? a.lane[0] : b.lane[0], m.lane[1] ? a.lane[1] : b.lane[1]};
}
FN real minR(real a, real b) { return selectR(lessR(a, b), a, b); }
FN real maxR(real a, real b) { return selectR(lessR(b, a), a, b); }
FN real sqrtR(real a) { return {std::sqrt(a.lane[0]), std::sqrt(a.lane[1])}; }
FN real absR(real a) { return {std::abs(a.lane[0]), std::abs(a.lane[1])}; }
FN real floorR(real a) { return {std::floor(a.lane[0]), std::floor(a.lane[1])}; }
FN real expR(real a) { return {std::exp(a.lane[0]), std::exp(a.lane[1])}; }
FN real logR(real a) { return {std::log(a.lane[0]), std::log(a.lane[1])}; }

FN real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN real3 cross3(real3 a, real3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

FN word halfBits(real x) {
  return {glm::packHalf1x16(static_cast<float>(x.lane[0])), glm::packHalf1x16(static_cast<float>(x.lane[1]))};
}
FN real halfValue(word w) {
  return {glm::unpackHalf1x16(static_cast<std::uint16_t>(w.lane[0])),
          glm::unpackHalf1x16(static_cast<std::uint16_t>(w.lane[1]))};
}
FN word fractionBits(real x) {
  return {glm::packSnorm1x16(static_cast<float>(x.lane[0])), glm::packSnorm1x16(static_cast<float>(x.lane[1]))};
}
FN real fractionValue(word w) {
  return {glm::unpackSnorm1x16(static_cast<std::uint16_t>(w.lane[0])),
          glm::unpackSnorm1x16(static_cast<std::uint16_t>(w.lane[1]))};
}
FN word wordOfReal(real x) { return {static_cast<std::uint32_t>(x.lane[0]), static_cast<std::uint32_t>(x.lane[1])}; }
FN real realOfWord(word w) { return {static_cast<scalar>(w.lane[0]), static_cast<scalar>(w.lane[1])}; }
FN word floatBits(real x) {
  return {glm::floatBitsToUint(static_cast<float>(x.lane[0])), glm::floatBitsToUint(static_cast<float>(x.lane[1]))};
}
FN real floatValue(word w) {
  return {static_cast<scalar>(glm::uintBitsToFloat(w.lane[0])), static_cast<scalar>(glm::uintBitsToFloat(w.lane[1]))};
}
FN word joinWord(word low, word high) {
  return {(low.lane[0] & 0xffffu) | (high.lane[0] << 16), (low.lane[1] & 0xffffu) | (high.lane[1] << 16)};
}
FN word lowHalf(word w) { return {w.lane[0] & 0xffffu, w.lane[1] & 0xffffu}; }
FN word highHalf(word w) { return {w.lane[0] >> 16, w.lane[1] >> 16}; }
FN word andW(word a, word b) { return {a.lane[0] & b.lane[0], a.lane[1] & b.lane[1]}; }
FN word orW(word a, word b) { return {a.lane[0] | b.lane[0], a.lane[1] | b.lane[1]}; }
FN word xorW(word a, word b) { return {a.lane[0] ^ b.lane[0], a.lane[1] ^ b.lane[1]}; }
FN word shiftRightW(word a, int bits) { return {a.lane[0] >> bits, a.lane[1] >> bits}; }
FN word addW(word a, word b) { return {a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]}; }
FN word timesW(word a, word factor) { return {a.lane[0] * factor.lane[0], a.lane[1] * factor.lane[1]}; }
FN mask equalW(word a, word b) { return {a.lane[0] == b.lane[0], a.lane[1] == b.lane[1]}; }
FN mask hasBit(word w, int bit) { return {(w.lane[0] >> bit & 1u) == 1u, (w.lane[1] >> bit & 1u) == 1u}; }

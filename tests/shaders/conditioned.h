// Condition of the Fresnel equations.
#pragma once

#include "tests/shaders/jones.h"

namespace malus::test {

// Values of the oracle and their changes if cosine and index change by the relative `step`. Where the problem is ill
// conditioned (critical angle, grazing incidence), no arithmetic has smaller errors.
struct Conditioned {
  oracle::Powers value;
  oracle::Powers spread{};
};
using PowersFunction = oracle::Powers (*)(oracle::Real c, oracle::Real n1, oracle::Complex n2);
inline Conditioned conditioned(oracle::Real c, oracle::Real n1, oracle::Complex n2, oracle::Real step,
                               PowersFunction powers = oracle::powers) {
  using oracle::Real;
  Conditioned r{powers(c, n1, n2), {}};
  for (const Real dc : {-1.0L, 0.0L, 1.0L})
    for (const Real dn : {-1.0L, 1.0L}) {
      const Real near = std::min(Real(1), std::max(Real(0), c * (1 + dc * step)));
      const oracle::Complex move = (std::abs(n2 - n1) < std::abs(n2) ? n2 - n1 : n2) * (dn * step);
      const oracle::Powers p = powers(near, n1, n2 + move);
      const auto grow = [](Real& spread, Real a, Real b) { spread = std::max(spread, std::abs(a - b)); };
      grow(r.spread.rs, p.rs, r.value.rs);
      grow(r.spread.rp, p.rp, r.value.rp);
      grow(r.spread.ts, p.ts, r.value.ts);
      grow(r.spread.tp, p.tp, r.value.tp);
      grow(r.spread.txGeo, p.txGeo, r.value.txGeo);
      r.spread.x = std::max(std::abs(r.spread.x), std::abs(p.x - r.value.x));
    }
  return r;
}

}  // namespace malus::test

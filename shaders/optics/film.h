// Thin film: a plane layer of real index on a dielectric or a conductor, all its reflections summed with their
// phases (Airy's formula). Source: Born and Wolf, Principles of Optics, 1.6.4 and 14.4. Signs and time
// dependence as in fresnel.h.

struct Film {
  Reflectance reflected;
  // Through the film into a dielectric (into a conductor: 1 - R and no phase): the same four numbers, of t_p conj(t_s).
  Reflectance through;
};

// One interface within the stack, from medium j to k: r_s and rho = r_p/r_s. kSq: square of the wave's component
// along the surface; qj, qk: across it; difference: n_j^2 - n_k^2, all relative to the first medium.
struct FilmInterface {
  Complex rs;
  Complex rp;
};
FN FilmInterface filmInterface(real kSq, Complex qj, Complex qk, Complex difference) {
  FilmInterface f;
  Complex sum = complexAdd(qj, qk);
  Complex product = complexMul(qj, qk);
  f.rs = complexDiv(difference, complexMul(sum, sum));
  f.rp = complexMul(
      f.rs, complexDiv(makeComplex(kSq - product.re, R(0.0) - product.im), makeComplex(kSq + product.re, product.im)));
  return f;
}

// Medium n1, film of index nf, medium n3 - i k3. turns: twice the film's thickness over the wavelength in vacuum.
FN Film thinFilm(real c, real n1, real nf, real turns, real n3, real k3) {
  real inverse = R(1.0) / n1;
  real inverseSq = inverse * inverse;
  real sinSq = (R(1.0) - c) * (R(1.0) + c);
  // Components across the surface: q^2 = (n/n1)^2 - sin^2, from n^2 - n1^2 and c^2.
  real eF = ((nf - n1) * (nf + n1)) * inverseSq;
  real e3Re = ((n3 - n1) * (n3 + n1) - k3 * k3) * inverseSq;
  real e3Im = R(-2.0) * n3 * k3 * inverseSq;
  Complex q1 = makeComplex(c, R(0.0));
  Complex q2 = complexSqrtLower(eF + c * c, R(0.0));
  Complex q3 = complexSqrtLower(e3Re + c * c, e3Im);
  FilmInterface a = filmInterface(sinSq, q1, q2, makeComplex(R(0.0) - eF, R(0.0)));
  real differenceRe = ((nf - n3) * (nf + n3) + k3 * k3) * inverseSq;
  FilmInterface b = filmInterface(sinSq, q2, q3, makeComplex(differenceRe, R(0.0) - e3Im));
  // Once through the film and back: e^{-2 i beta}.
  Complex turn = cisTwoPi(turns * n1 * q2.re);
  real fade = expR(R(6.28318530717958647693) * turns * n1 * q2.im);
  Complex phase = makeComplex(turn.re * fade, (R(0.0) - turn.im) * fade);

  // r = (r12 + r23 e) / (1 + r12 r23 e)
  Complex one = makeComplex(R(1.0), R(0.0));
  Complex sBelow = complexMul(b.rs, phase);
  Complex pBelow = complexMul(b.rp, phase);
  Complex sSum = complexAdd(one, complexMul(a.rs, sBelow));
  Complex pSum = complexAdd(one, complexMul(a.rp, pBelow));
  Complex rs = complexDiv(complexAdd(a.rs, sBelow), sSum);
  Complex rp = complexDiv(complexAdd(a.rp, pBelow), pSum);
  mask total = andM(equalR(k3, R(0.0)), lessR(e3Re + c * c, R(0.0)));
  Film f;
  f.reflected.rs = selectR(total, R(1.0), minR(complexNormSq(rs), R(1.0)));
  f.reflected.rp = selectR(total, R(1.0), minR(complexNormSq(rp), R(1.0)));
  // X = r_p conj(r_s), of the size that the powers have: where 1 + .. nearly vanishes both are rounding.
  real xRe = rp.re * rs.re + rp.im * rs.im;
  real xIm = rp.im * rs.re - rp.re * rs.im;
  real size = sqrtR(xRe * xRe + xIm * xIm);
  real scale = sqrtR(f.reflected.rs * f.reflected.rp) / selectR(lessR(R(0.0), size), size, R(1.0));
  f.reflected.xRe = xRe * scale;
  f.reflected.xIm = xIm * scale;

  // A film takes nothing: T = 1 - R. t_p/t_s = n1 nf/(k^2 + q1 q2) nf n3/(k^2 + q2 q3) (1 + ..)_s/(1 + ..)_p gives
  // the phase.
  f.through.rs = R(1.0) - f.reflected.rs;
  f.through.rp = R(1.0) - f.reflected.rp;
  Complex first = complexMul(q1, q2);
  Complex second = complexMul(q2, q3);
  first.re = first.re + sinSq;
  second.re = second.re + sinSq;
  Complex ratio = complexDiv(sSum, complexMul(pSum, complexMul(first, second)));
  real ratioSize = sqrtR(complexNormSq(ratio));
  real y = sqrtR(f.through.rs * f.through.rp);
  mask noPhase = orM(lessR(R(0.0), k3), lessEqualR(ratioSize, R(0.0)));
  real ySize = y / selectR(noPhase, R(1.0), ratioSize);
  f.through.xRe = selectR(noPhase, y, ratio.re * ySize);
  f.through.xIm = selectR(noPhase, R(0.0), ratio.im * ySize);
  return f;
}

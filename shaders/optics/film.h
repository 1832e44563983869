// Thin film: a plane layer of real index on a dielectric or a conductor, all internal reflections summed with their
// phases (Airy's formula). Signs and time dependence as in fresnel.h. Source: Born and Wolf, Principles of Optics, 7th
// edition, 1.6.4.

struct Film {
  Reflectance reflected;
  Reflectance through;  // transmission into a dielectric, with X = t_p conj(t_s); for a conductor 1 - R, no phase
};

// Amplitudes of one interface of the stack, from medium j to medium k.
struct FilmInterface {
  Complex rs;
  Complex rp;
};
// r_s = (n_j^2 - n_k^2)/(q_j + q_k)^2, r_p = r_s (k^2 - q_j q_k)/(k^2 + q_j q_k). kSq: square of the wave vector's
// component parallel to the surface; qj, qk: its components normal to it; difference: n_j^2 - n_k^2. All relative to
// the first medium.
FN FilmInterface filmInterface(real kSq, Complex qj, Complex qk, Complex difference) {
  FilmInterface f;
  Complex sum = complexAdd(qj, qk);
  Complex product = complexMul(qj, qk);
  f.rs = complexDiv(difference, complexMul(sum, sum));
  f.rp = complexMul(
      f.rs, complexDiv(makeComplex(kSq - product.re, R(0.0) - product.im), makeComplex(kSq + product.re, product.im)));
  return f;
}

// Scales an amplitude whose components exceed 1, as rounding makes them where 1 + r12 r23 e nearly vanishes, so that no
// product of two amplitudes overflows.
FN Complex limitComponents(Complex a) {
  real scale = R(1.0) / maxR(R(1.0), maxR(absR(a.re), absR(a.im)));
  return makeComplex(a.re * scale, a.im * scale);
}

// Film of index nf between a medium of index n1 and one of index n3 - i k3. The differences are more accurate than
// those of the rounded indices, which do not determine them.
struct FilmLayers {
  real n1;
  real nf;
  real n3;
  real k3;
  real filmStep;        // nf - n1
  real baseStep;        // n3 - n1
  real filmOverBase;    // nf - n3
  real roundTripPhase;  // twice the film's thickness over the wavelength in vacuum: the phase of a round trip at normal
                        // incidence in units of 2 pi / nf
};

// Reflection and transmission of a film. c: cosine of the angle of incidence in the first medium.
FN Film filmResponse(real c, FilmLayers layers) {
  real n1 = layers.n1;
  real nf = layers.nf;
  real n3 = layers.n3;
  real k3 = layers.k3;
  real roundTripPhase = layers.roundTripPhase;
  real inverse = R(1.0) / n1;
  real inverseSq = inverse * inverse;
  real sinSq = (R(1.0) - c) * (R(1.0) + c);
  // Components normal to the surface: q^2 = (n/n1)^2 - sin^2, from n^2 - n1^2 and c^2.
  real eF = (layers.filmStep * (nf + n1)) * inverseSq;
  real e3Re = (layers.baseStep * (n3 + n1) - k3 * k3) * inverseSq;
  real e3Im = R(-2.0) * n3 * k3 * inverseSq;
  Complex q1 = makeComplex(c, R(0.0));
  Complex q2 = complexSqrtLower(eF + c * c, R(0.0));
  Complex q3 = complexSqrtLower(e3Re + c * c, e3Im);
  FilmInterface a = filmInterface(sinSq, q1, q2, makeComplex(R(0.0) - eF, R(0.0)));
  real differenceRe = (layers.filmOverBase * (nf + n3) + k3 * k3) * inverseSq;
  FilmInterface b = filmInterface(sinSq, q2, q3, makeComplex(differenceRe, R(0.0) - e3Im));
  // Round trip through the film: e = e^{-2 i beta}.
  Complex rotation = cisTwoPi(roundTripPhase * n1 * q2.re);
  real decay = attenuation(R(0.0) - R(6.28318530717958647693) * roundTripPhase * n1 * q2.im);
  Complex phase = makeComplex(rotation.re * decay, (R(0.0) - rotation.im) * decay);

  // r = (r12 + r23 e) / (1 + r12 r23 e)
  Complex one = makeComplex(R(1.0), R(0.0));
  Complex sBelow = complexMul(b.rs, phase);
  Complex pBelow = complexMul(b.rp, phase);
  Complex sSum = complexAdd(one, complexMul(a.rs, sBelow));
  Complex pSum = complexAdd(one, complexMul(a.rp, pBelow));
  Complex rs = complexDiv(complexAdd(a.rs, sBelow), sSum);
  Complex rp = complexDiv(complexAdd(a.rp, pBelow), pSum);
  rs = limitComponents(rs);
  rp = limitComponents(rp);
  mask total = andM(equalR(k3, R(0.0)), lessR(e3Re + c * c, R(0.0)));
  Film f;
  f.reflected.rs = selectR(total, R(1.0), minR(complexNormSq(rs), R(1.0)));
  f.reflected.rp = selectR(total, R(1.0), minR(complexNormSq(rp), R(1.0)));
  // X = r_p conj(r_s), scaled to sqrt(R_s R_p): where 1 + r12 r23 e nearly vanishes its size is rounding error.
  real xRe = rp.re * rs.re + rp.im * rs.im;
  real xIm = rp.im * rs.re - rp.re * rs.im;
  real size = sqrtR(xRe * xRe + xIm * xIm);
  real scale = sqrtR(f.reflected.rs * f.reflected.rp) / selectR(lessR(R(0.0), size), size, R(1.0));
  f.reflected.xRe = xRe * scale;
  f.reflected.xIm = xIm * scale;

  // The film absorbs nothing: T = 1 - R. The phase is that of
  // t_p/t_s = n1 nf/(k^2 + q1 q2) nf n3/(k^2 + q2 q3) (1 + r12 r23 e)_s/(1 + r12 r23 e)_p.
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
FN Film thinFilm(real c, real n1, real nf, real roundTripPhase, real n3, real k3) {
  FilmLayers layers;
  layers.n1 = n1;
  layers.nf = nf;
  layers.n3 = n3;
  layers.k3 = k3;
  layers.filmStep = nf - n1;
  layers.baseStep = n3 - n1;
  layers.filmOverBase = nf - n3;
  layers.roundTripPhase = roundTripPhase;
  return filmResponse(c, layers);
}

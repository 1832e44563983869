// Complex numbers: the operations that refraction needs.

struct Complex {
  real re;
  real im;
};

FN Complex makeComplex(real re, real im) {
  Complex z;
  z.re = re;
  z.im = im;
  return z;
}
FN Complex complexAdd(Complex a, Complex b) { return makeComplex(a.re + b.re, a.im + b.im); }
FN Complex complexSub(Complex a, Complex b) { return makeComplex(a.re - b.re, a.im - b.im); }
FN Complex complexMul(Complex a, Complex b) {
  return makeComplex(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}
FN real complexNormSq(Complex a) { return a.re * a.re + a.im * a.im; }
// Quotient a / b, scaled against overflow; 0 where b = 0, because every 0/0 of the optics is an absent interface.
FN Complex complexDiv(Complex a, Complex b) {
  real m = maxR(absR(b.re), absR(b.im));
  real scale = R(1.0) / divisor(m);
  Complex c = makeComplex(b.re * scale, b.im * scale);
  real inverse = scale / divisor(complexNormSq(c));
  return makeComplex((a.re * c.re + a.im * c.im) * inverse, (a.im * c.re - a.re * c.im) * inverse);
}

// Square root of zRe + i zIm on the branch Im <= 0, whatever the sign of zIm. The larger part is
// sqrt((|z| + |Re z|)/2), the other |Im z| / (2 larger): the direct form loses digits to cancellation.
FN Complex complexSqrtLower(real zRe, real zIm) {
  real zAbs = sqrtR(zRe * zRe + zIm * zIm);
  real larger = sqrtR(R(0.5) * (zAbs + absR(zRe)));
  real smaller = absR(zIm) / divisor(R(2.0) * larger);
  mask positive = lessEqualR(R(0.0), zRe);
  return makeComplex(selectR(positive, larger, smaller), R(0.0) - selectR(positive, smaller, larger));
}

// e^{2 pi i x}: cosine and sine of 2 pi x, by Taylor series of the half angle up to x^21, which is exact in double. No
// library function is used, so that every device gives the same result.
FN Complex cisTwoPi(real x) {
  real z = (x - floorR(x + R(0.5))) * R(3.14159265358979323846);  // half the angle, in [-pi/2, pi/2]
  real zSq = z * z;
  real s =
      z * (R(1.0) -
           zSq / R(6.0) *
               (R(1.0) -
                zSq / R(20.0) *
                    (R(1.0) -
                     zSq / R(42.0) *
                         (R(1.0) -
                          zSq / R(72.0) *
                              (R(1.0) -
                               zSq / R(110.0) *
                                   (R(1.0) -
                                    zSq / R(156.0) *
                                        (R(1.0) - zSq / R(210.0) *
                                                      (R(1.0) - zSq / R(272.0) *
                                                                    (R(1.0) - zSq / R(342.0) *
                                                                                  (R(1.0) - zSq / R(420.0)))))))))));
  real c =
      R(1.0) -
      zSq / R(2.0) *
          (R(1.0) -
           zSq / R(12.0) *
               (R(1.0) -
                zSq / R(30.0) *
                    (R(1.0) -
                     zSq / R(56.0) *
                         (R(1.0) -
                          zSq / R(90.0) *
                              (R(1.0) - zSq / R(132.0) *
                                            (R(1.0) - zSq / R(182.0) *
                                                          (R(1.0) - zSq / R(240.0) *
                                                                        (R(1.0) - zSq / R(306.0) *
                                                                                      (R(1.0) - zSq / R(380.0))))))))));
  return makeComplex(c * c - s * s, R(2.0) * s * c);
}

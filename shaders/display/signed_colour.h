// Colours of values from -1 to 1, such as S1/S0: blue, grey at 0, red. In sRGB, 0 to 1. For C++ (legend of the viewer)
// and GLSL (present.comp).
FN real3 signedColour(real value) {
  real t = value < R(-1) ? R(-1) : value > R(1) ? R(1) : value;
  real weight = t < 0 ? -t : t;
  real3 end;
  end.x = t < 0 ? R(0.13) : R(0.84);
  end.y = t < 0 ? R(0.40) : R(0.15);
  end.z = t < 0 ? R(0.85) : R(0.16);
  real3 c;
  c.x = R(0.30) + weight * (end.x - R(0.30));
  c.y = R(0.30) + weight * (end.y - R(0.30));
  c.z = R(0.30) + weight * (end.z - R(0.30));
  return c;
}

// The methods that follow the eye's path in a loop: what a surface does is applied to what the path carries on its way
// out, so nothing comes back along rays. Glass is followed along the mirror direction first; the refracted way waits
// on a stack, on which at most one waits for every interaction of a path. Included after a file of shaders/loops and
// the surfaces; beside what they call the renderer supplies `materials[]`, kStackSize (the view's depth at least, 1
// without glass) and findHit(origin, direction, depth, hit).

struct EyePath {
  real3 origin;
  real3 d;
  real depth;  // specular interactions left
  Carried carried;
};

FN real3 followEyePath(real3 direction) {
  EyePath waiting[kStackSize];
  int count = 0;
  real3 sum = splat3(R(0.0));
  EyePath p;
  p.origin = frame.eye;
  p.d = direction;
  p.depth = real(frame.depth);
  p.carried = carriedStart(direction, frame.up, frame.analyser.x, frame.analyser.y, frame.analyser.z, frame.analyser.w);
  bool follows = true;
  while (follows) {
    follows = false;
    real3 seen = splat3(R(0.0));
    real3 light = splat3(R(0.0));  // what is seen, as it leaves its source: the size of its roundings
    Hit h;
    if (!findHit(p.origin, p.d, p.depth, h)) {
      h = missedHit(p.d, p.depth);
      light = environmentRadiance(p.d);
      seen = carriedSource(p.carried, light);
    } else {
      Material m = materials[h.material];
      if (m.kind == kEmitter) {
        if (h.outside) light = m.radiance;
        seen = carriedSource(p.carried, light);
      } else if (m.kind == kLambert) {
        light = directLight(h, m, h.normal).diffuse;
        seen = carriedSource(p.carried, light);
      } else if (m.kind != kGlass || h.depth > R(0.5)) {
        GlassWay way;
        way.total = true;
        bool metal = m.kind == kMetal;
        bool glass = m.kind == kGlass;
        Factors f;
        if (glass) {
          way = glassWay(h, m);
          f = dielectricFactors(h.c, way.n1, way.n2);
        } else if (metal) {
          f = conductorFactors(h.c, m.outsideEta, m.eta, m.k);
        } else {
          f = dielectricFactors(h.c, m.outsideEta, m.eta.y);
        }
        carriedMeet(p.carried, h.d, h.normal);
        real3 mirror = mirrorDirection(h.d, h.normal, h.c);
        DirectLight direct = directLight(h, m, mirror);
        light = direct.diffuse + direct.highlight;
        if (!glass) seen = carriedLeave(p.carried, f, direct.diffuse);
        if (h.depth > R(0.5)) {
          if (glass && !way.total) {
            waiting[count].origin = originBelow(h);
            waiting[count].d = way.through;
            waiting[count].depth = h.depth - R(1.0);
            waiting[count].carried = p.carried;
            carriedTransmit(waiting[count].carried, f);
            if (carriedMost(waiting[count].carried) > R(0.0)) count = count + 1;
          }
          carriedReflect(p.carried, f, metal);
          seen = seen + carriedSource(p.carried, direct.highlight);
          // A row whose first number is 0 has nothing left: |(q, u, v)| is no larger.
          follows = carriedMost(p.carried) > R(0.0);
          p.origin = originAbove(h);
          p.d = mirror;
          p.depth = h.depth - R(1.0);
        }
      }
    }
    if (kCheckNumerics) {
      // What reaches the eye from here, and what the path goes on with, which must be a number too.
      real none = R(0.0);
      real most = carriedMost(p.carried);
      real3 checked = isFinite(most) ? seen : splat3(most);
      real3 slack = light * (R(64.0) * kUnitRoundoff * frame.analyser.x);
      checkColour(h, checked.x, none, none, none, slack.x, 0u);
      checkColour(h, checked.y, none, none, none, slack.y, 1u);
      checkColour(h, checked.z, none, none, none, slack.z, 2u);
    }
    sum = sum + seen;
    if (!follows && count > 0) {
      count = count - 1;
      p = waiting[count];
      follows = true;
    }
  }
  return sum;
}

// Mean over the fixed grid of samples of a pixel, behind the filter.
FN real3 eyePathPixel(uint x, uint y) {
  real3 sum = splat3(R(0.0));
  for (uint j = 0u; j < frame.samples; ++j)
    for (uint i = 0u; i < frame.samples; ++i) {
      real px = (real(x) + (real(i) + R(0.5)) / real(frame.samples)) / real(frame.width);
      real py = (real(y) + (real(j) + R(0.5)) / real(frame.samples)) / real(frame.height);
      sum = sum + followEyePath(cameraDirection(frame.right, frame.up, frame.forward, frame.tanX, frame.tanY, px, py));
    }
  return sum * (frame.basicToRadiance / real(frame.samples * frame.samples));
}

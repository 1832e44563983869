// Driver of the recursive methods without recursion, for devices that do not recurse deeply enough: a stack of the
// surfaces whose light waits for the light of their rays. Rays are traced and light is combined in the order of
// shade.h, by the same functions, so that the results differ by rounding at most. The renderer supplies findHit
// (hooks.h) and defines kPendingStackSize: at least the depth, and at least 1.

// A surface whose rays have not all returned.
struct PendingSurface {
  real3 d;                    // direction of the ray that hit it
  real3 sDir;                 // its s direction
  real3 transmittance;        // of the medium that the ray came through
  real depth;                 // specular interactions left
  SurfaceLight toCamera;      // sum of the light so far
  real3 followed;             // direction of the ray that is followed
  FresnelTerms terms;         // applied to the light that returns along it
  real3 highlight;            // joins that light
  mask transmits;             // the transmitted ray has not been followed yet
  real3 below;                // its origin
  real3 transmitted;          // its direction
  FresnelTerms transmission;  // applied to its light
#if MALUS_EFFECT_ABSORPTION
  real belowDistance;  // originDistance of the transmitted ray
#endif
#if MALUS_PATH_WORD
  word belowPath;  // its path word
#endif
};

// The rough surface whose facets are followed. Surfaces behind it count as smooth (facet.h), so that only one waits.
struct RoughSurface {
  Hit h;
  Material m;
  Facet facet;       // the one that is followed
  uint next;         // index of the next one
  SurfaceLight sum;  // of the facets before it
  int at;            // index of the surface on the stack; -1: none waits
};

// Continues with the next facet that reflects; false: there is none.
FN bool followNextFacet(INOUT(RoughSurface) rough, INOUT(Ray) ray) {
  while (rough.next < kFacets) {
    VisibleFacets visible = visibleFacetsAt(rough.h);
    rough.facet = sampleFacet(rough.h, visible, camera.facets[rough.next].x, camera.facets[rough.next].y);
    rough.next = rough.next + 1u;
    if (rough.facet.weight > R(0.0)) {
      ray = facetRay(rough.h, rough.facet, rough.next - 1u);
      return true;
    }
  }
  return false;
}

// Begins with the facets of a surface that will be at an index of the stack; false: none reflects.
FN bool followFirstFacet(INOUT(RoughSurface) rough, IN(Hit) h, IN(Material) m, int at, INOUT(Ray) ray) {
  rough.h = h;
  rough.m = m;
  rough.next = 0u;
  rough.sum = lightUnpolarized(splat3(R(0.0)));
  rough.at = -1;
  if (!followNextFacet(rough, ray)) return false;
  rough.at = at;
  return true;
}

// A surface before any of its rays is followed, and the ray to follow first: the reflected one if there is one.
FN PendingSurface meetSurface(IN(Hit) h, IN(Material) m, IN(Scattering) s, OUT(Ray) first, OUT(real3) slack) {
  PendingSurface p;
  DirectLight direct = noDirectLight();
  if (s.reflects) direct = directLight(h, m, s.reflected);
  slack = splat3(R(0.0));
  if (kCheckNumerics) slack = (direct.diffuse + direct.highlight) * (R(8.0) * kUnitRoundoff);
  p.d = h.d;
  p.sDir = surfaceS(h.d, s.frameNormal);
  p.transmittance = arrivalTransmittance(h);
  p.depth = h.depth;
  p.toCamera = lightUnpolarized(splat3(R(0.0)));
  if (hasBase(m.kind)) p.toCamera = lightFromBelow(s.reflection, direct.diffuse);
  p.highlight = direct.highlight;
  p.transmits = false;
  if (s.reflects) {
    first = rayAbove(h, s.reflected, h.depth - R(1.0));
    p.terms = s.reflection;
    p.transmits = s.transmits;
    Ray below = rayBelow(h, s.transmitted, h.depth - R(1.0));
    p.below = below.origin;
    p.transmitted = s.transmitted;
#if MALUS_EFFECT_ABSORPTION
    p.belowDistance = below.originDistance;
#endif
#if MALUS_PATH_WORD
    p.belowPath = below.path;
#endif
    p.transmission = s.transmission;
  } else {
    first = rayBelow(h, s.transmitted, h.depth - R(1.0));
    p.terms = s.transmission;
  }
  p.followed = first.d;
  return p;
}

// Adds the facet's light and follows the next facet; false: that was the last, and the surface has all its light.
FN bool facetReturned(INOUT(RoughSurface) rough, IN(Payload) returned, real3 sDir, INOUT(SurfaceLight) toCamera,
                      INOUT(Ray) ray, INOUT(real3) slack) {
  rough.sum = lightAdd(rough.sum, facetLight(rough.h, rough.m, rough.facet, returned, sDir, slack));
  if (followNextFacet(rough, ray)) return true;
  toCamera = lightAdd(toCamera, rough.sum);
  rough.at = -1;
  return false;
}

// Follows the transmitted ray of a surface whose reflected light has arrived.
FN Ray followTransmitted(INOUT(PendingSurface) p) {
  Ray ray = makeRay(p.below, p.transmitted, p.depth - R(1.0), R(0.0));
#if MALUS_EFFECT_ABSORPTION
  ray.originDistance = p.belowDistance;
#endif
#if MALUS_PATH_WORD
  ray.path = p.belowPath;
#endif
  p.followed = p.transmitted;
  p.terms = p.transmission;
  p.highlight = splat3(R(0.0));
  p.transmits = false;
  return ray;
}

// Light along a ray.
FN Payload traceRay(Ray ray) {
  CONST int kCheckedStackSize = kCheckNumerics ? kPendingStackSize : 1;
  PendingSurface stack[kPendingStackSize];
  Hit hits[kCheckedStackSize];  // of the surfaces on the stack, for reports
  real3 slacks[kCheckedStackSize];
  RoughSurface rough;
  rough.at = -1;
  int count = 0;
  Payload sent;
  bool follows = true;
  while (follows) {
    follows = false;
    Hit h;
    if (!findHit(ray, h)) {
      sent = shadeEnvironment(ray.d, ray.depth);
    } else {
      Material m = materialAt(h);
      if (isSource(m.kind)) {
        sent = shadeSource(h, m, m.kind);
      } else if (!canScatter(h) && !hasBase(m.kind)) {
        sent = black();
      } else {
        Scattering s = surfaceScattering(h, m, m.kind);
        real3 slack;
        PendingSurface p = meetSurface(h, m, s, ray, slack);
        follows = canScatter(h);
        if (kEffectRoughness) {
          if (follows && isRough(h)) {
            p.toCamera = lightAdd(p.toCamera, lightThroughInterface(p.terms, lightUnpolarized(p.highlight)));
            follows = followFirstFacet(rough, h, m, count, ray);
          }
        }
        if (follows) {
          stack[count] = p;
          if (kCheckNumerics) {
            hits[count] = h;
            slacks[count] = slack;
          }
          count = count + 1;
        } else {
          sent = sentPayload(p.toCamera, p.d, p.sDir, p.transmittance);
          if (kCheckNumerics) checkSent(h, sent, slack);
        }
      }
    }
    while (!follows && count > 0) {
      int top = count - 1;
      real3 slack = splat3(R(0.0));
      if (kCheckNumerics) slack = slacks[top];
      bool isFacet = false;
      if (kEffectRoughness) {
        isFacet = rough.at == top;
        if (isFacet) follows = facetReturned(rough, sent, stack[top].sDir, stack[top].toCamera, ray, slack);
      }
      if (!isFacet) {
        SurfaceLight arriving = returnedLight(sent, stack[top].followed, stack[top].sDir, slack);
        arriving = lightAdd(arriving, lightUnpolarized(stack[top].highlight));
        stack[top].toCamera = lightAdd(stack[top].toCamera, lightThroughInterface(stack[top].terms, arriving));
        follows = stack[top].transmits;
        if (follows) ray = followTransmitted(stack[top]);
      }
      if (kCheckNumerics) slacks[top] = slack;
      if (!follows) {
        sent = sentPayload(stack[top].toCamera, stack[top].d, stack[top].sDir, stack[top].transmittance);
        if (kCheckNumerics) checkSent(hits[top], sent, slack);
        count = top;
      }
    }
  }
  return sent;
}

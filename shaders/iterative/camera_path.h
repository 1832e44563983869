// The methods that follow the eye's path in a loop: what a surface does is applied to what the path carries on its way
// out, so nothing comes back along rays. Glass is followed along the mirror direction first; the refracted ray is
// pushed on a stack, which holds at most one ray per interaction of a path and the facets of one rough surface.
// Included after a file of shaders/iterative. The renderer defines kPathStackSize: at least the depth (1 without glass),
// and kFacets more with rough surfaces.
#include "shaders/surfaces/steps.h"

struct CameraPath {
  real3 origin;
  real3 d;
  real depth;  // specular interactions left
  Throughput throughput;
};

// behind: first row of the Mueller matrix in front of the camera.
FN real3 traceCameraPath(real3 direction, real behind0, real behind1, real behind2, real behind3) {
  CameraPath waiting[kPathStackSize];
  int count = 0;
  real3 sum = splat3(R(0.0));
  CameraPath p;
  p.origin = camera.position;
  p.d = direction;
  p.depth = real(camera.depth);
  p.throughput = startThroughput(direction, camera.up, behind0, behind1, behind2, behind3);
  real least = camera.tolerance * behind0;  // what carries no more is not followed
  bool follows = true;
  while (follows) {
    follows = false;
    real3 seen = splat3(R(0.0));
    real3 light = splat3(R(0.0));  // what is seen, as it leaves its source: the size of its roundings
    Hit h;
    if (!findHit(p.origin, p.d, p.depth, h)) {
      h = environmentHit(p.d, p.depth);
#if MALUS_EFFECT_SKY
      real skyDegree;
      light = skyRadiance(p.d, skyDegree);
      seen = polarizedContribution(p.throughput, p.d, camera.sun, light, skyDegree);
#else
      light = environmentRadiance(p.d);
      seen = unpolarizedContribution(p.throughput, light);
#endif
    } else {
      Material m = materialAt(h);
#if MALUS_EFFECT_ABSORPTION
      scaleThroughput(p.throughput, mediumTransmittance(h, m));
#endif
      bool source = false;
#if MALUS_EFFECT_EMITTER
      if (m.kind == kEmitter) {
        source = true;
        if (h.outside) light = m.radiance;
#if MALUS_EFFECT_POLARIZED_EMITTERS
        seen = polarizedContribution(p.throughput, h.d, cross3(h.face, extras[h.material].axis), light,
                                     extras[h.material].degree);
#else
        seen = unpolarizedContribution(p.throughput, light);
#endif
      }
#endif
#if MALUS_EFFECT_LAMBERT
      if (m.kind == kLambert) {
        source = true;
        light = directLight(h, m, h.normal).diffuse;
        seen = unpolarizedContribution(p.throughput, light);
      }
#endif
#if MALUS_EFFECT_POLARIZING_ELEMENT
      if (m.kind == kPolarizingElement) {
        source = true;
        if (h.depth > R(0.5)) {
          rotateToSurface(p.throughput, h.d, polarizingElementNormal(h));
          reflectThroughput(p.throughput, polarizingElementTerms(h.material), true);
          dropPolarization(p.throughput, camera.tolerance);
          follows = maxComponent(p.throughput) > least;
          p.origin = originBelow(h);
          p.depth = h.depth - R(1.0);
        }
      }
#endif
#if MALUS_EFFECT_GLASS
      // Clear glass met with nothing left is black.
      if (m.kind == kGlass && h.depth < R(0.5)) source = true;
#endif
#if MALUS_EFFECT_PAINT || MALUS_EFFECT_METAL || MALUS_EFFECT_GLASS
      if (!source) {
        Refraction way;
        way.total = true;
#if MALUS_EFFECT_COATINGS
        way.n1 = m.outsideEta;
        way.n2 = m.eta.y;
#endif
        bool coloured = m.kind == kMetal;
        FresnelTerms f;
#if MALUS_EFFECT_GLASS
        bool glass = m.kind == kGlass;
        if (glass) {
          way = refractAtGlass(h, m);
          f = glassTerms(h.c, way.n1, way.n2, h.material);
        } else
#endif
          f = opaqueTerms(h.c, m, h.material);
#if MALUS_EFFECT_COATINGS
        coloured = coloured || hasFilm(h.material);
#endif
        rotateToSurface(p.throughput, h.d, h.normal);
        real3 mirror = mirrorDirection(h.d, h.normal, h.c);
        DirectLight direct = directLight(h, m, mirror);
        light = direct.diffuse + direct.highlight;
#if MALUS_EFFECT_GLASS
        if (!glass)
#endif
          seen = diffuseExit(p.throughput, f, direct.diffuse);
        if (h.depth > R(0.5)) {
#if MALUS_EFFECT_GLASS
          if (glass && !way.total) {
            waiting[count].origin = originBelow(h);
            waiting[count].d = way.through;
            waiting[count].depth = h.depth - R(1.0);
            waiting[count].throughput = p.throughput;
#if MALUS_EFFECT_COATINGS
            if (hasFilm(h.material))
              reflectThroughput(waiting[count].throughput,
                                filmTransmissionTerms(h.c, way.n1, extras[h.material].filmEta,
                                                      extras[h.material].roundTripPhase, splat3(way.n2)),
                                true);
            else
#endif
              transmitThroughput(waiting[count].throughput, f);
            dropPolarization(waiting[count].throughput, camera.tolerance);
            if (maxComponent(waiting[count].throughput) > least) count = count + 1;
          }
#endif
#if MALUS_EFFECT_ROUGHNESS
          bool rough = isRough(h);
          if (rough) {
            for (uint i = 0u; i < kFacets; ++i) {
              Facet facet = sampleFacet(h, i);
              if (facet.weight <= R(0.0)) continue;
              waiting[count].origin = originAbove(h);
              waiting[count].d = facet.mirror;
              waiting[count].depth = h.depth - R(1.0) + kBehindRough;
              waiting[count].throughput = p.throughput;
              rotateToSurface(waiting[count].throughput, h.d, facet.normal);
              reflectThroughput(waiting[count].throughput, opaqueTerms(facet.c, m, h.material), coloured);
              scaleThroughput(waiting[count].throughput, splat3(facet.weight));
              dropPolarization(waiting[count].throughput, camera.tolerance);
              if (maxComponent(waiting[count].throughput) > least * (R(1.0) / real(kFacets))) count = count + 1;
            }
          }
#endif
          reflectThroughput(p.throughput, f, coloured);
          seen = seen + unpolarizedContribution(p.throughput, direct.highlight);
          dropPolarization(p.throughput, camera.tolerance);
          // A row whose first number is 0 has nothing left: |(q, u, v)| is no larger.
          follows = maxComponent(p.throughput) > least;
          p.origin = originAbove(h);
          p.d = mirror;
          p.depth = h.depth - R(1.0);
#if MALUS_EFFECT_ROUGHNESS
          if (rough) follows = false;
#endif
        }
      }
#endif
    }
    if (kCheckNumerics) {
      // What reaches the eye from here, and what the path goes on with, which must be a number too.
      real none = R(0.0);
      real most = maxComponent(p.throughput);
      real3 checked = isFinite(most) ? seen : splat3(most);
      real3 slack = light * (R(64.0) * kUnitRoundoff * behind0);
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

// Mean over the fixed grid of samples of a pixel, behind an analyser.
FN real3 cameraPathPixel(uint x, uint y, real behind0, real behind1, real behind2, real behind3) {
  real3 sum = splat3(R(0.0));
  for (uint j = 0u; j < camera.samples; ++j)
    for (uint i = 0u; i < camera.samples; ++i) {
      real px = (real(x) + (real(i) + R(0.5)) / real(camera.samples)) / real(camera.width);
      real py = (real(y) + (real(j) + R(0.5)) / real(camera.samples)) / real(camera.height);
      sum = sum +
            traceCameraPath(cameraDirection(camera.right, camera.up, camera.forward, camera.tanX, camera.tanY, px, py),
                            behind0, behind1, behind2, behind3);
    }
  return sum * (camera.basicToRadiance / real(camera.samples * camera.samples));
}

// The intensity behind the camera's filter.
FN real3 cameraPathColour(uint x, uint y) {
  return cameraPathPixel(x, y, camera.analyser.x, camera.analyser.y, camera.analyser.z, camera.analyser.w);
}

// Stokes vectors in the camera's frame, by four analysers: S0, S0 + S1, S0 + S2, S0 + S3. A row that starts with 0
// would be stopped at once.
FN Stokes cameraPathStokes(uint x, uint y) {
  real3 seen[4];
  for (int k = 0; k < 4; ++k)
    seen[k] =
        cameraPathPixel(x, y, R(1.0), k == 1 ? R(1.0) : R(0.0), k == 2 ? R(1.0) : R(0.0), k == 3 ? R(1.0) : R(0.0));
  Stokes s;
  s.s0 = seen[0];
  s.s1 = seen[1] - seen[0];
  s.s2 = seen[2] - seen[0];
  s.s3 = seen[3] - seen[0];
  return s;
}

// Driver of the iterative methods, which follow the camera path in a loop: a surface is applied to the throughput of
// the path, so that nothing returns along rays. At a surface that reflects and transmits, the reflected ray is followed
// first and the transmitted one is pushed on a stack, which has room for one ray per interaction of a path and the
// facets of one rough surface. At a surface that only transmits, the ray is taken from the stack at once. Included
// after a file of shaders/iterative. The renderer defines kPathStackSize: at least the depth (1 if no surface both
// reflects and transmits), and kFacets more with rough surfaces.
// clang-format off
#include "shaders/surfaces/shared.h"
#include "shaders/iterative/path.h"
#include "shaders/iterative/path_light.h"
// clang-format on

// The path of one sample of the image.
FN CameraPath startPath(real column, real row, real behind0, real behind1, real behind2, real behind3) {
  CameraPath p;
  real3 direction = sampleDirection(column, row);
  p.ray = makeRay(sampleOrigin(column, row), direction, real(camera.depth), R(0.0));
#if MALUS_PATH_WORD
  p.ray.path = pathStart(wordOfReal(column), wordOfReal(row));
#endif
  p.throughput = startThroughput(direction, camera.up, behind0, behind1, behind2, behind3);
  return p;
}

// Checks the light that reaches the camera from here, and that the throughput is finite.
FN void checkPath(IN(Hit) h, IN(Throughput) c, IN(PathLight) light, real behind0) {
  real none = R(0.0);
  real largest = maxComponent(c);
  real3 checked = isFinite(largest) ? light.recorded : splat3(largest);
  real3 slack = light.emitted * (R(64.0) * kUnitRoundoff * behind0);
  checkColour(h, checked.x, none, none, none, slack.x, 0u);
  checkColour(h, checked.y, none, none, none, slack.y, 1u);
  checkColour(h, checked.z, none, none, none, slack.z, 2u);
}

// Radiance that the camera records at one sample, per colour, behind an analyser: behind0 to behind3 is the first row
// of its Mueller matrix.
FN real3 traceCameraPath(real column, real row, real behind0, real behind1, real behind2, real behind3) {
  CameraPath stack[kPathStackSize];
  int count = 0;
  real3 sum = splat3(R(0.0));
  CameraPath p = startPath(column, row, behind0, behind1, behind2, behind3);
  real threshold = camera.tolerance * behind0;  // paths with a smaller throughput end
  bool follows = true;
  while (follows) {
    follows = false;
    PathLight light = noLight();
    Hit h;
    if (!findHit(p.ray, h)) {
      h = environmentHit(p.ray.d, p.ray.depth);
      light = environmentLight(p.throughput, p.ray.d);
    } else {
      Material m = materialAt(h);
      if (kEffectAbsorption) scaleThroughput(p.throughput, mediumTransmittance(h));
      if (isSource(m.kind)) {
        light = sourceLight(h, m, m.kind, p.throughput);
      } else if (h.depth > R(0.5) || hasBase(m.kind)) {  // others are black where no interaction is left
        Scattering s = surfaceScattering(h, m, m.kind);
        rotateToSurface(p.throughput, h.d, s.frameNormal);
        DirectLight direct = noDirectLight();
        if (s.reflects) direct = directLight(h, m, s.reflected);
        light.emitted = direct.diffuse + direct.highlight;
        if (hasBase(m.kind)) light.recorded = diffuseExit(p.throughput, s.reflection, direct.diffuse);
        if (h.depth > R(0.5)) {
          if (s.transmits) {  // followed next if nothing else is
            stack[count].throughput = p.throughput;
            followTransmission(stack[count], h, s, camera.tolerance);
            if (maxComponent(stack[count].throughput) > threshold) count = count + 1;
          }
          bool rough = false;
          if (kEffectRoughness) rough = isRough(h);
          if (rough) {
            VisibleFacets visible = visibleFacetsAt(h);
            for (uint i = 0u; i < kFacets; ++i) {
              Facet facet = sampleFacet(h, visible, camera.facets[i].x, camera.facets[i].y);
              if (facet.weight <= R(0.0)) continue;
              stack[count].throughput = p.throughput;
              followFacet(stack[count], h, m, facet, i, s.coloured, camera.tolerance);
              if (maxComponent(stack[count].throughput) > threshold * (R(1.0) / real(kFacets))) count = count + 1;
            }
          }
          if (s.reflects) {
            applyInterface(p.throughput, s.reflection, s.coloured);
            light.recorded = light.recorded + unpolarizedContribution(p.throughput, direct.highlight);
            followReflection(p, h, s, camera.tolerance);
            // |(q, u, v)| is at most w: where w is 0 nothing is left.
            follows = maxComponent(p.throughput) > threshold && !rough;
          }
        }
      }
    }
    if (kCheckNumerics) checkPath(h, p.throughput, light, behind0);
    sum = sum + light.recorded;
    if (!follows && count > 0) {
      count = count - 1;
      p = stack[count];
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
      real column = real(x * camera.samples + i);
      real row = real(y * camera.samples + j);
      sum = sum + traceCameraPath(column, row, behind0, behind1, behind2, behind3);
    }
  return sum * (camera.basicToRadiance / real(camera.samples * camera.samples));
}

// The intensity behind the camera's filter.
FN real3 cameraPathColour(uint x, uint y) {
  return cameraPathPixel(x, y, camera.analyser.x, camera.analyser.y, camera.analyser.z, camera.analyser.w);
}

// Stokes vectors in the camera's frame, by four analysers: S0, S0 + S1, S0 + S2, S0 + S3. A row whose first number is 0
// would end the path at once.
FN Stokes cameraPathStokes(uint x, uint y) {
  real3 recorded[4];
  for (int k = 0; k < 4; ++k)
    recorded[k] =
        cameraPathPixel(x, y, R(1.0), k == 1 ? R(1.0) : R(0.0), k == 2 ? R(1.0) : R(0.0), k == 3 ? R(1.0) : R(0.0));
  Stokes s;
  s.s0 = recorded[0];
  s.s1 = recorded[1] - recorded[0];
  s.s2 = recorded[2] - recorded[0];
  s.s3 = recorded[3] - recorded[0];
  return s;
}

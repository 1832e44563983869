// Stokes vector of the radiance that the camera records at one sample, in the camera frame of that ray.
FN Stokes cameraSample(real column, real row) {
  real3 d = sampleDirection(column, row);
  real cos2;
  real sin2;
  cameraFrameRotation(d, camera.up, cos2, sin2);
  Ray ray = makeRay(camera.position, d, real(camera.depth), R(0.0));
  if (kEffectOrthographic) ray.origin = sampleOrigin(column, row);
#if MALUS_PATH_WORD
  ray.path = pathStart(wordOfReal(column), wordOfReal(row));
#endif
  Stokes s = payloadStokes(traceRay(ray), d);
  return rotateStokes(s, cos2, sin2);
}

// Mean over the fixed grid of a pixel's samples.
FN Stokes cameraPixel(uint x, uint y) {
  Stokes sum = stokesUnpolarized(splat3(R(0.0)));
  for (uint j = 0u; j < camera.samples; ++j)
    for (uint i = 0u; i < camera.samples; ++i)
      sum = stokesAdd(sum, cameraSample(real(x * camera.samples + i), real(y * camera.samples + j)));
  real scale = camera.basicToRadiance / real(camera.samples * camera.samples);
  sum.s0 = sum.s0 * scale;
  sum.s1 = sum.s1 * scale;
  sum.s2 = sum.s2 * scale;
  sum.s3 = sum.s3 * scale;
  return sum;
}

// Ray of the camera through a sample of the image; columns and rows count the samples of all pixels.

// Unit direction of the ray.
FN real3 sampleDirection(real column, real row) {
  real3 direction = cameraSampleDirection(camera.firstSample, camera.firstSampleFine, camera.columnStep,
                                          camera.columnStepFine, camera.rowStep, camera.rowStepFine, column, row);
  if (kEffectOrthographic) {
    if (camera.orthographic != 0u) direction = real3(camera.forward);
  }
  return direction;
}

// Origin of the ray.
FN real3 sampleOrigin(real column, real row) {
  real3 origin = real3(camera.position);
  if (kEffectOrthographic) {
    if (camera.orthographic != 0u)
      origin = origin + cameraSampleOffset(camera.firstSample, camera.firstSampleFine, camera.columnStep,
                                           camera.columnStepFine, camera.rowStep, camera.rowStepFine, column, row);
  }
  return origin;
}

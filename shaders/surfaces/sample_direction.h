// Unit direction of the ray through a sample of the image; columns and rows count the samples of all pixels.
FN real3 sampleDirection(real column, real row) {
  return cameraSampleDirection(camera.firstSample, camera.firstSampleFine, camera.columnStep, camera.columnStepFine,
                               camera.rowStep, camera.rowStepFine, column, row);
}

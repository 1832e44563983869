// Unit direction of the ray through a sample of the image; columns and rows count the samples of all pixels.
FN real3 sampleDirection(uint column, uint row) {
  return cameraSampleDirection(camera.firstSample, camera.firstSampleFine, camera.columnStep, camera.columnStepFine,
                               camera.rowStep, camera.rowStepFine, real(column), real(row));
}

// The colour behind the camera's filter.
FN real3 cameraColour(Stokes s) {
  return analysed(s, camera.analyser.x, camera.analyser.y, camera.analyser.z, camera.analyser.w);
}

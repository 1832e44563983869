// The colour behind the camera's filter.
FN real3 cameraColour(Stokes s) {
  return analysed(s, frame.analyser.x, frame.analyser.y, frame.analyser.z, frame.analyser.w);
}

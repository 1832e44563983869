// What surfaces/check.h reports to. The count and the first pixel come from the whole picture; the fault itself from
// a second picture of that one pixel, in which values arise one after the other.
void noteFault(Hit h, vec4 stokes, uint kind, uint colour, float slack) {
#ifdef MALUS_CHECK_NUMERICS
  uvec2 pixel = gl_LaunchIDEXT.xy + uvec2(camera.regionX, camera.regionY);
  atomicAdd(faults.count, 1u);
  atomicMin(faults.firstPixel, pixel.y * camera.width + pixel.x);
  if (camera.regionWidth * camera.regionHeight > 1u || faults.fault.kind != kNoFault) return;
  faults.fault.kind = kind;
  faults.fault.x = pixel.x;
  faults.fault.y = pixel.y;
  faults.fault.bounce = camera.depth - int(h.depth);
  faults.fault.material = h.material;
  faults.fault.colour = colour;
  faults.fault.cosine = h.c;
  faults.fault.slack = slack;
  faults.fault.position = h.position;
  faults.fault.direction = h.d;
  faults.fault.normal = h.normal;
  faults.fault.stokes = stokes;
#endif
}

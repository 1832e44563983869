// Records the faults of --check-numerics. An image of several pixels gives the count and the first pixel; an image of
// that pixel alone gives the fault, because its values occur in order.
void noteFault(Hit h, vec4 stokes, uint kind, uint colour, float slack) {
#ifdef MALUS_CHECK_NUMERICS
  uvec2 pixel = launchPixel() + uvec2(camera.regionX, camera.regionY);
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

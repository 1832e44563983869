// Pixels of the image, in the order of the channels that shaders/gpu/constants.h states.
void storeColour(uint at, vec3 value) {
  pixels[at] = value.x;
  pixels[at + 1u] = value.y;
  pixels[at + 2u] = value.z;
}

void storeStokes(uint at, Stokes s) {
  storeColour(at + 3u, s.s0);
  storeColour(at + 6u, s.s1);
  storeColour(at + 9u, s.s2);
  storeColour(at + 12u, s.s3);
}

// Index of the first channel of a pixel of the region.
uint firstChannel(uvec2 id, uint channels) { return (id.y * camera.regionWidth + id.x) * channels; }

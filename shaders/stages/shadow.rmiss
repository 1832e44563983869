// A shadow ray that nothing blocks.
layout(location = 0) rayPayloadInEXT uint shadowed;

void main() { shadowed = 0u; }

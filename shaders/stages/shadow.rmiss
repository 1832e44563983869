// Marks a shadow ray that meets no surface as not blocked.
layout(location = 0) rayPayloadInEXT uint shadowed;

void main() { shadowed = 0u; }

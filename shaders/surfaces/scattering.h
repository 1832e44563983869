// Interaction of a ray with a surface: the specular rays that follow it and the terms that multiply their light.
// Without a reflected ray its two fields are not set, and likewise for the transmitted ray.

// Rays of a kind of surface, as a compile-time constant kShape<id> beside its step: drivers of the other shapes are
// removed from its code.
CONST int kOpaqueShape = 0;        // reflects; light of a layer below may leave through the interface
CONST int kTransparentShape = 1;   // reflects and transmits
CONST int kTransmittingShape = 2;  // only transmits

struct Scattering {
  real3 frameNormal;          // the terms' frame: its x is the s direction of a surface with this normal
  FresnelTerms reflection;    // applied to light along the reflected ray
  real3 reflected;            // direction of the reflected ray, which leaves on the side of the camera
  FresnelTerms transmission;  // applied to light along the transmitted ray
  real3 transmitted;          // direction of the transmitted ray, which leaves on the other side
  mask reflects;              // there is a reflected ray
  mask transmits;             // there is a transmitted ray
  mask coloured;              // the terms may differ between colours
};

// Probes of the hard cases, in the shared language: C++ and a compute shader run the same code. The structs contain
// numbers alone, so that their layout is the same.

// One interface at one angle. The cosine is clamped to [0, 1], as at a hit.
struct SurfaceIn {
  real c;
  real n1;
  real n2;
  real k2;
  real3 light;  // S1, S2, S3 of light with S0 = 1 that is reflected and transmitted
};
struct SurfaceOut {
  Reflectance dielectric;
  Transmittance transmittance;
  Reflectance conductor;
  real schlick;
  real t;
  real tau;
  real total;                    // 1: total reflection
  real cosineThrough;            // of the refracted ray
  Transmittance back;            // from the other side, along the refracted ray
  real3 reflected0, reflected1;  // (S0, S1, S2) and (S3, -, -) of the light behind a mirror of the dielectric
  real3 metal0, metal1;          // of the conductor
  real3 through0, through1;      // through the dielectric
};

FN void parts(Stokes s, OUT(real3) a, OUT(real3) b) {
  a = make3(s.s0.x, s.s1.x, s.s2.x);
  b = make3(s.s3.x, R(0.0), R(0.0));
}

FN SurfaceOut surfaceProbe(SurfaceIn g) {
  SurfaceOut r;
  real c = clampUnit(g.c);
  RefractionTerms f = refractionTerms(c, g.n1, g.n2);
  r.dielectric = reflectanceFromTerms(c, f);
  r.transmittance = transmittanceFromTerms(c, f);
  r.conductor = conductorReflectance(c, g.n1, g.n2, g.k2);
  r.schlick = schlickReflectance(c, g.n1, g.n2, g.k2);
  r.t = f.t;
  r.tau = f.tau;
  r.total = selectR(f.total, R(1.0), R(0.0));
  r.cosineThrough = minR(f.t * g.n1 / g.n2, R(1.0));
  r.back = dielectricTransmittance(r.cosineThrough, g.n2, g.n1);
  Stokes light = stokesUnpolarized(splat3(R(1.0)));
  light.s1 = splat3(g.light.x);
  light.s2 = splat3(g.light.y);
  light.s3 = splat3(g.light.z);
  parts(stokesInterface(light, splat3(r.dielectric.rs), splat3(r.dielectric.rp), splat3(r.dielectric.xRe),
                        splat3(r.dielectric.xIm)),
        r.reflected0, r.reflected1);
  parts(stokesInterface(light, splat3(r.conductor.rs), splat3(r.conductor.rp), splat3(r.conductor.xRe),
                        splat3(r.conductor.xIm)),
        r.metal0, r.metal1);
  parts(stokesInterface(light, splat3(r.transmittance.ts), splat3(r.transmittance.tp), splat3(r.transmittance.x),
                        splat3(R(0.0))),
        r.through0, r.through1);
  return r;
}

// Frames and directions at one hit.
struct FrameIn {
  real3 d;
  real3 n;
  real n1;
  real n2;
};
struct FrameOut {
  real3 x;  // canonical frame of light against d
  real3 y;
  real3 s;
  real3 mirror;
  real3 refracted;
  real cos2;  // from x to s on the ray
  real sin2;
  real mirrorCos;  // on the mirror ray
  real mirrorSin;
  real cameraCos;  // n as the camera's up
  real cameraSin;
};
FN FrameOut frameProbe(FrameIn g) {
  FrameOut r;
  real c = clampUnit(R(0.0) - dot3(g.d, g.n));
  canonicalFrame(g.d * R(-1.0), r.x, r.y);
  r.s = sDirection(g.d, g.n);
  frameRotation(r.s, r.x, r.y, r.cos2, r.sin2);
  r.mirror = mirrorDirection(g.d, g.n, c);
  r.refracted = refractedDirection(g.d, g.n, c, g.n1, g.n2);
  real3 x;
  real3 y;
  canonicalFrame(r.mirror * R(-1.0), x, y);
  frameRotation(r.s, x, y, r.mirrorCos, r.mirrorSin);
  cameraFrameRotation(g.d, g.n, r.cameraCos, r.cameraSin);
  return r;
}

// A path of a camera ray over interfaces (chain_probe.h). kind 0: glass mirror, 1: metal, 2: window into n2.
CONST int kMaxBounces = 64;
struct BounceIn {
  real3 n;
  real n1;
  real n2;
  real k2;
  real kind;
};
struct ChainIn {
  real3 d;        // of the camera ray
  real radiance;  // of the unpolarized source at the end
  real count;
  BounceIn bounces[64];
};
struct ChainOut {
  real s0, s1, s2, s3;  // toward the camera, in the canonical frame of the camera ray
  real3 last;           // direction of the ray that meets the source
  real gained;          // maximum over the bounces of the increase of |(S1, S2, S3)| - S0, over the arriving S0
  real grown;           // maximum of the increase of S0, over the same
};

// Light on a closed path of perfect mirrors: r_s = -1, r_p = 1. d is the direction of the light, not of a camera ray.
struct IterativeIn {
  real3 d;
  real3 light;  // S1, S2, S3 in the canonical frame of d, S0 = 1
  real count;
  real3 n[64];
};
struct IterativeOut {
  real s0, s1, s2, s3;  // in the canonical frame of the last direction
  real3 last;
};

// Light passed from one surface to the next: any light, any two s directions perpendicular to one ray.
struct HandOverIn {
  real3 d;
  real3 from;   // s of the surface that sends
  real3 to;     // s of the one that receives
  real3 light;  // S1, S2, S3 in the sender's frame, over S0
  real3 radiance;
};
struct HandOverOut {
  real3 s0, s1, s2, s3;  // Stokes vector of the payload, in the ray's canonical frame
  real3 received;        // S0 at the receiver
};

// Light where a path ends.

// Whether environmentLight needs more of a throughput than unpolarizedContribution, and sourceLight of a kind.
FN bool isEnvironmentPolarized() { return kEffectSky; }
FN bool isSourcePolarized(uint kind) { return kEffectPolarizedEmitters && kind == kEmitter; }

// d: direction of the ray that leaves the scene.
FN PathLight environmentLight(IN(Throughput) c, real3 d) {
  if (kEffectSky) {
    real degree;
    real3 radiance = skyRadiance(d, degree);
    return polarizedLight(c, d, camera.sun, radiance, degree);
  }
  return unpolarizedLight(c, environmentRadiance(d));
}

// kind: Material.kind of a source (surfaces/surface_kinds.h).
FN PathLight sourceLight(IN(Hit) h, IN(Material) m, uint kind, IN(Throughput) c) {
  if (kEffectEmitter) {
    if (kind == kEmitter) return emitterLight(h, m, c);
  }
  return unpolarizedLight(c, directLight(h, m, h.normal).diffuse);
}

// Bare Lambert: unpolarized diffuse light, no interface.
FN Payload shadeLambert(Hit h, Material m) { return payloadSource(directLight(h, m, h.normal).diffuse); }

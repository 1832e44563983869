// A smooth or rough conductor; with albedo also the paper's diffuse term, which leaves with 1 - R.
FN Payload shadeMetal(IN(Hit) h, IN(Material) m) { return shadeOpaque(h, m, metalTerms(h.c, m, h.material)); }

// Lambert under a dielectric interface; without albedo it is a glass mirror.
FN Payload shadePaint(IN(Hit) h, IN(Material) m) { return shadeOpaque(h, m, paintTerms(h.c, m, h.material)); }

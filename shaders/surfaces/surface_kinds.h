// Steps of each kind of surface, selected by the rows of shaders/effects.def. kind: Material.kind, which is the same in
// all lanes.

// Whether a surface ends the path: it emits, or is diffuse without an interface.
FN bool isSource(uint kind) {
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description)
#define MALUS_SOURCE_ROW(id, macro, build, name, alias, description) \
  if (kEffect##id) {                                                 \
    if (kind == k##id) return true;                                  \
  }
#include "shaders/effects.def"
  return false;
}

// Whether diffuse light of a layer below leaves through the interface.
FN bool hasBase(uint kind) { return kind == kPaint || kind == kMetal; }

// Scattering of a surface that is not a source.
FN Scattering surfaceScattering(INOUT(Hit) h, IN(Material) m, uint kind) {
#define MALUS_SOURCE_ROW(id, macro, build, name, alias, description)
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description) \
  if (kEffect##id) {                                                  \
    if (kind == k##id) return scatter##id(h, m);                      \
  }
#include "shaders/effects.def"
  return scatterPaint(h, m);
}

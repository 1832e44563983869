// Mueller matrices of the reference's surfaces.
#pragma once

#include <cstdint>

#include "bake/pack/scene.h"
#include "render/reference/mesh_textures.h"
#include "render/reference/mueller.h"

namespace malus::reference {

// A material at a hit, with the values of its textures.
struct Surface {
  const pack::Material* material;
  dvec3 eta, k, albedo;
  dvec3 radiance, transmittance;  // emitted; of thin glass, and of the surface of a glass body
  double roughness;
  dvec3 filmPhase;  // of the coating: twice its thickness over the wavelength, per colour
};
// A material without its textures.
Surface plainSurface(const pack::Material& material, const dvec3& wavelengthsNm);
// plain: plainSurface(); textures: null without textures by texture coordinates.
Surface surfaceAt(const Surface& plain, const pack::Scene& scene, const MeshTextures* textures, const dvec3& position,
                  const f64::TextureHit& at);

struct Interface {
  Mueller reflection;
  Mueller transmission;  // T_s, T_p = 1 - R; of a metal only the weight of its diffuse light
};
// From index n1 to n2 at cosine of incidence c, with the film, the specular factor, the clear coat and the tint; a
// metal has its own index in place of n2.
Interface evaluateInterface(const Surface& surface, double c, double n1, double n2);
// Transmittance of unpolarized light, of the same interface.
dvec3 meanTransmittance(const Surface& surface, double c, double n1, double n2);

// A polarizer or wave plate in the frame whose x is its axis, seen along the ray: [[A, B], [B, A]] of the two
// transmittances, and their geometric mean times [[cos, sin], [-sin, cos]] of the retardance on (S2, S3).
Mueller polarizingElementMatrix(const pack::Material& material);

// Beer-Lambert transmittance; absorption in 1/m, distance in m.
dvec3 transmittanceOver(const dvec3& absorption, double distance);

}  // namespace malus::reference

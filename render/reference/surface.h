// What the reference's surfaces do to light, as Mueller matrices.
#pragma once

#include <cstdint>

#include "bake/pack/scene.h"
#include "render/reference/mueller.h"

namespace malus::reference {

// A material at a place, where pictures may tell its numbers.
struct Surface {
  const pack::Material* material = nullptr;
  dvec3 eta{1.0}, k{0.0}, albedo{0.0};
};
Surface surfaceAt(const pack::Scene& scene, std::uint32_t material, const dvec3& position);

struct Interface {
  Mueller reflection;
  Mueller transmission;  // T_s, T_p = 1 - R: of metals only their diffuse light's weight
  dvec3 meanTransmittance;
};
// c: cosine of incidence, from index n1 to n2 (of a metal its own index counts); its thin film included.
Interface interfaceOf(const Surface& surface, double c, double n1, double n2);

// A polarizer or wave plate, in the frame whose x is its axis seen along the ray: [[A, B], [B, A]] of the two
// transmittances, and their geometric mean times [[cos, sin], [-sin, cos]] of the retardance on (S2, S3).
Mueller sheetMatrix(const pack::Material& material);

// Beer-Lambert; absorption in 1/m.
dvec3 transmittanceOver(const dvec3& absorption, double distance);

}  // namespace malus::reference

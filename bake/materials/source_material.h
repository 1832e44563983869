// Converts the material of an imported file (glTF's terms, meshprep/read/source_scene.h) into one of malus's materials
// by the first of these rules that fits:
//
//   emissive over 0.1 of    emitter: radiance = emissive, whose cd/m^2 are taken as the scene's unit; twoSided if the
//   the base colour         material is double-sided. Fainter emission is left out, with a note, and so is the
//                           reflection beside less than 100 times the base colour
//   blended alpha a under   thin-glass: eta of the dielectric below, internal transmittance 1 - a (1 - base colour),
//   0.5, no transmission    for panes of exporters without transmission
//   transmission over 0.5   transmission x (1 - metallic), as metals are opaque. Thin-walled (glTF without a volume, or
//                           with one of thickness 0): thin-glass, eta = ior, internal transmittance at normal incidence
//                           = base colour. Otherwise glass: eta = ior, transmittance of each passage through the
//                           surface = base colour (of glTF); with a volume, absorption = -ln(attenuation colour) /
//                           attenuation distance per metre, a colour under 1e-6 counting as 1e-6, at most 1e9.
//                           Roughness and an opaque part are left out, with a note
//   metallic 0.5 or more    metal whose reflectance at normal incidence is the base colour r (0.001 to 0.999):
//                           n = (1 - r) / (1 + r), k^2 = (r (n + 1)^2 - (n - 1)^2) / (1 - r), the index with the
//                           least n (edge tint 1) of O. Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4),
//                           2014; roughness alpha
//   otherwise               a dielectric of the reflectance f = ((ior - 1) / (ior + 1))^2 x specularColour at normal
//                           incidence, 1 for an ior of 0:
//     f over 0.25 in a colour   metal of that reflectance (1 at every angle if over 0.999), albedo = base colour,
//                               roughness alpha: no clear solid has an index over 3
//     alpha 0.3 or more, a      lambert: albedo = base colour
//     specular of 0, or f 0
//     otherwise                 paint: albedo = base colour, eta = (1 + sqrt f) / (1 - sqrt f), roughness alpha
//
// Layers, of dielectrics also the specular factor as specularFactor:
//
//   clear coat on lambert   paint of eta 1.5, the share of the coat as specularFactor, the roughness of the coat
//   on eta 1.5              the base does not reflect below the coat, whose index it has: specularFactor = share + (1 -
//                           share) x specular factor; exact, of thin glass if the specular factor is 1
//   on paint, metal, glass  clearCoat of index 1.5 and the share
//   on other thin glass     left out, with a note
//   film of half or more    coating of paint, metal and glass without clearCoat; others are left out, with a note
//
// One roughness is drawn: that of the coat on paint, if its share is half or more, that of the base on metal. Another
// one is noted.
//
// KHR_materials_transmission multiplies the transmitted light by the base colour (specular_btdf x baseColor) at each
// surface: a thin wall has one, on which the Fresnel reflection of its two interfaces is not tinted; a body is entered
// and left. The base colour of MTL is that of diffuse reflection and tints nothing.
//
// alpha = roughness^2, as glTF has it; below 0.01 it is 0. Indices are clamped to 1 to 1000, the bounds of a pack.
#pragma once

#include <string>
#include <vector>

#include "bake/pack/scene.h"
#include "meshprep/read/source_scene.h"

namespace malus::bake {

// Whether the surface is not drawn: the alpha of a mask is under its cutoff, or that of a blended material is 0. Other
// alpha of masks is left out, with a note.
bool isInvisible(const prep::SourceMaterial& source);

// Reflectance of the dielectric at normal incidence, per colour.
glm::dvec3 normalReflectance(const prep::SourceMaterial& source);

// Whether a material of this reflectance at normal incidence is a metal.
bool isMetallicReflectance(const glm::dvec3& reflectance);

// GGX alpha of a roughness.
double facetAlpha(double roughness);

// Keeps the name; values are within the bounds of a pack. Adds a note for everything that is left out.
pack::Material convertMaterial(const prep::SourceMaterial& source, std::vector<std::string>& notes);

// Material of parts without one: lambert, albedo 0.8, named "default".
pack::Material defaultMaterial();

}  // namespace malus::bake

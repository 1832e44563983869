// Material files of OBJ, in the terms of glTF, by these rules:
//
//   Kd r g b        base colour of a dielectric
//   Ks r g b, Ns n  roughness^4 = 2 / (n + 2), which gives GGX's alpha the width of Phong's exponent; without Ks,
//                   with Ks 0 or illum 0 or 1 the roughness is 1
//   Ks over 0.5 in a colour and Kd under 0.1 in all: a metal whose base colour is Ks
//   Pm, Pr          metallic and roughness, in place of the two rules above
//   Ke r g b        emission
//   Ni n            index; values under 1 are noted and taken as 1.5
//   d n, Tr n       transmission 1 - n, or n
//   Tf r g b        what is left of the light after a metre of the inside; with illum 4, 6, 7 or 9 and neither d nor
//                   Tr also the transmission: its largest colour
//   illum n         see above
//   Ka, sharpness   nothing
//   map_*, bump, disp, decal, refl, norm, and statements that are not known, leave a note.
//
// One number stands for three equal ones. Numbers beyond 0 to 1 where that is the range are taken as its end.
//
// Source: Wavefront Technologies, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1, "MTL format"; the
// exponent's width: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section
// 5.2; Pm and Pr: Clara.io's extension for physically based materials.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

// The materials in the order of the file; of two with one name the first is kept and a note left. `where` is the path
// for messages. Throws Error that names where:line: a number that is not finite or missing, a statement before the
// first newmtl, bytes that are no text.
std::vector<SourceMaterial> parseMtl(std::string text, std::string_view where, std::vector<std::string>& notes);
std::vector<SourceMaterial> readMtl(const std::filesystem::path& path, std::vector<std::string>& notes);

// Gives the scene's materials, which have names, what the files say about them; earlier files win. A
// material that none of them describes leaves a note, with the files that are missing, and stays plain: matt, of base
// colour 0.8.
void describeMaterials(SourceScene& scene, const std::filesystem::path& obj, const std::vector<std::string>& files);

// The files that mtllib statements mean: the whole of a statement where that is a file, else its words.
std::vector<std::filesystem::path> listMaterialFiles(const std::filesystem::path& obj,
                                                   const std::vector<std::string>& statements);

// The mtllib statements of an OBJ file, as Polygons::materialFiles has them, without its faces. Throws Error for what
// is no text.
std::vector<std::string> listMtllibs(std::string objText, std::string_view where);

}  // namespace malus::prep

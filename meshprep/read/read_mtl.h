// Material files of OBJ, converted to the terms of glTF by these rules:
//
//   Kd r g b        base colour of a dielectric; 0.8 without Kd, 0 if the material emits
//   Ks r g b, Ns n  roughness^4 = 2 / (n + 2), with which GGX's lobe is as wide as Phong's; roughness 1 without Ks,
//   with
//                   Ks 0, and with illum 0 or 1
//   Ks, Kd          a metal with base colour Ks if a component of Ks is above 0.5 and all of Kd are below 0.1
//   Pm, Pr          metallic and roughness, instead of the two rules above
//   Ke r g b        emission
//   Ni n            index of refraction; a value below 1 leaves a note and is replaced by 1.5
//   d n, Tr n       transmission 1 - n, or n. Some programs write Tr with the meaning of d: d is used if a material has
//                   both, with a note if they contradict each other
//   Tf r g b        transmittance of a metre of the interior; with illum 4, 6, 7 or 9 and neither d nor Tr, its largest
//                   component is also the transmission
//   illum n         see above
//   Ka, sharpness   ignored
//   map_Kd          sRGB image that Kd is multiplied by; its options are ignored
//   other map_*, bump, disp, decal, refl, norm and unknown statements leave a note.
//
// Comments after a statement are accepted with a note; in a newmtl statement, blanks must enclose their '#'.
//
// A single number stands for three equal ones. Numbers out of range are clamped, with a note. A statement that is
// invalid or outside of a material is left out with a note.
//
// Source: Wavefront Technologies, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1, "MTL format"; width
// of the lobe: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Pm
// and Pr: Clara.io's extension for physically based materials.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/read/source_scene.h"

namespace malus::prep {

// Returns the materials in the order of the file, including duplicate names. `where` is the path for messages. Throws
// Error at "WHERE:LINE": bytes that are not text, too many materials or invalid statements; and if `strict`, an invalid
// statement (a number that is missing, not finite or out of range, a statement before the first newmtl).
//
// images: those of map_Kd, as SourceMaterial::baseColourImage; parseMtl gives their names in the file.
std::vector<SourceMaterial> parseMtl(std::string text, std::string_view where, std::vector<std::string>& notes,
                                     std::vector<SourceImage>& images, bool strict = false);
std::vector<SourceMaterial> readMtl(const std::filesystem::path& path, std::vector<std::string>& notes,
                                    std::vector<SourceImage>& images, bool strict = false);

// Sets the scene's materials, which must have names, by the files of the mtllib statements. The first description of a
// name is used; others leave a note. A material without description leaves a note, with the missing files, and becomes
// diffuse with base colour 0.8. If a name has no description, the description of the same name up to a '#' is used,
// with a note. A file that cannot be read leaves a note, or an Error if `strict`.
void describeMaterials(SourceScene& scene, const std::filesystem::path& obj, const std::vector<std::string>& files,
                       bool strict = false);

// Returns the files of mtllib statements: the whole argument if that is a file, otherwise its words. If there is no
// such file, backslashes are read as slashes, and quotes and the text from a '#' on are ignored.
std::vector<std::filesystem::path> listMaterialFiles(const std::filesystem::path& obj,
                                                     const std::vector<std::string>& statements);

// Returns the arguments of the mtllib statements of an OBJ file, as Polygons::materialFiles. Throws Error if the file
// is not text.
std::vector<std::string> listMtllibs(std::string objText, std::string_view where);

}  // namespace malus::prep

// Kinds of material and their traits, from bake/pack/material_kinds.def. Code asks for a trait, not for a list of
// kinds, so that a new kind is a row of that file and the code that shades it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace malus::pack {

// Kinds of material. Values are those of the pack.
enum class MaterialKind : std::uint32_t {
#define MALUS_MATERIAL_KIND(kind, value, name, surface, traits, summary) kind = (value),
#include "bake/pack/material_kinds.def"
#undef MALUS_MATERIAL_KIND
};

namespace material_traits {
inline constexpr std::uint32_t kInterface = 1 << 0;   // reflects or transmits specularly; counts towards the depth
inline constexpr std::uint32_t kDielectric = 1 << 1;  // Fresnel interface of real index
inline constexpr std::uint32_t kConductor = 1 << 2;   // Fresnel interface of complex index
inline constexpr std::uint32_t kTransmits = 1 << 3;   // specular light passes through
inline constexpr std::uint32_t kBody = 1 << 4;        // bounds a closed body that light travels through
inline constexpr std::uint32_t kPolarizing =
    1 << 5;  // polarizing element without a Fresnel interface: needs a unit axis, not along a face normal
inline constexpr std::uint32_t kEmits = 1 << 6;      // has a radiance
inline constexpr std::uint32_t kDiffuse = 1 << 7;    // may have an albedo
inline constexpr std::uint32_t kCoatable = 1 << 8;   // may have a thin film
inline constexpr std::uint32_t kRough = 1 << 9;      // may have a roughness
inline constexpr std::uint32_t kIndexMap = 1 << 10;  // may have its index in a texture
inline constexpr std::uint32_t kOpaqueInterface = kInterface | kCoatable | kRough | kIndexMap;
}  // namespace material_traits

struct MaterialKindInfo {
  MaterialKind kind;
  std::string_view name;     // in scene.json: "mirror-glass"
  std::uint32_t traits;      // of material_traits
  std::string_view summary;  // one line
};

// All kinds, in the order of their values.
inline constexpr auto kMaterialKinds = [] {
  using namespace material_traits;
  return std::to_array<MaterialKindInfo>({
#define MALUS_MATERIAL_KIND(kind, value, name, surface, traits, summary) {MaterialKind::kind, name, traits, summary},
#include "bake/pack/material_kinds.def"
#undef MALUS_MATERIAL_KIND
  });
}();

inline constexpr auto kMaterialKindCount = static_cast<std::uint32_t>(kMaterialKinds.size());

// The value of a kind is its index in kMaterialKinds.
static_assert([] {
  for (std::size_t i = 0; i < kMaterialKinds.size(); ++i)
    if (static_cast<std::size_t>(kMaterialKinds[i].kind) != i) return false;
  return true;
}());

constexpr const MaterialKindInfo& materialKindInfo(MaterialKind kind) {
  return kMaterialKinds[static_cast<std::size_t>(kind)];
}
constexpr std::string_view materialKindName(MaterialKind kind) { return materialKindInfo(kind).name; }

// The kind with a name of scene.json; nothing if there is none.
constexpr std::optional<MaterialKind> findMaterialKind(std::string_view name) {
  for (const MaterialKindInfo& info : kMaterialKinds)
    if (info.name == name) return info.kind;
  return std::nullopt;
}

// Whether the kind has any of the traits.
constexpr bool hasTrait(MaterialKind kind, std::uint32_t traits) {
  return (materialKindInfo(kind).traits & traits) != 0;
}

// Light interacts with it specularly, which counts towards the depth: everything but bare diffuse surfaces and
// emitters.
constexpr bool isInterface(MaterialKind kind) { return hasTrait(kind, material_traits::kInterface); }
// Reads an index of refraction (eta, k or a preset).
constexpr bool hasIndex(MaterialKind kind) {
  return hasTrait(kind, material_traits::kDielectric | material_traits::kConductor);
}
constexpr bool isDielectric(MaterialKind kind) { return hasTrait(kind, material_traits::kDielectric); }
constexpr bool isConductor(MaterialKind kind) { return hasTrait(kind, material_traits::kConductor); }
constexpr bool transmits(MaterialKind kind) { return hasTrait(kind, material_traits::kTransmits); }
// Specular light that passes through meets a dielectric: clear glass.
constexpr bool isClear(MaterialKind kind) { return isDielectric(kind) && transmits(kind); }
// A Fresnel interface that specular light does not pass.
constexpr bool isOpaqueInterface(MaterialKind kind) { return hasIndex(kind) && !transmits(kind); }
// Bounds a closed body: light refracts into it, and the inside may absorb.
constexpr bool hasInside(MaterialKind kind) { return hasTrait(kind, material_traits::kBody); }
constexpr bool isPolarizingElement(MaterialKind kind) { return hasTrait(kind, material_traits::kPolarizing); }
constexpr bool isEmitter(MaterialKind kind) { return hasTrait(kind, material_traits::kEmits); }
constexpr bool canBeDiffuse(MaterialKind kind) { return hasTrait(kind, material_traits::kDiffuse); }
constexpr bool canBeCoated(MaterialKind kind) { return hasTrait(kind, material_traits::kCoatable); }
constexpr bool canBeRough(MaterialKind kind) { return hasTrait(kind, material_traits::kRough); }
constexpr bool canHaveIndexMap(MaterialKind kind) { return hasTrait(kind, material_traits::kIndexMap); }
constexpr bool canHaveMaps(MaterialKind kind) { return canBeDiffuse(kind) || canHaveIndexMap(kind); }

}  // namespace malus::pack

// The effects of shaders/effects.def: an enumeration, its bits and its names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace malus::shaders {

// Kinds of surface, other parts of the shaders, then properties of scenes.
enum class Effect : std::uint32_t {
#define MALUS_EFFECT_ROW(id, name, alias, description) k##id,
#include "shaders/effects.def"
};

struct EffectInfo {
  Effect effect;
  std::string_view name;  // empty if the effect is not listed
  std::string_view alias;
  std::string_view description;
};
// Index: the value of the effect.
inline constexpr auto kEffects = std::to_array<EffectInfo>({
#define MALUS_EFFECT_ROW(id, name, alias, description) {Effect::k##id, name, alias, description},
#include "shaders/effects.def"
});

// An effect that variants of the shaders can omit.
struct CompiledEffect {
  const char* macro;       // "MALUS_EFFECT_GLASS"
  const char* identifier;  // "Glass": of a kind of surface, shadeGlass is its function
  bool isSurface;
  std::string_view build;  // smallest build of the Embree renderer that contains it
};
// Index: the value of the effect.
inline constexpr auto kCompiledEffects = std::to_array<CompiledEffect>({
#define MALUS_SURFACE_ROW(id, macro, build, name, alias, description) {"MALUS_EFFECT_" #macro, #id, true, #build},
#define MALUS_SHADER_ROW(id, macro, build, name, alias, description) {"MALUS_EFFECT_" #macro, #id, false, #build},
#include "shaders/effects.def"
});

// Bit of a compiled effect in a variant.
constexpr std::uint32_t effectBit(Effect effect) { return 1u << static_cast<std::uint32_t>(effect); }
inline constexpr std::uint32_t kEveryEffect = (1u << kCompiledEffects.size()) - 1;

constexpr std::string_view effectName(Effect effect) { return kEffects[static_cast<std::size_t>(effect)].name; }

// The listed effect with a name or an alias; nothing if there is none.
constexpr std::optional<Effect> effectNamed(std::string_view name) {
  for (const EffectInfo& e : kEffects)
    if (!e.name.empty() && (e.name == name || (!e.alias.empty() && e.alias == name))) return e.effect;
  return std::nullopt;
}

}  // namespace malus::shaders

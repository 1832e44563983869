// Every variant of every stage compiles to SPIR-V without a device, and its payload has the size that the
// method's C++ struct has.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>
#include <vector>

#include "render/scene/vulkan_path.h"
#include "render/vulkan/glsl_compiler.h"
#include "render/vulkan/variant.h"
#include "shaders/gpu/scene.h"
#include "shaders/methods/methods.h"

namespace malus::test {
namespace {

using vulkan::Stage;
using vulkan::Variant;

// Parses the sizes of ray payloads of a SPIR-V module. Opcodes from the SPIR-V specification.
class Module {
 public:
  explicit Module(const std::vector<std::uint32_t>& words) {
    for (std::size_t at = 5; at < words.size();) {
      const std::uint32_t opcode = words[at] & 0xffff, length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) throw std::runtime_error("broken SPIR-V");
      const std::uint32_t* w = &words[at];
      switch (opcode) {
        case 21:  // OpTypeInt
        case 22:  // OpTypeFloat
          sizes_[w[1]] = w[2] / 8;
          break;
        case 23:  // OpTypeVector
          sizes_[w[1]] = sizes_.at(w[2]) * w[3];
          break;
        case 30: {  // OpTypeStruct; with a run-time array it cannot be a payload
          std::uint32_t size = 0;
          bool known = true;
          for (std::uint32_t i = 2; i < length; ++i) {
            known = known && sizes_.count(w[i]) != 0;
            if (known) size += sizes_[w[i]];
          }
          if (known) sizes_[w[1]] = size;
          break;
        }
        case 32:  // OpTypePointer
          pointees_[w[1]] = w[3];
          break;
        case 59:                                                                // OpVariable
          if (w[3] == 5338) outgoing.push_back(sizes_.at(pointees_.at(w[1])));  // RayPayloadKHR
          if (w[3] == 5342) incoming.push_back(sizes_.at(pointees_.at(w[1])));  // IncomingRayPayloadKHR
          break;
        default:
          break;
      }
      at += length;
    }
  }
  std::vector<std::uint32_t> outgoing, incoming;  // bytes

 private:
  std::map<std::uint32_t, std::uint32_t> sizes_, pointees_;
};

std::vector<std::uint32_t> compiled(const Variant& variant, const vulkan::StageSource& source) {
  return vulkan::compileGlsl(vulkan::stageText(source), vulkan::preamble(variant), source.stage, source.path,
                             [&](std::string_view path) { return vulkan::includedSource(variant, path); });
}

// Sets of effects: all, those of the paper's scenes, mirrors only, metal in constant light.
using shaders::Effect;
constexpr std::uint32_t effectMask(std::initializer_list<Effect> effects) {
  std::uint32_t bits = 0;
  for (const Effect effect : effects) bits |= shaders::effectBit(effect);
  return bits;
}
constexpr std::uint32_t kLit = effectMask({Effect::kLambert, Effect::kPaint, Effect::kMetal, Effect::kGlass,
                                           Effect::kEmitter, Effect::kPointLights, Effect::kShadows,
                                           Effect::kHighlights, Effect::kAmbient, Effect::kEnvironmentMap});
constexpr std::uint32_t kSets[] = {shaders::kEveryEffect, kLit, effectMask({Effect::kPaint, Effect::kMetal}),
                                   effectMask({Effect::kMetal})};

struct MethodSize {
  const char* name;
  std::uint32_t bytes;
  friend void PrintTo(const MethodSize& m, std::ostream* out) { *out << m.name; }
};
#define MALUS_ROW(M) MethodSize{f32::M::kName, sizeof(f32::M::Payload)},
const MethodSize kMethods[] = {MALUS_FOR_EACH_METHOD(MALUS_ROW)};

class VariantsTest : public ::testing::TestWithParam<MethodSize> {};

TEST_P(VariantsTest, CompilesWithThePayloadOfItsMethod) {
  const std::uint32_t shadow = sizeof(std::uint32_t);
  for (int flags = 0; flags < 16; ++flags) {
    Variant variant;
    variant.method = GetParam().name;
    variant.effects = kSets[flags % 4];
    variant.countRays = (flags & 4) != 0;
    variant.checkNumerics = (flags & 8) != 0;
    for (const vulkan::StageSource& source : vulkan::stageSources(variant)) {
      SCOPED_TRACE(std::string(source.path) + " flags " + std::to_string(flags));
      const Module module(compiled(variant, source));
      if (source.stage == Stage::raygen) {
        EXPECT_TRUE(module.incoming.empty());
        ASSERT_FALSE(module.outgoing.empty());
        EXPECT_EQ(module.outgoing.front(), GetParam().bytes);
      } else if (source.stage == Stage::anyHit) {
        EXPECT_TRUE(module.incoming.empty());  // cut-outs read no payload
      } else {
        ASSERT_EQ(module.incoming.size(), 1u);
        const bool isShadow = source.path == "shaders/stages/shadow.rmiss";
        EXPECT_EQ(module.incoming.front(), isShadow ? shadow : GetParam().bytes);
      }
      for (const std::uint32_t size : module.outgoing) EXPECT_TRUE(size == GetParam().bytes || size == shadow) << size;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, VariantsTest, ::testing::ValuesIn(kMethods), [](const auto& given) {
  std::string name = given.param.name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

// Instruction counts of the whole pipeline of a variant.
struct Counts {
  std::size_t words = 0, traces = 0, queries = 0;
  std::vector<std::uint32_t> bindings;
};
Counts countInstructions(const Variant& variant) {
  Counts counts;
  for (const vulkan::StageSource& source : vulkan::stageSources(variant)) {
    const std::vector<std::uint32_t> words = compiled(variant, source);
    counts.words += words.size();
    std::set<std::uint32_t> tracing;  // functions that trace: their calls are trace sites
    std::vector<std::uint32_t> calls;
    std::uint32_t function = 0;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
      const std::uint32_t opcode = words[at] & 0xffff;
      if (opcode == 54) function = words[at + 2];                                         // OpFunction
      if (opcode == 57) calls.push_back(words[at + 3]);                                   // OpFunctionCall
      if (opcode == 4445) tracing.insert(function);                                       // OpTraceRayKHR
      if (opcode == 4473) ++counts.queries;                                               // OpRayQueryInitializeKHR
      if (opcode == 71 && words[at + 2] == 33) counts.bindings.push_back(words[at + 3]);  // OpDecorate Binding
    }
    for (const std::uint32_t called : calls) counts.traces += tracing.count(called);
  }
  return counts;
}

// Adding an effect to the variant of the paper's scenes adds code, buffers and rays; without it they are absent.
TEST(VariantsTest, DisabledEffectsCostNothing) {
  for (const char* method : {"stokes", "importance"}) {
    Variant off;
    off.method = method;
    off.effects = kLit;
    if (std::string(method) == "importance") {
      off.tracing = vulkan::Tracing::rayQueries;
      off.stackSize = 6;
    }
    const Counts without = countInstructions(off);
    const auto expectBinding = [&](const Counts& c, std::uint32_t binding, bool there) {
      EXPECT_EQ(std::count(c.bindings.begin(), c.bindings.end(), binding) > 0, there) << method << ' ' << binding;
    };
    for (const std::uint32_t binding : {12u, 13u, 14u, 21u, 22u, 23u}) expectBinding(without, binding, false);
    for (const Effect effect :
         {Effect::kPolarizingElement, Effect::kThinGlass, Effect::kTextures, Effect::kAbsorption, Effect::kCoatings,
          Effect::kRoughness, Effect::kSky, Effect::kPolarizedEmitters, Effect::kAreaLights, Effect::kEnvironmentLight,
          Effect::kSpecularFactors, Effect::kTintedGlass, Effect::kClearCoats}) {
      SCOPED_TRACE(std::string(method) + " " + shaders::kCompiledEffects[static_cast<std::size_t>(effect)].macro);
      Variant on = off;
      on.effects |= shaders::effectBit(effect);
      const Counts with = countInstructions(on);
      EXPECT_GT(with.words, without.words);
      expectBinding(with, 12,
                    effect != Effect::kSky && effect != Effect::kAreaLights && effect != Effect::kEnvironmentLight);
      expectBinding(with, 21, effect == Effect::kAreaLights);
      expectBinding(with, 23, effect == Effect::kEnvironmentLight);
      expectBinding(with, 13, effect == Effect::kTextures);
      // Effects that trace additional rays add trace sites; an iterative method always has two.
      const bool traces =
          effect == Effect::kPolarizingElement || effect == Effect::kThinGlass || effect == Effect::kRoughness;
      if (off.stackSize == 0)
        EXPECT_EQ(with.traces > without.traces, traces);
      else
        EXPECT_EQ(with.queries, without.queries);
    }
    // Conversely, a scene of mirrors needs less than this variant.
    Variant mirrors = off;
    mirrors.effects = effectMask({Effect::kPaint, Effect::kMetal});
    const Counts few = countInstructions(mirrors);
    EXPECT_LT(few.words, without.words);
    if (off.stackSize == 0)  // the camera's rays, a mirror ray from either surface
      EXPECT_EQ(few.traces, 3u);
    else  // no shadow ray
      EXPECT_EQ(few.queries, 1u);
    for (const Effect effect : {Effect::kPointLights, Effect::kShadows, Effect::kAmbient, Effect::kHighlights,
                                Effect::kEnvironmentMap, Effect::kGlass, Effect::kLambert, Effect::kEmitter}) {
      Variant less = off;
      less.effects &= ~shaders::effectBit(effect);
      EXPECT_LT(countInstructions(less).words, without.words)
          << shaders::kCompiledEffects[static_cast<std::size_t>(effect)].macro;
    }
  }
}

TEST(VariantsTest, StageCounts) {
  // Ray generation, two misses, a closest hit per kind of surface, the any hit of cut-outs; without lights and with one
  // kind, three.
  EXPECT_EQ(vulkan::stageSources({}).size(), 4u + std::size_t{gpu::kSurfaceKinds});
  Variant metal;
  metal.effects = effectMask({Effect::kMetal});
  EXPECT_EQ(vulkan::stageSources(metal).size(), 3u);
}

// A method that traces from its ray generation shader alone, with a set of effects and of other properties.
Variant withoutRecursion(const char* method, vulkan::Tracing tracing, int flags) {
  Variant variant;
  variant.method = method;
  variant.tracing = tracing;
  variant.stackSize = 6;
  variant.effects = kSets[flags % 4];
  variant.fourAnalysers = (flags & 4) != 0;
  variant.countRays = (flags & 8) == 0;
  variant.checkNumerics = (flags & 8) != 0;
  return variant;
}

#define MALUS_NAME(M) f32::M::kName,
const char* const kEveryMethod[] = {MALUS_FOR_EACH_METHOD(MALUS_NAME) MALUS_FOR_EACH_ITERATIVE(MALUS_NAME)};

TEST(VariantsTest, RayQueriesNeedOneStageAndNoPayload) {
  for (const char* method : kEveryMethod)
    for (int flags = 0; flags < 16; flags += 5) {  // each set, and each property with and without
      const Variant variant = withoutRecursion(method, vulkan::Tracing::rayQueries, flags);
      SCOPED_TRACE(std::string(method) + " flags " + std::to_string(flags));
      ASSERT_EQ(vulkan::stageSources(variant).size(), 1u);
      const Module module(compiled(variant, vulkan::stageSources(variant).front()));
      EXPECT_TRUE(module.incoming.empty());
      EXPECT_TRUE(module.outgoing.empty());
    }
}

TEST(VariantsTest, HitRecordsAreTheOnlyPayload) {
  for (const char* method : kEveryMethod)
    for (int flags = 0; flags < 16; flags += 5) {  // each set, and each property with and without
      const Variant variant = withoutRecursion(method, vulkan::Tracing::hitRecords, flags);
      const std::vector<vulkan::StageSource> sources = vulkan::stageSources(variant);
      ASSERT_EQ(sources.size(), vulkan::has(variant, Effect::kCutOuts) ? 4u : 3u);
      for (const vulkan::StageSource& source : sources) {
        SCOPED_TRACE(std::string(method) + " flags " + std::to_string(flags) + " " + source.path);
        const Module module(compiled(variant, source));
        const std::vector<std::uint32_t> one = {static_cast<std::uint32_t>(render::kHitRecordBytes)}, none;
        const bool readsPayload = source.stage != Stage::raygen && source.stage != Stage::anyHit;
        EXPECT_EQ(module.outgoing, source.stage == Stage::raygen ? one : none);
        EXPECT_EQ(module.incoming, readsPayload ? one : none);
      }
      EXPECT_EQ(countInstructions(variant).queries, 0u);
    }
}

}  // namespace
}  // namespace malus::test

// Every variant of every stage compiles to SPIR-V without a device, and its payload has the size that the
// method's C++ struct has.
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "render/vulkan/glsl_compiler.h"
#include "render/vulkan/variant.h"
#include "shaders/methods/methods.h"

namespace malus::test {
namespace {

using vulkan::Stage;
using vulkan::Variant;

// As much of a SPIR-V module as the sizes of its ray payloads need. Numbers from the SPIR-V specification.
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
        case 30: {  // OpTypeStruct; one with a member of unknown size (a run-time array) is no payload
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
    variant.pointLights = (flags & 1) != 0;
    variant.fill = (flags & 2) != 0;
    variant.countRays = (flags & 4) != 0;
    variant.checkNumerics = flags == 3;
    variant.highlights = variant.environmentMap = (flags & 8) != 0;
    for (const vulkan::StageSource& source : vulkan::stageSources(variant)) {
      SCOPED_TRACE(std::string(source.path) + " flags " + std::to_string(flags));
      const Module module(compiled(variant, source));
      if (source.stage == Stage::raygen) {
        EXPECT_TRUE(module.incoming.empty());
        ASSERT_FALSE(module.outgoing.empty());
        EXPECT_EQ(module.outgoing.front(), GetParam().bytes);
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

TEST(VariantsTest, EveryStageIsThere) {
  // Ray generation, two misses, a closest hit for each of five kinds of surface.
  EXPECT_EQ(vulkan::stageSources({}).size(), 8u);
}

TEST(VariantsTest, LoopsHaveOneStageAndNoPayload) {
#define MALUS_NAME(M) f32::M::kName,
  for (const char* loop : {MALUS_FOR_EACH_LOOP(MALUS_NAME)})
    for (int flags = 0; flags < 16; ++flags) {
      Variant variant;
      variant.method = loop;
      variant.stackSize = 6;
      variant.pointLights = (flags & 1) != 0;
      variant.fill = (flags & 2) != 0;
      variant.countRays = (flags & 4) != 0;
      variant.checkNumerics = (flags & 8) != 0;
      SCOPED_TRACE(std::string(loop) + " flags " + std::to_string(flags));
      ASSERT_EQ(vulkan::stageSources(variant).size(), 1u);
      const Module module(compiled(variant, vulkan::stageSources(variant).front()));
      EXPECT_TRUE(module.incoming.empty());
      EXPECT_TRUE(module.outgoing.empty());
    }
}

}  // namespace
}  // namespace malus::test

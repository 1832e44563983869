// Methods that are a header and a row outside shaders/: both formulations render and compile to SPIR-V.
#include <string>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "render/vulkan/glsl_compiler.h"
#include "render/vulkan/variant.h"
#include "tests/render/test_scene.h"

namespace malus::render {
namespace {

// A mirror of black glass in an environment of radiance 1.
pack::Scene mirrorScene() {
  pack::Scene scene = test::emptyScene(1);
  test::addSquare(scene, test::addMaterial(scene, test::dielectric(pack::MaterialKind::mirrorGlass, 1.5)), {0, 0, 0},
                  {0, 0, 1}, 1);
  scene.environment.radiance = glm::dvec3(1);
  test::look(scene, {0, 0, 1}, {0, 0, 0});
  return scene;
}

class ExtraMethod : public ::testing::TestWithParam<const char*> {};

TEST_P(ExtraMethod, RendersWithEmbree) {
  const pack::Scene scene = mirrorScene();
  embree::Renderer renderer(scene, 1);
  const RenderParameters parameters = defaultParameters(scene);
  EXPECT_EQ(renderer.render(GetParam(), parameters).pixels, std::vector<float>(3, 1.0f));
  EXPECT_LT(renderer.render("fresnel", parameters).pixels[0], 0.05f);
}

TEST_P(ExtraMethod, CompilesToSpirv) {
  const pack::Scene scene = mirrorScene();
  for (const vulkan::Tracing tracing :
       {vulkan::Tracing::recursion, vulkan::Tracing::hitRecords, vulkan::Tracing::rayQueries}) {
    if (tracing == vulkan::Tracing::recursion && methodNamed(GetParam()).isIterative) continue;
    const vulkan::Variant variant = vulkan::variantFor(scene, GetParam(), defaultParameters(scene), tracing);
    for (const vulkan::StageSource& source : vulkan::stageSources(variant))
      EXPECT_FALSE(vulkan::compileGlsl(vulkan::stageText(source), vulkan::preamble(variant), source.stage, source.path,
                                       [&](std::string_view path) { return vulkan::includedSource(variant, path); })
                       .empty())
          << source.path;
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, ExtraMethod, ::testing::Values("perfect-mirror", "perfect-iterative"),
                         [](const auto& given) {
                           return std::string(given.param) == "perfect-mirror" ? "Recursive" : "Iterative";
                         });

TEST(ExtraMethod, RowsFollowTheBuiltInOnes) {
  ASSERT_GE(methods().size(), 2u);
  const MethodInfo& recursive = methods()[methods().size() - 2];
  EXPECT_EQ(recursive.name, "perfect-mirror");
  EXPECT_EQ(recursive.payloadBytes, 12u);
  EXPECT_EQ(methodNamed("mirror").name, recursive.name);
  EXPECT_TRUE(methods().back().isIterative);
  EXPECT_EQ(baselineMethod().name, "schlick");
}

}  // namespace
}  // namespace malus::render

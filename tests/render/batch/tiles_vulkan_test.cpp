// Frames in tiles by the Vulkan renderer.
#include "render/batch/merge.h"
#include "tests/render/batch/batch_folder.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::render {
namespace {

using TilesVulkan = test::BatchFolder;

TEST_F(TilesVulkan, MergeToTheSingleRun) {
  FrameDefaults defaults = test::batchDefaults();
  defaults.job.backend = Backend::vulkan;
  defaults.outputs = FrameOutputs({"exr", "png", "truth"}, "");
  const Jobs frames = jobs("{\"width\": 259, \"height\": 21}\n{\"width\": 30, \"height\": 258}\n");
  pack::Pack pack;
  pack.hash = 7;
  pack.scene = test::goldAndPaintScene();
  FrameRenderer renderer(std::move(pack), Backend::vulkan, "", 1);
  runBatch({sub("whole"), defaults, 0, {}}, frames, renderer);
  for (std::uint64_t k = 0; k < 2; ++k)
    EXPECT_EQ(runBatch({sub("part" + std::to_string(k)), defaults, 0, {k, 2}, true}, frames, renderer).rendered, 2u);
  EXPECT_EQ(mergeBatches({sub("part0"), sub("part1")}, sub("merged")), 2u);
  expectEqualFolders(sub("merged"), sub("whole"));
}

}  // namespace
}  // namespace malus::render

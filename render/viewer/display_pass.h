// The compute pass that turns rendered images into the image of the window (shaders/display/present.comp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "render/viewer/display_device.h"
#include "render/viewer/published.h"
#include "render/viewer/view_state.h"

namespace malus::viewer {

// An image on the device, of bytes that are sRGB values.
class DisplayImageTarget {
 public:
  DisplayImageTarget(const DisplayDevice& device, std::uint32_t width, std::uint32_t height);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  VkImage image() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }

 private:
  std::uint32_t width_, height_;
  vulkan::Owned<VkImage> image_;
  vulkan::Owned<VkDeviceMemory> memory_;
  vulkan::Owned<VkImageView> view_;
};

// The images that a frame shows.
struct DisplayInput {
  std::array<ImageRows, 2> coarse, fine;
  ImageRows reference;               // of the size of the window; rows: those that are rendered
  std::shared_ptr<PixelStore> flip;  // FLIP of each side against what is compared with, per pixel; may be null
  glm::vec4 analyser{1, 0, 0, 0};
  Quantity shown = Quantity::colour;
  bool againstOther = false;
  float dividerColumn = 0;
  float gain = 1;
  float differenceScale = 1;
};
DisplayInput displayInput(const ViewState& state, const Published& published, std::uint32_t width);

class DisplayPass {
 public:
  // device must outlive the object.
  explicit DisplayPass(const DisplayDevice& device);

  // Records the pass over the whole target, whose earlier content is lost; afterwards it is in the layout
  // TRANSFER_SRC_OPTIMAL. Call it under the lock of the queue, until the submission. Keeps the input's stores until the
  // next call: the previous recording must have finished.
  void record(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target);
  // Time of the last recording by the clock of the device [ms], after it has finished. Nothing: there was none, or the
  // device has no clock. Throws Error: a lost device.
  std::optional<double> readMs() const;

 private:
  void recordPass(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target);
  void dispatch(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target,
                std::uint32_t width, std::uint32_t height);

  const DisplayDevice& device_;
  std::unique_ptr<DisplayImageTarget> small_;  // of the size of the window; takes a coarse image in its corner
  vulkan::Owned<VkDescriptorSetLayout> setLayout_;
  vulkan::Owned<VkPipelineLayout> layout_;
  std::array<vulkan::Owned<VkPipeline>, kQuantityNames.size()> pipelines_;  // by quantity, made when shown
  vulkan::Owned<VkDescriptorPool> descriptors_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  DisplayInput used_;
  vulkan::Timestamps timestamps_;
  bool isRecorded_ = false;
};

// The bytes of a target, RGB, row by row from the top. It must be in the layout TRANSFER_SRC_OPTIMAL.
std::vector<std::uint8_t> readTarget(const DisplayDevice& device, const DisplayImageTarget& target);

}  // namespace malus::viewer

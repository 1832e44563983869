#include "render/viewer/display_pass.h"

#include <algorithm>
#include <cmath>

#include "render/viewer/device_stores.h"
#include "render/viewer/image_transition.h"
#include "shaders/display/display_parameters.h"
#include "shaders/display/present_spirv.h"

namespace malus::viewer {
using vulkan::check;
using vulkan::create;

namespace {

constexpr std::uint32_t kGroupWidth = 16, kGroupHeight = 4;  // of present.comp

vulkan::Owned<VkDescriptorSetLayout> makeSetLayout(VkDevice device) {
  const VkDescriptorSetLayoutBinding image{0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT,
                                           nullptr};
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = 1;
  info.pBindings = &image;
  return create(device, vkCreateDescriptorSetLayout, info, vkDestroyDescriptorSetLayout,
                "vkCreateDescriptorSetLayout (display)");
}

vulkan::Owned<VkPipelineLayout> makeLayout(VkDevice device, VkDescriptorSetLayout sets) {
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::DisplayParameters)};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &sets;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  return create(device, vkCreatePipelineLayout, info, vkDestroyPipelineLayout, "vkCreatePipelineLayout (display)");
}

vulkan::Owned<VkPipeline> makePipeline(VkDevice device, VkPipelineLayout layout, Quantity shown, bool interpolates) {
  VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  code.codeSize = sizeof kPresentSpirv;
  code.pCode = kPresentSpirv;
  const auto module =
      create(device, vkCreateShaderModule, code, vkDestroyShaderModule, "vkCreateShaderModule (display)");
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  const std::array<std::uint32_t, 2> values = {static_cast<std::uint32_t>(shown), interpolates ? 1u : 0u};
  const VkSpecializationMapEntry entries[] = {{0, 0, 4}, {1, 4, 4}};
  const VkSpecializationInfo constants{2, entries, sizeof values, values.data()};
  info.stage.pSpecializationInfo = &constants;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines (display)");
  return {device, pipeline, vkDestroyPipeline};
}

vulkan::Owned<VkDescriptorPool> makePool(VkDevice device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1};
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return create(device, vkCreateDescriptorPool, info, vkDestroyDescriptorPool, "vkCreateDescriptorPool (display)");
}

gpu::FloatBuffer address(const std::shared_ptr<PixelStore>& store) {
  return store ? static_cast<const DeviceStore&>(*store).address() : 0;
}

// Rows that a renderer has written on the device.
void recordAcquire(VkCommandBuffer commands, const ImageRows& image) {
  if (image.store)
    static_cast<const DeviceStore&>(*image.store)
        .recordAcquire(commands, std::size_t{image.channels} * image.width * image.rows);
}

gpu::DisplayImage describe(const ImageRows& image) {
  if (!image.store) return {};
  return {address(image.store), image.width | image.height << 16u, image.rows | image.channels << 16u};
}

// width, height: that are written.
gpu::DisplayParameters parametersFor(const DisplayInput& input, const DisplayImageTarget& target, std::uint32_t width,
                                     std::uint32_t height) {
  gpu::DisplayParameters p{};
  p.analyser = input.analyser;
  for (std::size_t i = 0; i < 2; ++i) {
    p.coarse[i] = describe(input.coarse[i]);
    p.fine[i] = describe(input.fine[i]);
  }
  const ImageRows& reference = input.reference;
  const bool fits = reference.store && reference.width == target.width() && reference.height == target.height();
  p.reference = address(reference.store);
  p.referenceRows = fits ? reference.rows : 0;
  p.flipValues = address(input.flip);
  p.flags = (input.againstOther ? gpu::kDisplayAgainstOther : 0) | (input.flip ? gpu::kDisplayHasFlip : 0);
  p.divider = input.dividerColumn * static_cast<float>(width) / static_cast<float>(target.width());
  p.gain = input.gain;
  p.differenceScale = input.differenceScale;
  p.target = width | height << 16u;
  return p;
}

}  // namespace

DisplayImageTarget::DisplayImageTarget(const DisplayDevice& device, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  image_ = create(device.get(), vkCreateImage, info, vkDestroyImage, "vkCreateImage (display)");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.get(), image_.get(), &needs);
  memory_ = device.allocate(needs, {{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0}}, "the image of the window");
  check(vkBindImageMemory(device.get(), image_.get(), memory_.get(), 0), "vkBindImageMemory (display)");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image_.get();
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = info.format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  view_ = create(device.get(), vkCreateImageView, view, vkDestroyImageView, "vkCreateImageView (display)");
}

DisplayInput displayInput(const ViewState& state, const Published& published, std::uint32_t width) {
  DisplayInput input;
  for (std::size_t i = 0; i < 2; ++i) {
    input.coarse[i] = published.sides[i].coarse;
    input.fine[i] = published.sides[i].fine;
  }
  const render::Analyser analyser = state.filter.analyser();
  input.analyser = glm::dvec4(analyser[0], analyser[1], analyser[2], analyser[3]);
  input.shown = state.shown;
  input.againstOther = state.comparesSides();
  input.dividerColumn = static_cast<float>(state.isSplit ? std::round(state.divider * width) : width);
  input.gain = static_cast<float>(std::exp2(state.exposureEv));
  input.differenceScale = static_cast<float>(state.differenceScale);
  return input;
}

DisplayPass::DisplayPass(const DisplayDevice& device)
    : device_(device),
      setLayout_(makeSetLayout(device.get())),
      layout_(makeLayout(device.get(), setLayout_.get())),
      descriptors_(makePool(device.get())),
      timestamps_(device.makeTimestamps()) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = descriptors_.get();
  info.descriptorSetCount = 1;
  const VkDescriptorSetLayout layout = setLayout_.get();
  info.pSetLayouts = &layout;
  check(vkAllocateDescriptorSets(device.get(), &info, &set_), "vkAllocateDescriptorSets (display)");
}

namespace {

// The image of a moving view that can be shown at its size and then stretched; null: none.
const ImageRows* coarseAlone(const DisplayInput& input, const DisplayImageTarget& target) {
  const ImageRows& image = input.coarse[0];
  const bool comparesWithWindow =
      input.shown == Quantity::flip || (input.shown == Quantity::difference && !input.againstOther);
  if (!image.store || comparesWithWindow || image.width > target.width() || image.height > target.height())
    return nullptr;
  const bool hasSecond = input.dividerColumn < static_cast<float>(target.width());
  const ImageRows& second = input.coarse[1];
  if (hasSecond && (second.width != image.width || second.height != image.height)) return nullptr;
  return input.fine[0].rows == 0 && (!hasSecond || input.fine[1].rows == 0) ? &image : nullptr;
}

}  // namespace

std::optional<double> DisplayPass::readMs() const { return isRecorded_ ? timestamps_.readMs() : std::nullopt; }

void DisplayPass::record(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target) {
  timestamps_.begin(commands);
  recordPass(commands, input, target);
  timestamps_.end(commands);
  isRecorded_ = true;
}

void DisplayPass::recordPass(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target) {
  used_ = input;
  for (std::size_t i = 0; i < 2; ++i) {
    recordAcquire(commands, input.coarse[i]);
    recordAcquire(commands, input.fine[i]);
  }
  const ImageRows* const coarse = coarseAlone(input, target);
  if (!coarse) {
    dispatch(commands, input, target, target.width(), target.height());
    return;
  }
  if (!small_ || small_->width() != target.width() || small_->height() != target.height())
    small_ = std::make_unique<DisplayImageTarget>(device_, target.width(), target.height());
  dispatch(commands, input, *small_, coarse->width, coarse->height);
  transition(commands, target.image(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
             VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
  VkImageBlit blit{};
  blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  blit.srcOffsets[1] = {static_cast<std::int32_t>(coarse->width), static_cast<std::int32_t>(coarse->height), 1};
  blit.dstOffsets[1] = {static_cast<std::int32_t>(target.width()), static_cast<std::int32_t>(target.height()), 1};
  vkCmdBlitImage(commands, small_->image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image(),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
  transition(commands, target.image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
             VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
             VK_PIPELINE_STAGE_TRANSFER_BIT);
}

// Leaves the target in the layout TRANSFER_SRC_OPTIMAL.
void DisplayPass::dispatch(VkCommandBuffer commands, const DisplayInput& input, const DisplayImageTarget& target,
                           std::uint32_t width, std::uint32_t height) {
  const VkDescriptorImageInfo image{VK_NULL_HANDLE, target.view(), VK_IMAGE_LAYOUT_GENERAL};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = set_;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);

  transition(commands, target.image(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0,
             VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
  vulkan::Owned<VkPipeline>& pipeline = pipelines_[static_cast<std::size_t>(input.shown)];
  if (!pipeline) pipeline = makePipeline(device_.get(), layout_.get(), input.shown, !device_.isCpu());
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &set_, 0, nullptr);
  const gpu::DisplayParameters parameters = parametersFor(input, target, width, height);
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof parameters, &parameters);
  vkCmdDispatch(commands, (width + kGroupWidth - 1) / kGroupWidth, (height + kGroupHeight - 1) / kGroupHeight, 1);
  transition(commands, target.image(), VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
             VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
             VK_PIPELINE_STAGE_TRANSFER_BIT);
}

std::vector<std::uint8_t> readTarget(const DisplayDevice& device, const DisplayImageTarget& target) {
  const std::size_t pixels = std::size_t{target.width()} * target.height();
  DeviceStore store(device, pixels, DeviceStore::Kind::host);  // four bytes per pixel
  device.submit("read the display", [&](VkCommandBuffer commands) {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {target.width(), target.height(), 1};
    vkCmdCopyImageToBuffer(commands, target.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, store.buffer(), 1, &copy);
  });
  const std::span<const std::byte> bytes = std::as_bytes(store.values());
  std::vector<std::uint8_t> rgb(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = std::to_integer<std::uint8_t>(bytes[4 * i + c]);
  return rgb;
}

}  // namespace malus::viewer

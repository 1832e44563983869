// Owners of Vulkan objects. Each destroys its object at the end of its life; owners can be moved, not copied.
#pragma once

#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include <vulkan/vulkan.h>

#include "render/vulkan/check.h"

namespace malus::vulkan {

struct DestroyInstance {
  void operator()(VkInstance instance) const { vkDestroyInstance(instance, nullptr); }
};
using OwnedInstance = std::unique_ptr<std::remove_pointer_t<VkInstance>, DestroyInstance>;

struct DestroyDevice {
  void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
};
using OwnedDevice = std::unique_ptr<std::remove_pointer_t<VkDevice>, DestroyDevice>;

// An object of a parent (an instance or a device), which must outlive it.
template <typename Parent, typename Handle>
class OwnedChild {
 public:
  using Destroy = void(VKAPI_PTR*)(Parent, Handle, const VkAllocationCallbacks*);

  OwnedChild() = default;
  OwnedChild(Parent parent, Handle handle, Destroy destroy) : parent_(parent), handle_(handle), destroy_(destroy) {}
  ~OwnedChild() {
    if (handle_ != VK_NULL_HANDLE) destroy_(parent_, handle_, nullptr);
  }
  OwnedChild(OwnedChild&& other) noexcept { swap(other); }
  OwnedChild& operator=(OwnedChild&& other) noexcept {
    OwnedChild moved(std::move(other));
    swap(moved);
    return *this;
  }
  OwnedChild(const OwnedChild&) = delete;
  OwnedChild& operator=(const OwnedChild&) = delete;

  // VK_NULL_HANDLE: owns nothing.
  Handle get() const { return handle_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  void swap(OwnedChild& other) noexcept {
    std::swap(parent_, other.parent_);
    std::swap(handle_, other.handle_);
    std::swap(destroy_, other.destroy_);
  }

  Parent parent_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
  Destroy destroy_ = nullptr;
};

template <typename Handle>
using Owned = OwnedChild<VkDevice, Handle>;

// Creates an object by a function of the form of vkCreateBuffer or vkAllocateMemory. step: as in check(). Throws Error.
template <typename Parent, typename Handle, typename Info>
OwnedChild<Parent, Handle> create(
    Parent parent, VkResult(VKAPI_PTR* function)(Parent, const Info*, const VkAllocationCallbacks*, Handle*),
    const Info& info, typename OwnedChild<Parent, Handle>::Destroy destroy, std::string_view step) {
  Handle handle = VK_NULL_HANDLE;
  check(function(parent, &info, nullptr, &handle), step);
  return {parent, handle, destroy};
}

}  // namespace malus::vulkan

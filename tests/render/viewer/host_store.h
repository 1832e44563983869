// Pixel memory without a device.
#pragma once

#include <memory>
#include <vector>

#include "render/viewer/pixel_store.h"

namespace malus::viewer::test {

class HostStore final : public PixelStore {
 public:
  explicit HostStore(std::size_t count) : values_(count) {}
  std::span<float> values() override { return values_; }

 private:
  std::vector<float> values_;
};

class HostStores final : public PixelStores {
 public:
  std::shared_ptr<PixelStore> take(std::size_t count) override { return std::make_shared<HostStore>(count); }
};

}  // namespace malus::viewer::test

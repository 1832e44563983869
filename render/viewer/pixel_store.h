// Memory for the pixels of one image, which the display pass reads. The presentation allocates it where the device sees
// it; tests use ordinary memory.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace malus::viewer {

class PixelStore {
 public:
  virtual ~PixelStore() = default;
  PixelStore(const PixelStore&) = delete;
  PixelStore& operator=(const PixelStore&) = delete;

  // At least as many values as were asked for. A store is written before the part is published, and read afterwards.
  virtual std::span<float> values() = 0;

 protected:
  PixelStore() = default;
};

class PixelStores {
 public:
  virtual ~PixelStores() = default;
  PixelStores(const PixelStores&) = delete;
  PixelStores& operator=(const PixelStores&) = delete;

  // May be called by any thread. The memory is reused when the last reference is dropped. Throws Error: out of memory.
  virtual std::shared_ptr<PixelStore> take(std::size_t count) = 0;

 protected:
  PixelStores() = default;
};

}  // namespace malus::viewer

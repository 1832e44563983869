// Memory for the pixels of one image, which the display pass reads. The presentation allocates it where the device sees
// it; tests use ordinary memory.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "render/shared_pixels.h"

namespace malus::viewer {

class PixelStore {
 public:
  virtual ~PixelStore() = default;
  PixelStore(const PixelStore&) = delete;
  PixelStore& operator=(const PixelStore&) = delete;

  // At least as many values as were asked for; none if the memory is on the device alone. A store is written before the
  // part is published, and read afterwards.
  virtual std::span<float> values() = 0;
  // The memory on the device alone, for a renderer; null: values().
  virtual std::shared_ptr<const render::SharedPixels> shared() const { return nullptr; }
  // Copies values on the device alone, from number `first` on, to the host, and waits. Any thread may call it. Throws
  // Error: a lost device.
  virtual void readBack(std::size_t /*first*/, std::span<float> /*to*/) const {}

 protected:
  PixelStore() = default;
};

// Values on the host, from number `first` on. copy: takes them if they are on the device alone. Throws Error.
inline std::span<const float> hostValues(PixelStore& store, std::size_t first, std::size_t count,
                                         std::vector<float>& copy) {
  if (!store.shared()) return store.values().subspan(first, count);
  copy.resize(count);
  store.readBack(first, copy);
  return copy;
}

class PixelStores {
 public:
  virtual ~PixelStores() = default;
  PixelStores(const PixelStores&) = delete;
  PixelStores& operator=(const PixelStores&) = delete;

  // May be called by any thread. The memory is reused when the last reference is dropped. Throws Error: out of memory.
  virtual std::shared_ptr<PixelStore> take(std::size_t count) = 0;
  // Memory on the device alone; null: the device does not export memory.
  virtual std::shared_ptr<PixelStore> takeShared(std::size_t /*count*/) { return nullptr; }

 protected:
  PixelStores() = default;
};

}  // namespace malus::viewer

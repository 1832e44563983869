// Array of a fixed number of values that are not initialized: the threads that fill it are the first to touch its
// memory, and share the cost of new pages.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace malus {

template <class T>
class RawArray {
  static_assert(std::is_trivially_default_constructible_v<T>);

 public:
  RawArray() = default;
  explicit RawArray(std::size_t size) : values_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}

  std::size_t size() const { return size_; }
  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  T* begin() { return values_.get(); }
  T* end() { return values_.get() + size_; }
  const T* begin() const { return values_.get(); }
  const T* end() const { return values_.get() + size_; }

 private:
  std::unique_ptr<T[]> values_;
  std::size_t size_ = 0;
};

}  // namespace malus

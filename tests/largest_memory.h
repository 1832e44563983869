// The most memory that this process has had at once.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace malus::test {

// In bytes.
inline std::size_t largestMemory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace malus::test

// Watches the Vulkan calls of the program that this file is linked into: it defines the functions of the loader that
// create, destroy or can fail, forwards them to the loader, and counts. One of them can be made to fail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace malus::test {

// Sets all counts to 0. failAt: 1 for the first call that can fail, 2 for the second, ...; 0: none fails. The call that
// fails returns VK_ERROR_OUT_OF_DEVICE_MEMORY; only vkQueueWaitIdle is forwarded before.
void watchVulkanCalls(std::size_t failAt);

// The memory types that a discrete GPU has, in place of lavapipe's single one. `sizes` are those of the heaps.
// Allocations of a type fail if its heap would exceed its size.
enum SimulatedType : std::uint32_t { kLocal, kHost, kHostCached, kLocalHost };
enum SimulatedHeap : std::uint32_t { kLocalHeap, kHostHeap, kLocalHostHeap };
void simulateMemory(const std::array<std::uint64_t, 3>& sizes);
void endSimulatedMemory();

// Raises the size that the driver requires of an acceleration structure, but not its compacted size: lavapipe's
// structures are compact when built.
void padStructures(std::uint64_t bytes);

struct Allocation {
  std::uint32_t type;  // index of the memory type
  std::uint64_t bytes;
};

struct VulkanCalls {
  std::size_t fallible = 0;                      // calls that could fail
  std::string failed;                            // function that was made to fail; empty: none
  std::map<std::string, int> live;               // objects alive, by the function that creates them; only those not 0
  std::vector<std::string> messages;             // of the validation layers
  std::vector<Allocation> allocations;           // those that succeeded
  std::uint64_t largestUpload = 0;               // bytes of the largest buffer that can only be copied from
  std::size_t submissions = 0;                   // to queues
  std::size_t descriptorWrites = 0;              // calls of vkUpdateDescriptorSets
  std::size_t compactions = 0;                   // copies of acceleration structures that compact
  std::vector<std::uint64_t> structureBytes;     // of acceleration structures, in the order of their creation
  std::vector<std::thread::id> pipelineThreads;  // of each pipeline
  std::vector<std::size_t> pipelineCacheBytes;   // that each pipeline cache began with
  std::vector<std::string> unwatched;            // functions that create objects and are not watched
};
VulkanCalls vulkanCalls();

}  // namespace malus::test

// The numbers of a glTF accessor, read where they lie: nothing is copied. Sparse accessors put other values in place
// of some; without a buffer view the others are zero.
// Source: glTF 2.0 Specification, section 3.6.2, "Accessors".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"

namespace malus::prep {

class GltfAccessor {
 public:
  // Checks that every element lies within its bytes, and that what a sparse accessor replaces is there. `where` is
  // the file. Throws Error: no such accessor, view or buffer, elements that overlap, bytes that are missing.
  GltfAccessor(const gltf::Document& document, GltfBuffers& buffers, std::size_t index, const std::string& where);

  std::size_t count() const { return count_; }
  const std::string& place() const { return place_; }  // for messages
  bool hasBytes() const { return !data_.empty(); }

  // Throws Error unless it is what vertices may have: vectors of three floats, or, quantized, of whole numbers that
  // are bytes or shorts. A float that is not finite is an error too.
  void requireVectors(bool quantized) const;
  // Throws Error unless it is what indices may be: scalars of 8, 16 or 32 unsigned bits.
  void requireIndices() const;

  glm::dvec3 vector(std::size_t i) const;  // normalized where the accessor says so
  std::uint32_t wholeNumber(std::size_t i) const;
  std::uint32_t restart() const;  // the index that is none: the largest of its type

 private:
  const std::byte* element(std::size_t i) const;  // nullptr: zero

  std::string place_;
  std::size_t count_ = 0;
  gltf::ComponentType componentType_{};
  std::size_t components_ = 0;
  bool normalized_ = false;
  std::size_t elementBytes_ = 0;
  std::size_t stride_ = 0;
  std::span<const std::byte> data_;
  std::vector<std::uint32_t> sparseIndices_;  // ascending
  std::span<const std::byte> sparseData_;
};

// The bytes of a buffer view. Throws Error: no such view or buffer, bytes that are missing.
std::span<const std::byte> gltfViewBytes(const gltf::Document& document, GltfBuffers& buffers, std::size_t view,
                                         const std::string& where);

}  // namespace malus::prep

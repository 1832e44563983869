// View of the elements of a glTF accessor in its buffer, without copies. Sparse accessors replace some elements;
// without a buffer view the others are zero. Source: glTF 2.0 Specification, section 3.6.2, "Accessors".
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_buffers.h"
#include "meshprep/read/gltf_document.h"

namespace malus::prep {

class GltfAccessor {
 public:
  // Checks that all elements are inside the buffer views. `where` is the file for messages. Throws Error: an accessor,
  // view or buffer that does not exist or is invalid, overlapping elements, missing bytes, sparse indices out of order
  // or range.
  GltfAccessor(const gltf::Document& document, GltfBuffers& buffers, std::size_t index, const std::string& where);

  std::size_t count() const { return count_; }
  const std::string& location() const { return location_; }  // for messages
  bool hasBytes() const { return !data_.empty(); }

  // Throws Error unless the elements are vectors of three floats or, if quantized, of three bytes or shorts.
  void requireVectors(bool quantized) const;
  // Throws Error unless the elements have so many components of one of these types. isNormalized: whether integers must
  // be normalized, or must not.
  void requireElements(std::size_t components, std::initializer_list<gltf::ComponentType> types,
                       bool isNormalized = false) const;
  // Throws Error unless the elements are pairs of floats or of normalized unsigned bytes or shorts; if quantized, of
  // any bytes or shorts.
  void requireTextureCoordinates(bool quantized) const;
  // Throws Error unless the elements are four floats or, if quantized, four normalized bytes or shorts.
  void requireTangents(bool quantized) const;
  // Returns the first vector that is not finite.
  std::optional<std::size_t> findNotFinite() const;
  // Returns the error of such a vector.
  Error notFinite(std::size_t i) const;
  // Throws Error unless the elements are unsigned integers of 8, 16 or 32 bits.
  void requireIndices() const;

  glm::dvec3 vector(std::size_t i) const;  // normalized if the accessor is
  double number(std::size_t i, std::size_t component) const;
  std::uint32_t wholeNumber(std::size_t i) const;
  std::uint32_t restart() const;  // primitive restart value: the largest of its type, not a valid index

 private:
  const std::byte* element(std::size_t i) const;  // nullptr: zero

  std::string location_;
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

// Returns the bytes of a buffer view. Throws Error: a view or buffer that does not exist or is invalid, missing bytes.
std::span<const std::byte> gltfViewBytes(const gltf::Document& document, GltfBuffers& buffers, std::size_t view,
                                         const std::string& where);

}  // namespace malus::prep

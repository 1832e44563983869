#include "meshprep/read/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_meshopt.h"

namespace malus::prep {
using gltf::ComponentType;

namespace {

template <class Number>
Number numberAt(const std::byte* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Returns the size of a component in bytes.
std::size_t componentSize(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
      return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
      return 2;
    case ComponentType::uint32:
    case ComponentType::float32:
      return 4;
  }
  return 0;
}

// Returns a component as a number; normalized ones by section 3.6.2.2, -1 to 1 or 0 to 1.
double component(const std::byte* bytes, ComponentType type, bool normalized) {
  const auto whole = [normalized](auto value) {
    if (!normalized) return static_cast<double>(value);
    return std::max(static_cast<double>(value) / std::numeric_limits<decltype(value)>::max(), -1.0);
  };
  switch (type) {
    case ComponentType::int8:
      return whole(numberAt<std::int8_t>(bytes));
    case ComponentType::uint8:
      return whole(numberAt<std::uint8_t>(bytes));
    case ComponentType::int16:
      return whole(numberAt<std::int16_t>(bytes));
    case ComponentType::uint16:
      return whole(numberAt<std::uint16_t>(bytes));
    case ComponentType::uint32:
      return numberAt<std::uint32_t>(bytes);
    case ComponentType::float32:
      break;
  }
  return static_cast<double>(numberAt<float>(bytes));
}

std::uint32_t unsignedAt(const std::byte* bytes, ComponentType type) {
  if (type == ComponentType::uint8) return numberAt<std::uint8_t>(bytes);
  if (type == ComponentType::uint16) return numberAt<std::uint16_t>(bytes);
  return numberAt<std::uint32_t>(bytes);
}

bool isUnsigned(ComponentType type) {
  return type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
}

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Requires `count` elements from `offset` on, at distances of `stride`, to be inside the view.
std::span<const std::byte> findElements(std::span<const std::byte> view, std::size_t offset, std::size_t count,
                                        std::size_t stride, std::size_t elementBytes, const std::string& location) {
  const bool first = offset <= view.size() && elementBytes <= view.size() - offset;
  const std::size_t fit = first ? (view.size() - offset - elementBytes) / stride + 1 : 0;
  if (count > fit)
    throw Error(location, "elements exceed the buffer view",
                fmt::format("at most {} in a buffer view of {} bytes", fit, view.size()), fmt::to_string(count));
  return view.subspan(offset);
}

}  // namespace

std::span<const std::byte> gltfViewBytes(const gltf::Document& document, GltfBuffers& buffers, std::size_t index,
                                         const std::string& where) {
  const std::string location = fmt::format("{}: bufferViews[{}]", where, index);
  if (index >= document.bufferViews.size())
    throw Error(location, "does not exist", fmt::format("one of {} buffer views", document.bufferViews.size()));
  const gltf::BufferView& view = document.bufferViews[index];
  if (view.isInvalid) throw Error(location, "is invalid", "a valid buffer view");
  const auto part = [&](std::size_t bufferIndex, std::size_t offset, std::size_t length) {
    const std::span<const std::byte> buffer = buffers.bytes(bufferIndex);
    if (offset > buffer.size() || length > buffer.size() - offset)
      throw Error(location, "buffer view exceeds its buffer", fmt::format("at most {} bytes", buffer.size()),
                  fmt::format("{} bytes from byte {} on", length, offset));
    return buffer.subspan(offset, length);
  };
  if (!view.meshopt) return part(view.buffer, view.byteOffset, view.byteLength);
  return buffers.decodedView(index, [&] {
    const gltf::MeshoptCompression& meshopt = *view.meshopt;
    return decodeGltfMeshopt(part(meshopt.buffer, meshopt.byteOffset, meshopt.byteLength), meshopt, location);
  });
}

GltfAccessor::GltfAccessor(const gltf::Document& document, GltfBuffers& buffers, std::size_t index,
                           const std::string& where)
    : location_(fmt::format("{}: accessors[{}]", where, index)) {
  if (index >= document.accessors.size())
    throw Error(location_, "does not exist", fmt::format("one of {} accessors", document.accessors.size()));
  const gltf::Accessor& accessor = document.accessors[index];
  if (accessor.isInvalid) throw Error(location_, "is invalid", "a valid accessor");

  // Compute the size of an element.
  if (accessor.count == 0) throw Error(location_, "no elements", "1 or more", "0");
  components_ = accessor.components;
  componentType_ = accessor.componentType;
  normalized_ = accessor.normalized;
  count_ = accessor.count;
  elementBytes_ = componentSize(componentType_) * components_;

  // Locate the dense elements.
  stride_ = elementBytes_;
  if (accessor.bufferView) {
    const std::size_t view = *accessor.bufferView;
    const std::span<const std::byte> bytes = gltfViewBytes(document, buffers, view, where);
    if (const std::size_t stride = document.bufferViews[view].byteStride; stride != 0) {
      if (stride < elementBytes_)
        throw Error(location_, "overlapping elements", fmt::format("a stride of {} bytes or more", elementBytes_),
                    fmt::to_string(stride));
      stride_ = stride;
    }
    data_ = findElements(bytes, accessor.byteOffset, count_, stride_, elementBytes_, location_);
  }

  // Locate the elements that a sparse accessor replaces.
  if (!accessor.sparse) return;
  const gltf::SparseElements& sparse = *accessor.sparse;
  if (!isUnsigned(sparse.indicesType))
    throw Error(location_, "unknown type of sparse indices", "5121, 5123 or 5125",
                fmt::to_string(static_cast<std::uint32_t>(sparse.indicesType)));
  if (sparse.count == 0 || sparse.count > count_)
    throw Error(location_, "invalid number of sparse elements", fmt::format("1 to {}", count_),
                fmt::to_string(sparse.count));
  const std::size_t indexBytes = componentSize(sparse.indicesType);
  const auto viewBytes = [&](std::size_t view) { return gltfViewBytes(document, buffers, view, where); };
  const std::span<const std::byte> indices =
      findElements(viewBytes(sparse.indicesView), sparse.indicesByteOffset, sparse.count, indexBytes, indexBytes,
                   location_ + ".sparse.indices");
  sparseData_ = findElements(viewBytes(sparse.valuesView), sparse.valuesByteOffset, sparse.count, elementBytes_,
                             elementBytes_, location_ + ".sparse.values");
  sparseIndices_.reserve(sparse.count);
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t value = unsignedAt(indices.data() + i * indexBytes, sparse.indicesType);
    if (value >= count_ || (i > 0 && value <= sparseIndices_.back()))
      throw Error(location_ + ".sparse.indices", fmt::format("index {} is out of order or range", i),
                  fmt::format("ascending, below {}", count_), fmt::to_string(value));
    sparseIndices_.push_back(value);
  }
}

void GltfAccessor::requireVectors(bool quantized) const {
  const bool isFloat = componentType_ == ComponentType::float32;
  if (components_ != 3 || (!isFloat && !(quantized && componentSize(componentType_) <= 2)))
    throw Error(location_, "wrong type", quantized ? "VEC3 of floats, shorts or bytes" : "VEC3 of floats (5126)",
                fmt::format("{} components of type {}", components_, static_cast<std::uint32_t>(componentType_)));
}

void GltfAccessor::requireElements(std::size_t components, std::initializer_list<ComponentType> types,
                                   bool isNormalized) const {
  const bool isKnown = std::find(types.begin(), types.end(), componentType_) != types.end();
  const bool isFloat = componentType_ == ComponentType::float32;
  if (components_ == components && isKnown && (isFloat || normalized_ == isNormalized)) return;
  std::vector<std::uint32_t> names;
  for (const ComponentType type : types) names.push_back(static_cast<std::uint32_t>(type));
  throw Error(location_, "wrong type",
              fmt::format("{} components of type {}{}", components, fmt::join(names, ", "),
                          isNormalized ? ", integers normalized" : ""),
              fmt::format("{} components of type {}{}", components_, static_cast<std::uint32_t>(componentType_),
                          normalized_ ? ", normalized" : ""));
}

void GltfAccessor::requireTextureCoordinates(bool quantized) const {
  if (quantized && components_ == 2 && componentSize(componentType_) <= 2) return;
  requireElements(2, {ComponentType::float32, ComponentType::uint8, ComponentType::uint16}, true);
}

void GltfAccessor::requireTangents(bool quantized) const {
  if (quantized)
    requireElements(4, {ComponentType::float32, ComponentType::int8, ComponentType::int16}, true);
  else
    requireElements(4, {ComponentType::float32});
}

std::optional<std::size_t> GltfAccessor::findNotFinite() const {
  if (componentType_ != ComponentType::float32) return std::nullopt;
  for (std::size_t i = 0; i < count_; ++i)
    if (!isFinite(vector(i))) return i;
  return std::nullopt;
}

Error GltfAccessor::notFinite(std::size_t i) const {
  const glm::dvec3 v = vector(i);
  return {location_, fmt::format("element {} is not finite", i), "finite numbers",
          fmt::format("({}, {}, {})", v.x, v.y, v.z)};
}

void GltfAccessor::requireIndices() const {
  if (components_ != 1 || normalized_ || !isUnsigned(componentType_))
    throw Error(location_, "wrong type of indices", "SCALAR of 5121, 5123 or 5125",
                fmt::format("{} components of type {}", components_, static_cast<std::uint32_t>(componentType_)));
}

const std::byte* GltfAccessor::element(std::size_t i) const {
  if (!sparseIndices_.empty()) {
    const auto found = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), i);
    if (found != sparseIndices_.end() && *found == i)
      return sparseData_.data() + static_cast<std::size_t>(found - sparseIndices_.begin()) * elementBytes_;
  }
  return data_.empty() ? nullptr : data_.data() + i * stride_;
}

glm::dvec3 GltfAccessor::vector(std::size_t i) const {
  const std::byte* bytes = element(i);
  if (bytes == nullptr) return glm::dvec3(0);
  const std::size_t step = componentSize(componentType_);
  return {component(bytes, componentType_, normalized_), component(bytes + step, componentType_, normalized_),
          component(bytes + 2 * step, componentType_, normalized_)};
}

double GltfAccessor::number(std::size_t i, std::size_t at) const {
  const std::byte* bytes = element(i);
  return bytes == nullptr ? 0 : component(bytes + at * componentSize(componentType_), componentType_, normalized_);
}

std::uint32_t GltfAccessor::wholeNumber(std::size_t i) const {
  const std::byte* bytes = element(i);
  return bytes == nullptr ? 0 : unsignedAt(bytes, componentType_);
}

std::uint32_t GltfAccessor::restart() const {
  return static_cast<std::uint32_t>((std::uint64_t{1} << (8 * componentSize(componentType_))) - 1);
}

}  // namespace malus::prep

#include "meshprep/read/gltf_meshopt.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMostExpansion = 64;  // a vertex column of equal values takes 2 bits per 16 bytes
constexpr std::size_t kMinElementBytes = std::size_t{1} << 16;

struct Filter {
  const char* name;
  void (*apply)(void* buffer, std::size_t count, std::size_t stride);
  std::size_t stride;  // 0: any multiple of 4; 4: also twice that
};

void keep(void*, std::size_t, std::size_t) {}

constexpr std::array kFilters = {Filter{"NONE", keep, 0}, Filter{"OCTAHEDRAL", meshopt_decodeFilterOct, 4},
                                 Filter{"QUATERNION", meshopt_decodeFilterQuat, 8},
                                 Filter{"EXPONENTIAL", meshopt_decodeFilterExp, 0}};

const Filter& findFilter(const gltf::MeshoptCompression& c, const std::string& location) {
  const auto found =
      std::find_if(kFilters.begin(), kFilters.end(), [&](const Filter& f) { return c.filter == f.name; });
  if (found == kFilters.end())
    throw Error(location + ".filter", "unknown filter", "NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL",
                "'" + c.filter.substr(0, 40) + "'");
  const bool isOctahedral = found->stride == 4;
  if (found->stride != 0 && c.byteStride != found->stride && !(isOctahedral && c.byteStride == 8))
    throw Error(location + ".byteStride", fmt::format("invalid stride of the filter {}", c.filter),
                isOctahedral ? "4 or 8" : "8", fmt::to_string(c.byteStride));
  return *found;
}

void requireSizes(std::span<const std::byte> bytes, const gltf::MeshoptCompression& c, const std::string& location) {
  const bool isAttribute = c.mode == "ATTRIBUTES";
  if (!isAttribute && c.mode != "TRIANGLES" && c.mode != "INDICES")
    throw Error(location + ".mode", "unknown mode", "ATTRIBUTES, TRIANGLES or INDICES",
                "'" + c.mode.substr(0, 40) + "'");
  if (isAttribute ? c.byteStride == 0 || c.byteStride % 4 != 0 || c.byteStride > 256
                  : c.byteStride != 2 && c.byteStride != 4)
    throw Error(location + ".byteStride", fmt::format("invalid stride of the mode {}", c.mode),
                isAttribute ? "a multiple of 4 up to 256" : "2 or 4", fmt::to_string(c.byteStride));
  if (c.mode == "TRIANGLES" && c.count % 3 != 0)
    throw Error(location + ".count", "incomplete triangle", "a multiple of 3", fmt::to_string(c.count));
  if (!isAttribute && c.filter != "NONE")
    throw Error(location + ".filter", "filter of indices", "NONE", "'" + c.filter.substr(0, 40) + "'");
  const std::size_t most = std::max(kMinElementBytes, kMostExpansion * bytes.size()) / c.byteStride;
  if (c.count > most)
    throw Error(location + ".count", "too many elements for the compressed bytes", fmt::format("at most {}", most),
                fmt::to_string(c.count));
}

}  // namespace

std::vector<std::byte> decodeGltfMeshopt(std::span<const std::byte> bytes, const gltf::MeshoptCompression& c,
                                         const std::string& viewLocation) {
  const std::string location = viewLocation + ".extensions.EXT_meshopt_compression";
  requireSizes(bytes, c, location);
  const Filter& filter = findFilter(c, location);
  std::vector<std::byte> elements(c.count * c.byteStride);
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  const int error =
      c.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(elements.data(), c.count, c.byteStride, data, bytes.size())
      : c.mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(elements.data(), c.count, c.byteStride, data, bytes.size())
                              : meshopt_decodeIndexSequence(elements.data(), c.count, c.byteStride, data, bytes.size());
  if (error != 0) throw Error(location, "is corrupt", fmt::format("data of the mode {}", c.mode));
  filter.apply(elements.data(), c.count, c.byteStride);
  return elements;
}

}  // namespace malus::prep

#include "meshprep/read/gltf_images.h"

#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/read/gltf_accessor.h"

namespace malus::prep {

std::vector<SourceImage> gltfImages(const gltf::Document& document, GltfBuffers& buffers,
                                    const std::filesystem::path& file, bool withBytes, GltfLeftOut& leftOut) {
  const std::string where = file.string();
  std::vector<SourceImage> images;
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    const gltf::Image& image = document.images[i];
    const std::string location = fmt::format("{}: images[{}]", where, i);
    SourceImage& found = images.emplace_back();
    const bool hasFile = !image.uri.empty() && !isDataUri(image.uri);
    found.name = fmt::format("{}, image {}", where, image.name.empty() ? fmt::to_string(i) : "'" + image.name + "'");
    try {
      if (hasFile) {
        found.file = resolveGltfUri(file, image.uri, location + ".uri");
      } else if (withBytes && image.bufferView) {
        const std::span<const std::byte> bytes = gltfViewBytes(document, buffers, *image.bufferView, where);
        found.bytes = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
      } else if (withBytes && !image.uri.empty()) {
        found.bytes = std::make_shared<const std::vector<std::byte>>(decodeDataUri(image.uri, location + ".uri"));
      }
    } catch (const Error& error) {
      if (withBytes) leftOut.addValue(error);
    }
  }
  return images;
}

}  // namespace malus::prep

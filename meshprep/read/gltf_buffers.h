// The bytes of a glTF file: the chunks of a GLB, and the buffers, which are the GLB's own, base64 in a data URI, or a
// file beside or below the glTF file. Nothing else is ever opened. A buffer is read when it is first asked for, so
// that those of pictures stay where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::prep {

// A file told by its first bytes: GLB, or JSON.
class GltfContainer {
 public:
  // Throws Error: unreadable, a GLB of another version, chunks that do not fill it.
  explicit GltfContainer(const std::filesystem::path& path);

  std::string_view json() const { return json_; }
  std::span<const std::byte> chunk() const { return chunk_; }  // of a GLB's first buffer
  bool hasChunk() const { return hasChunk_; }
  std::size_t size() const { return bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
  std::string_view json_;
  std::span<const std::byte> chunk_;
  bool hasChunk_ = false;
};

class GltfBuffers {
 public:
  // buffers: the document's list, checked (gltf_json.h). The container must stay.
  GltfBuffers(const nlohmann::json& document, const GltfContainer& container, std::filesystem::path file);

  std::size_t count() const { return buffers_.size(); }

  // As many bytes as the buffer says that it has. Throws Error: no such buffer, a URI that is not read here, bad
  // base64, fewer bytes.
  std::span<const std::byte> bytes(std::size_t buffer);

  std::size_t bytesRead() const { return bytesRead_; }  // of buffers outside of the container

 private:
  struct Buffer {
    std::string uri;  // empty: the container's chunk
    std::uint64_t byteLength = 0;
    std::shared_ptr<const std::vector<std::byte>> data;
  };

  std::shared_ptr<const std::vector<std::byte>> load(const std::string& uri, const std::string& place);

  const GltfContainer& container_;
  std::filesystem::path file_;
  std::vector<Buffer> buffers_;
  std::map<std::filesystem::path, std::shared_ptr<const std::vector<std::byte>>> files_;
  std::size_t bytesRead_ = 0;
};

// The file that a buffer's URI names, percent-decoded, in the folder of `file` or below. `place` is for messages.
// Throws Error: another scheme than none, an absolute path, a way out of the folder.
std::filesystem::path gltfFileOf(const std::filesystem::path& file, std::string_view uri, const std::string& place);

inline bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

}  // namespace malus::prep

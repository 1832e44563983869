// Bytes of a glTF file: the chunks of a GLB, and the buffers, which are the GLB's chunk, base64 in a data URI, or a
// file in the folder of the glTF file or below it. No other file is opened. A buffer is read when it is first needed,
// so that buffers of images alone are never read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshprep/read/gltf_document.h"

namespace malus::prep {

// The file, recognized by its first bytes: GLB, or JSON.
class GltfContainer {
 public:
  // Throws Error: unreadable, a GLB of another version or shorter than its header states, chunks that do not fill it.
  explicit GltfContainer(const std::filesystem::path& path);

  std::string_view json() const { return json_; }
  std::span<const std::byte> chunk() const { return chunk_; }  // of a GLB's first buffer
  bool hasChunk() const { return hasChunk_; }
  std::size_t size() const { return bytes_.size(); }
  std::size_t trailingBytes() const { return trailingBytes_; }  // behind the end that the header of a GLB states

 private:
  std::vector<std::byte> bytes_;
  std::size_t trailingBytes_ = 0;
  std::string_view json_;
  std::span<const std::byte> chunk_;
  bool hasChunk_ = false;
};

class GltfBuffers {
 public:
  // `buffers` as in the document; `container` must outlive this object.
  GltfBuffers(std::vector<gltf::Buffer> buffers, const GltfContainer& container, std::filesystem::path file);

  std::size_t count() const { return buffers_.size(); }

  // The first `byteLength` bytes of the buffer. Throws Error: no such buffer or an invalid one, a URI that is not
  // allowed, invalid base64, fewer bytes.
  std::span<const std::byte> bytes(std::size_t buffer);

  // The elements of a compressed buffer view, decoded by the first call. Throws Error as `decode`.
  std::span<const std::byte> decodedView(std::size_t view, const std::function<std::vector<std::byte>()>& decode);

  std::size_t bytesRead() const { return bytesRead_; }  // of buffers outside the container, and of decoded views

 private:
  std::shared_ptr<const std::vector<std::byte>> load(const std::string& uri, const std::string& location);

  const GltfContainer& container_;
  std::filesystem::path file_;
  std::vector<gltf::Buffer> buffers_;
  std::vector<std::shared_ptr<const std::vector<std::byte>>> loaded_;  // one per buffer; null until it is needed
  std::map<std::filesystem::path, std::shared_ptr<const std::vector<std::byte>>> files_;
  std::map<std::size_t, std::vector<std::byte>> decodedViews_;
  std::size_t bytesRead_ = 0;
};

// Path of the file that a buffer's URI names, percent-decoded, in the folder of `file` or below it. Backslashes are
// read as slashes unless a file has exactly this name. `location` is for messages. Throws Error: a URI with a scheme,
// an absolute path, a path that leaves the folder.
std::filesystem::path resolveGltfUri(const std::filesystem::path& file, std::string_view uri,
                                     const std::string& location);

// Returns true if the URI contains a backslash, which URIs do not permit.
bool hasBackslash(std::string_view uri);

inline bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }

// Bytes of a data URI. Throws Error unless it is base64.
std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& location);

}  // namespace malus::prep

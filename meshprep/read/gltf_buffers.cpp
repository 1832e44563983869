#include "meshprep/read/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"

namespace malus::prep {

namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004e4942;   // "BIN"

std::uint32_t littleEndian(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

std::string_view toText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Source: S. Josefsson, RFC 4648, section 4.
std::vector<std::byte> decodeBase64(std::string_view text, const std::string& location) {
  static constexpr auto kValues = [] {
    std::array<int, 256> values{};
    values.fill(-1);
    int next = 0;
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      values[static_cast<unsigned char>(c)] = next++;
    return values;
  }();
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
  if (text.size() % 4 == 1) throw Error(location, "is not base64", "groups of 4 characters", "one character too many");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int value = kValues[static_cast<unsigned char>(text[i])];
    if (value < 0)
      throw Error(location, fmt::format("is not base64 at character {}", i), "A-Z, a-z, 0-9, + or /",
                  fmt::format("byte {:#04x}", static_cast<unsigned>(static_cast<unsigned char>(text[i]))));
    bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xffffffu;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xffu));
  }
  return bytes;
}

std::string decodePercent(std::string_view uri, const std::string& location) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    unsigned value = 0;
    const char* const begin = uri.data() + i + 1;
    if (i + 2 >= uri.size() || std::from_chars(begin, begin + 2, value, 16).ptr != begin + 2)
      throw Error(location, "invalid percent-encoding", "% and two hexadecimal digits", std::string(uri.substr(i, 3)));
    text += static_cast<char>(value);
    i += 2;
  }
  return text;
}

}  // namespace

GltfContainer::GltfContainer(const std::filesystem::path& path) : bytes_(readFile(path)) {
  const std::string where = path.string();
  const std::span<const std::byte> bytes(bytes_);
  const auto at = [&](std::size_t offset) { return fmt::format("{}, byte {}", where, offset); };
  if (bytes.empty()) throw Error(where, "file is empty", "glTF");

  // Accept JSON, optionally after a byte order mark.
  json_ = toText(bytes);
  if (!json_.starts_with("glTF")) {
    if (json_.starts_with("\xef\xbb\xbf")) json_.remove_prefix(3);
    return;
  }

  // Check the header of a GLB.
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
    throw Error(at(bytes.size()), "unexpected end of file", "the header of a GLB");
  if (const std::uint32_t version = littleEndian(bytes, 4); version != 2)
    throw Error(at(4), "unsupported version of GLB", "2", fmt::to_string(version));
  const std::size_t length = littleEndian(bytes, 8);
  if (length > bytes.size())
    throw Error(at(bytes.size()), "unexpected end of file", fmt::format("{} bytes, the length in the header", length));
  trailingBytes_ = bytes.size() - length;

  // Locate its chunks: JSON, optionally a buffer, then ignored ones.
  json_ = {};
  std::size_t chunks = 0;
  for (std::size_t offset = kHeaderBytes; offset < length; ++chunks) {
    if (length - offset < kChunkHeaderBytes)
      throw Error(at(offset), "unexpected end of file", "a chunk header of 8 bytes");
    const std::size_t size = littleEndian(bytes, offset);
    const std::uint32_t type = littleEndian(bytes, offset + 4);
    const std::size_t begin = offset + kChunkHeaderBytes;
    if (size > length - begin)
      throw Error(at(offset), "chunk exceeds the file", fmt::format("at most {} bytes", length - begin),
                  fmt::to_string(size));
    if (chunks == 0 && type != kJsonChunk) throw Error(at(offset + 4), "wrong type of the first chunk", "JSON");
    if (chunks == 0) json_ = toText(bytes.subspan(begin, size));
    if (chunks == 1 && type == kBinChunk) {
      chunk_ = bytes.subspan(begin, size);
      hasChunk_ = true;
    }
    offset = begin + size;
  }
}

GltfBuffers::GltfBuffers(std::vector<gltf::Buffer> buffers, const GltfContainer& container, std::filesystem::path file)
    : container_(container), file_(std::move(file)), buffers_(std::move(buffers)), loaded_(buffers_.size()) {}

std::span<const std::byte> GltfBuffers::decodedView(std::size_t view,
                                                    const std::function<std::vector<std::byte>()>& decode) {
  const auto found = decodedViews_.find(view);
  if (found != decodedViews_.end()) return found->second;
  const std::vector<std::byte>& decoded = decodedViews_.emplace(view, decode()).first->second;
  bytesRead_ += decoded.size();
  return decoded;
}

std::span<const std::byte> GltfBuffers::bytes(std::size_t index) {
  const std::string location = fmt::format("{}: buffers[{}]", file_.string(), index);
  if (index >= buffers_.size())
    throw Error(location, "does not exist", fmt::format("one of {} buffers", buffers_.size()));
  const gltf::Buffer& buffer = buffers_[index];
  if (buffer.isInvalid) throw Error(location, "is invalid", "a valid buffer");

  std::span<const std::byte> data;
  if (!buffer.uri.empty()) {
    if (loaded_[index] == nullptr) loaded_[index] = load(buffer.uri, location + ".uri");
    data = *loaded_[index];
  } else if (index == 0 && container_.hasChunk()) {
    data = container_.chunk();
  } else {
    throw Error(location, "buffer has no bytes", "a uri, or for buffer 0 the second chunk of a GLB");
  }
  if (data.size() < buffer.byteLength)
    throw Error(location, "buffer is shorter than its byteLength", fmt::to_string(buffer.byteLength),
                fmt::to_string(data.size()));
  return data.first(buffer.byteLength);
}

std::shared_ptr<const std::vector<std::byte>> GltfBuffers::load(const std::string& uri, const std::string& location) {
  if (isDataUri(uri)) return std::make_shared<const std::vector<std::byte>>(decodeDataUri(uri, location));
  const std::filesystem::path path = resolveGltfUri(file_, uri, location);
  std::shared_ptr<const std::vector<std::byte>>& data = files_[path];
  if (data == nullptr) {
    data = std::make_shared<const std::vector<std::byte>>(readFile(path));
    bytesRead_ += data->size();
  }
  return data;
}

bool hasBackslash(std::string_view uri) {
  return uri.find('\\') != std::string_view::npos || uri.find("%5C") != std::string_view::npos ||
         uri.find("%5c") != std::string_view::npos;
}

std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& location) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
    throw Error(location, "unsupported data URI", "data:application/octet-stream;base64,", uri.substr(0, 40));
  return decodeBase64(uri.substr(comma + 1), location);
}

std::filesystem::path resolveGltfUri(const std::filesystem::path& file, std::string_view uri,
                                     const std::string& location) {
  std::string name = decodePercent(uri, location);
  std::error_code ignored;
  if (hasBackslash(uri) && !std::filesystem::is_regular_file(file.parent_path() / name, ignored))
    std::replace(name.begin(), name.end(), '\\', '/');
  const auto fail = [&] {
    throw Error(location, "file reference is not allowed", "a file in the folder of the glTF file or below it",
                "'" + name.substr(0, 80) + "'");
  };
  const std::size_t colon = name.find(':');
  if (colon != std::string::npos && name.find('/') > colon) fail();  // a scheme
  if (name.find('\0') != std::string::npos) fail();
  const std::filesystem::path relative = std::filesystem::path(name).lexically_normal();
  if (relative.empty() || relative.is_absolute() || *relative.begin() == "..") fail();
  return file.parent_path() / relative;
}

}  // namespace malus::prep

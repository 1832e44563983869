#include "meshprep/read/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/read/read_gltf.h"
#include "meshprep/read/scan.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

namespace {

// A surface has about six corners per vertex. The limit keeps 10 MB of arbitrary bytes from giving tens of millions of
// triangles.
constexpr std::size_t kMaxCornersPerVertex = 64;
constexpr std::size_t kMinCornerLimit = 65536;

enum class Format { kObj, kPly, kStl, kOff };

Format detectFormat(const std::filesystem::path& path, std::string& extension) {
  extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return Format::kObj;
  if (extension == ".ply") return Format::kPly;
  if (extension == ".stl") return Format::kStl;
  if (extension == ".off") return Format::kOff;
  throw Error(path.string(), "unknown file type", "an extension of .obj, .ply, .stl, .off, .gltf or .glb",
              extension.empty() ? "no extension" : extension);
}

Scan scanFile(Format format, std::string& bytes, const std::string& where, bool strict) {
  switch (format) {
    case Format::kObj:
      return scanObj(bytes, where, strict);
    case Format::kPly:
      return scanPly(bytes, where, strict);
    case Format::kStl:
      return scanStl(bytes, where, strict);
    case Format::kOff:
      break;
  }
  return scanOff(bytes, where, strict);
}

}  // namespace

Polygons readMesh(const std::filesystem::path& path, bool strict) {
  if (isGltf(path)) return mergeInstances(readGltf(path, strict, false, KeepTextures::none));
  const std::string where = path.string();
  std::string extension;
  const Format format = detectFormat(path, extension);

  // Remove a byte order mark, which hides the first word of a text file.
  std::string bytes = readTextFile(path);
  if (bytes.empty()) throw Error(where, "file is empty", "a mesh");
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    throw Error(where, "file is UTF-16 text", "ASCII or UTF-8");
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  Scan scan = scanFile(format, bytes, where, strict);
  const Polygons& polygons = scan.polygons;
  if (polygons.positions.empty()) {
    if (scan.firstInvalid) throw Error(*scan.firstInvalid);
    throw Error(where, "file has no vertices", "a mesh");
  }
  if (polygons.faceCount() == 0) {
    if (scan.firstInvalid) throw Error(*scan.firstInvalid);
    throw Error(where, "file has no faces", "a mesh");
  }
  const std::size_t mostCorners = kMinCornerLimit + kMaxCornersPerVertex * polygons.positions.size();
  if (polygons.corners.size() > mostCorners)
    throw Error(where, "too many corners",
                fmt::format("at most {} corners for {} vertices", mostCorners, polygons.positions.size()),
                fmt::to_string(polygons.corners.size()));
  return std::move(scan.polygons);
}

}  // namespace malus::prep

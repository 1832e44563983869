#include "meshprep/read/read_mesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <glm/common.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/read/read_gltf.h"
#include "meshprep/read/scan.h"
#include "meshprep/read/source_scene.h"

namespace malus::prep {

namespace {

enum class Format { kObj, kPly, kStl, kOff };

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

// Takes faces as OpenMesh's readers find them. Returns no handle: the readers then attach nothing to them.
class Collector : public OpenMesh::IO::ImporterT<PolyMesh> {
 public:
  explicit Collector(PolyMesh& mesh) : ImporterT(mesh) {}

  using ImporterT::add_face;
  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    for (const OpenMesh::VertexHandle& corner : corners) corners_.push_back(corner.idx());
    firstCorner_.push_back(corners_.size());
    return OpenMesh::FaceHandle();
  }
  std::size_t n_faces() const override { return firstCorner_.size() - 1; }

  std::span<const int> face(std::size_t i) const {
    return std::span(corners_).subspan(firstCorner_[i], firstCorner_[i + 1] - firstCorner_[i]);
  }

 private:
  std::vector<int> corners_;
  std::vector<std::size_t> firstCorner_ = {0};
};

// OpenMesh's readers are global objects and report to global streams: one at a time, and silently.
class Quiet {
 public:
  Quiet() : lock_(mutex()), error_(omerr().is_enabled()), log_(omlog().is_enabled()), out_(omout().is_enabled()) {
    omerr().disable();
    omlog().disable();
    omout().disable();
  }
  ~Quiet() {
    if (error_) omerr().enable();
    if (log_) omlog().enable();
    if (out_) omout().enable();
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
  bool error_, log_, out_;
};

Format formatOf(const std::filesystem::path& path, std::string& extension) {
  extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return Format::kObj;
  if (extension == ".ply") return Format::kPly;
  if (extension == ".stl") return Format::kStl;
  if (extension == ".off") return Format::kOff;
  throw Error(path.string(), "is of an unknown kind", "a name that ends in .obj, .ply, .stl, .off, .gltf or .glb",
              extension.empty() ? "no extension" : extension);
}

// Both are the same decimal or binary number, one of them through float (which may round twice).
bool sameThroughFloat(double exact, double throughFloat) {
  const double tolerance = std::abs(exact) * 2 * static_cast<double>(std::numeric_limits<float>::epsilon()) +
                           static_cast<double>(std::numeric_limits<float>::min());
  return std::abs(exact - throughFloat) <= tolerance;
}

bool samePosition(const glm::dvec3& exact, const OpenMesh::Vec3d& read) {
  return sameThroughFloat(exact.x, read[0]) && sameThroughFloat(exact.y, read[1]) && sameThroughFloat(exact.z, read[2]);
}

// OpenMesh's STL reader takes corners for one where no coordinate differs by more than FLT_MIN.
bool mergedByStl(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr auto kEpsilon = static_cast<double>(std::numeric_limits<float>::min());
  const glm::dvec3 off = glm::abs(glm::dvec3(glm::vec3(a)) - glm::dvec3(glm::vec3(b)));
  return off.x <= kEpsilon && off.y <= kEpsilon && off.z <= kEpsilon;
}

// Whether a corner that OpenMesh read is the one that the scan read.
class CornerCheck {
 public:
  CornerCheck(const Polygons& scan, const PolyMesh& mesh, bool byPosition)
      : scan_(scan), mesh_(mesh), byPosition_(byPosition) {}

  bool same(std::uint32_t scanned, int read) const {
    if (read < 0 || static_cast<std::size_t>(read) >= mesh_.n_vertices()) return false;
    if (!byPosition_) return scanned == static_cast<std::uint32_t>(read);
    return samePosition(scan_.positions[scanned], mesh_.point(OpenMesh::VertexHandle(read)));
  }
  bool same(std::span<const std::uint32_t> scanned, std::span<const int> read) const {
    return std::equal(scanned.begin(), scanned.end(), read.begin(), read.end(),
                      [this](std::uint32_t a, int b) { return same(a, b); });
  }

  // The corners without those that repeat an earlier one, as OpenMesh's OBJ reader keeps them.
  std::vector<std::uint32_t> withoutRepeats(std::span<const std::uint32_t> face) const {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t corner : face) {
      const auto repeats = [&](std::uint32_t other) {
        return byPosition_ ? mergedByStl(scan_.positions[corner], scan_.positions[other]) : corner == other;
      };
      if (std::none_of(kept.begin(), kept.end(), repeats)) kept.push_back(corner);
    }
    return kept;
  }

 private:
  const Polygons& scan_;
  const PolyMesh& mesh_;
  bool byPosition_;
};

// OpenMesh drops faces of fewer than three different corners and shortens others; cleaning shall count
// those, so the scan's are kept. Everything else must be equal.
void requireSame(const Polygons& scan, const PolyMesh& mesh, const Collector& read, bool byPosition,
                 const std::string& where) {
  const auto fail = [&](std::string_view what, std::string_view expected, std::string_view found) {
    throw Error(where, fmt::format("OpenMesh reads {} differently than the file has them", what), expected, found);
  };

  // Step 1: vertices. STL's are merged by OpenMesh, so their corners are compared by position below.
  if (!byPosition) {
    if (mesh.n_vertices() != scan.positions.size())
      fail("the vertices", fmt::to_string(scan.positions.size()), fmt::to_string(mesh.n_vertices()));
    for (std::size_t i = 0; i < scan.positions.size(); ++i) {
      const OpenMesh::Vec3d p = mesh.point(OpenMesh::VertexHandle(static_cast<int>(i)));
      if (!samePosition(scan.positions[i], p))
        fail(fmt::format("the coordinates of vertex {}", i),
             fmt::format("({}, {}, {})", scan.positions[i].x, scan.positions[i].y, scan.positions[i].z),
             fmt::format("({}, {}, {})", p[0], p[1], p[2]));
    }
  }

  // Step 2: faces, in order.
  const CornerCheck check(scan, mesh, byPosition);
  std::size_t next = 0;
  for (std::size_t f = 0; f < scan.faceCount(); ++f) {
    const bool more = next < read.n_faces();
    if (more && check.same(scan.face(f), read.face(next))) {
      ++next;
      continue;
    }
    const std::vector<std::uint32_t> kept = check.withoutRepeats(scan.face(f));
    if (kept.size() < 3) continue;
    if (!more || !check.same(kept, read.face(next)))
      fail("the faces", fmt::format("face {} with {} corners", f, scan.face(f).size()),
           more ? fmt::format("{} other corners", read.face(next).size()) : "no more faces");
    ++next;
  }
  if (next != read.n_faces()) fail("the faces", fmt::to_string(next), fmt::to_string(read.n_faces()));
}

}  // namespace

Polygons readMesh(const std::filesystem::path& path) {
  if (isGltf(path)) return merged(readGltf(path));
  const std::string where = path.string();
  std::string extension;
  const Format format = formatOf(path, extension);

  // Step 1: scan. A byte order mark hides a text file's first word from every reader.
  std::string bytes = readTextFile(path);
  if (bytes.empty()) throw Error(where, "is empty", "a mesh");
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    throw Error(where, "is UTF-16 text", "ASCII or UTF-8");
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  Polygons scan;
  bool isBinary = false;
  switch (format) {
    case Format::kObj:
      scan = scanObj(bytes, where);
      break;
    case Format::kPly:
      scan = scanPly(bytes, where);
      break;
    case Format::kStl:
      scan = scanStl(bytes, where, isBinary);
      break;
    case Format::kOff:
      scan = scanOff(bytes, where);
      break;
  }
  if (scan.positions.empty()) throw Error(where, "has no vertices");
  if (scan.faceCount() == 0) throw Error(where, "has no faces");

  // Step 2: OpenMesh, from the very bytes that were scanned.
  PolyMesh mesh;
  Collector collector(mesh);
  {
    const Quiet quiet;
    OpenMesh::IO::Options options;
    if (isBinary) options += OpenMesh::IO::Options::Binary;
    std::istringstream stream(std::move(bytes));
    bool read = false;
    try {
      read = OpenMesh::IO::IOManager().read(stream, extension, collector, options);
    } catch (const std::exception& failure) {
      throw Error(where, "OpenMesh cannot read it", "", failure.what());
    }
    if (!read) throw Error(where, "OpenMesh cannot read it");
  }

  // Step 3: both must agree.
  requireSame(scan, mesh, collector, format == Format::kStl, where);
  return scan;
}

}  // namespace malus::prep

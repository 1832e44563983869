#include "tests/meshprep/read/crosscheck.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <glm/common.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep::test {

namespace {

constexpr std::size_t kMaxOpenMeshCorners = 256;
constexpr std::string_view kWhere = "crosscheck";

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

// Collects the faces that OpenMesh's readers find. Returns no handles, so that the readers attach nothing to them.
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

// Silences OpenMesh, whose readers are global objects that report to global streams, for one reading at a time.
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

// True if both come from the same number, one of them through float, which may round twice.
bool sameThroughFloat(double exact, double throughFloat) {
  const double tolerance = std::abs(exact) * 2 * static_cast<double>(std::numeric_limits<float>::epsilon()) +
                           static_cast<double>(std::numeric_limits<float>::min());
  return std::abs(exact - throughFloat) <= tolerance;
}

bool samePosition(const glm::dvec3& exact, const OpenMesh::Vec3d& read) {
  return sameThroughFloat(exact.x, read[0]) && sameThroughFloat(exact.y, read[1]) && sameThroughFloat(exact.z, read[2]);
}

// OpenMesh's STL reader merges corners if no coordinate differs by more than FLT_MIN.
bool mergedByStl(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr auto kEpsilon = static_cast<double>(std::numeric_limits<float>::min());
  const glm::dvec3 off = glm::abs(glm::dvec3(glm::vec3(a)) - glm::dvec3(glm::vec3(b)));
  return off.x <= kEpsilon && off.y <= kEpsilon && off.z <= kEpsilon;
}

// Comparison of a corner that OpenMesh read with a corner of the scan.
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

  // The corners without repetitions, as OpenMesh's OBJ reader keeps them.
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

// OpenMesh drops faces with fewer than three different corners and removes repeated corners from others; the scan keeps
// them, because cleaning counts them. Everything else must be equal.
void requireSame(const Polygons& scan, const PolyMesh& mesh, const Collector& read, bool byPosition) {
  const auto fail = [&](std::string_view what, std::string_view expected, std::string_view found) {
    throw Error(kWhere, fmt::format("OpenMesh reads other {}", what), expected, found);
  };

  // Step 1: vertices. STL's are merged by OpenMesh, so their corners are compared by position below.
  if (!byPosition) {
    if (mesh.n_vertices() != scan.positions.size())
      fail("vertices", fmt::to_string(scan.positions.size()), fmt::to_string(mesh.n_vertices()));
    for (std::size_t i = 0; i < scan.positions.size(); ++i) {
      const OpenMesh::Vec3d p = mesh.point(OpenMesh::VertexHandle(static_cast<int>(i)));
      if (!samePosition(scan.positions[i], p))
        fail(fmt::format("coordinates of vertex {}", i),
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
      fail("faces", fmt::format("face {} with {} corners", f, scan.face(f).size()),
           more ? fmt::format("{} other corners", read.face(next).size()) : "no more faces");
    ++next;
  }
  if (next != read.n_faces()) fail("faces", fmt::to_string(next), fmt::to_string(read.n_faces()));
}

}  // namespace

void requireSameAsOpenMesh(std::string bytes, std::string_view extension, const Scan& scan) {
  PolyMesh mesh;
  Collector collector(mesh);
  {
    const Quiet quiet;
    OpenMesh::IO::Options options;
    if (scan.isBinary) options += OpenMesh::IO::Options::Binary;
    std::istringstream stream(std::move(bytes));
    bool read = false;
    try {
      read = OpenMesh::IO::IOManager().read(stream, std::string(extension), collector, options);
    } catch (const std::exception& failure) {
      throw Error(kWhere, "OpenMesh cannot read the file", "", failure.what());
    }
    if (!read) throw Error(kWhere, "OpenMesh cannot read the file");
  }
  requireSame(scan.polygons, mesh, collector, extension == ".stl");
}

Polygons readCrosschecked(const std::filesystem::path& path) {
  Polygons polygons = readMesh(path);
  const std::string extension = path.extension().string(), where = path.string();
  std::string bytes = readTextFile(path);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  const Scan scan = extension == ".obj"   ? scanObj(bytes, where)
                    : extension == ".ply" ? scanPly(bytes, where)
                    : extension == ".stl" ? scanStl(bytes, where)
                                          : scanOff(bytes, where);
  bool hasLargeFace = false;
  for (std::size_t i = 0; i < polygons.faceCount(); ++i)
    hasLargeFace = hasLargeFace || polygons.face(i).size() > kMaxOpenMeshCorners;
  if (scan.openMeshReads && !hasLargeFace) requireSameAsOpenMesh(std::move(bytes), extension, scan);
  return polygons;
}

Polygons readCrosschecked(std::string_view extension, const std::string& text) {
  return readCrosschecked(TemporaryFile(extension, text).path());
}

}  // namespace malus::prep::test

#include "meshprep/instances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "meshprep/base/error.h"
#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/disjoint_sets.h"
#include "meshprep/clean/junctions.h"
#include "meshprep/clean/touching_boxes.h"
#include "meshprep/compress/draco_mesh.h"

namespace malus::prep {

namespace {

constexpr std::size_t kMaxShapes = 8;           // per part, that a further instance is compared with
constexpr double kSimilarityTolerance = 1e-12;  // relative: rounding errors of products of matrices
constexpr std::uint64_t kMaxBoxPairs = std::uint64_t{1} << 24u;

// Instances that are prepared together, ascending.
struct Group {
  std::vector<std::size_t> instances;
  std::vector<std::uint32_t> firstVertex, firstFace;  // of each instance, in the merged polygons of the group
};

// The result for a group.
struct Piece {
  const Group* group = nullptr;
  Mesh mesh;
  Report report;
};

// A piece at the place of a group, which has as many instances as the group of the piece.
struct PlacedPiece {
  const Piece* piece = nullptr;
  const Group* group = nullptr;
  glm::dmat3 linear{1.0};  // placed = linear * p + translation: a similarity
  glm::dvec3 translation{0};
  double scale = 1;
  bool isMoved = false;
};

// Returns the scale if the matrix is a rotation or a reflection with a scale.
std::optional<double> similarityScale(const glm::dmat3& m) {
  const double squared = glm::dot(m[0], m[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (!(std::abs(glm::dot(m[i], m[j]) - (i == j ? squared : 0)) <= kSimilarityTolerance * squared))
        return std::nullopt;
  return std::sqrt(squared);
}

// Number of the part of a list of first numbers that contains i.
std::size_t partAt(const std::vector<std::uint32_t>& first, std::uint32_t i) {
  return static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), i) - first.begin()) - 1;
}

class InstancePreparation {
 public:
  InstancePreparation(const SourceScene& scene, const std::string& source, const Options& options, Report& report)
      : scene_(scene), source_(source), options_(options), report_(report) {}

  Mesh run() {
    Mesh mesh;
    if (!canSplit() || !makeGroups() || !preparePieces() || !assemble(mesh))
      return prepare(mergeInstances(scene_), source_, options_, report_);
    compress::requireAcceptedSize(mesh.positions, source_);
    return mesh;
  }

 private:
  const Polygons& polygons(std::size_t instance) const {
    return scene_.parts[scene_.instances[instance].part].polygons;
  }

  // Returns true if a mesh has several places, and the options act on each mesh alone.
  bool canSplit() const {
    std::vector<char> seen(scene_.parts.size(), 0);
    const bool repeats = std::any_of(scene_.instances.begin(), scene_.instances.end(),
                                     [&](const SourceInstance& i) { return std::exchange(seen[i.part], 1) != 0; });
    return repeats && !options_.asIs && !options_.simplify.any() && options_.weldRelative == 0;
  }

  glm::dvec3 place(std::size_t instance, const glm::dvec3& p) const { return toWorld(scene_.instances[instance], p); }

  // Returns the boxes of the instances, with the margin within which steps see other faces.
  std::vector<Box> findBoxes() const {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
      glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
      for (const glm::dvec3& p : polygons(i).positions) {
        const glm::dvec3 placed = place(i, p);
        low = glm::min(low, placed);
        high = glm::max(high, placed);
      }
      const double margin = std::max(options_.steps.weldTolerance, 2 * kJunctionTolerance * glm::distance(low, high));
      boxes.push_back({low - margin, high + margin});
    }
    return boxes;
  }

  // Groups the instances whose boxes overlap. Returns false if that gives one group, or takes too long.
  bool makeGroups() {
    const std::vector<Box> boxes = findBoxes();
    std::optional<DisjointSets> sets = touchingSets(boxes, kMaxBoxPairs);
    if (!sets) return false;
    std::map<std::uint32_t, Group> groups;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      groups[sets->find(static_cast<std::uint32_t>(i))].instances.push_back(i);
      firstVertex_.push_back(vertices_);
      firstFace_.push_back(faces_);
      vertices_ += countVertices(i);
      faces_ += countFaces(i);
    }
    for (auto& [first, group] : groups) {
      std::uint32_t vertices = 0, faces = 0;
      for (const std::size_t i : group.instances) {
        group.firstVertex.push_back(std::exchange(vertices, vertices + countVertices(i)));
        group.firstFace.push_back(std::exchange(faces, faces + countFaces(i)));
      }
      groups_.push_back(std::move(group));
    }
    return groups_.size() > 1;
  }

  std::uint32_t countVertices(std::size_t i) const { return static_cast<std::uint32_t>(polygons(i).positions.size()); }
  std::uint32_t countFaces(std::size_t i) const { return static_cast<std::uint32_t>(polygons(i).faceCount()); }

  // Returns false if a piece has an error or a refused certificate, or depends on meshes elsewhere.
  bool preparePieces() {
    std::map<std::size_t, std::vector<const Piece*>> shapes;  // pieces of one instance, by part
    for (const Group& group : groups_) {
      std::vector<const Piece*>* known = nullptr;
      if (group.instances.size() == 1) known = &shapes[scene_.instances[group.instances[0]].part];
      if (known != nullptr && shareFrom(*known, group)) continue;
      auto piece = std::make_unique<Piece>();
      piece->group = &group;
      try {
        piece->mesh = prepare(mergeInstances(scene_, group.instances), source_, options_, piece->report);
      } catch (const Error&) {
        return false;
      }
      const Report& report = piece->report;
      if ((options_.certifyGlass && !report.certificate.isGranted()) ||
          report.count("components-oriented-by-visibility") + report.count("components-oriented-by-majority") > 0)
        return false;
      placed_.push_back({piece.get(), &group});
      if (known != nullptr && known->size() < kMaxShapes) known->push_back(piece.get());
      pieces_.push_back(std::move(piece));
    }
    return true;
  }

  // Places one of the pieces as this instance, if a similarity does.
  bool shareFrom(const std::vector<const Piece*>& known, const Group& group) {
    const glm::dmat4& to = scene_.instances[group.instances[0]].worldFromObject;
    for (const Piece* piece : known) {
      const glm::dmat4& from = scene_.instances[piece->group->instances[0]].worldFromObject;
      const glm::dmat3 linear = glm::dmat3(to) * glm::inverse(glm::dmat3(from));
      const std::optional<double> scale = similarityScale(linear);
      if (!scale || (options_.steps.weldTolerance > 0 && std::abs(*scale - 1) > kSimilarityTolerance)) continue;
      placed_.push_back({piece, &group, linear, glm::dvec3(to[3]) - linear * glm::dvec3(from[3]), *scale, true});
      return true;
    }
    return false;
  }

  // Returns false if rounding at a place makes corners equal that differ in the piece.
  bool assemble(Mesh& mesh) {
    std::size_t vertices = 0, triangles = 0;
    for (const PlacedPiece& placed : placed_) {
      vertices += placed.piece->mesh.positions.size();
      triangles += placed.piece->mesh.triangles.size();
    }
    mesh.positions.reserve(vertices);
    mesh.sourceVertices.reserve(vertices);
    mesh.triangles.reserve(triangles);
    mesh.sourceFaces.reserve(triangles);
    if (!options_.flat) mesh.normals.reserve(vertices);
    report_ = {};
    report_.source = source_;
    report_.notes = notesOfMeshes(scene_);
    report_.certificate.checked = options_.certifyGlass;
    std::map<const Piece*, std::uint32_t> originals;
    for (const PlacedPiece& placed : placed_) {
      const auto number = static_cast<std::uint32_t>(mesh.pieces.size());
      mesh.pieces.push_back(
          {static_cast<std::uint32_t>(mesh.positions.size()), static_cast<std::uint32_t>(mesh.triangles.size()),
           originals.try_emplace(placed.piece, number).first->second, placed.linear, placed.translation, placed.scale});
      if (!appendMesh(placed, mesh)) return false;
      appendReport(placed);
    }
    report_.input.vertices = vertices_;
    report_.input.faces = faces_;
    report_.output.vertices = vertices;
    report_.output.triangles = triangles;
    return true;
  }

  // Numbers in the merged polygons of the scene.
  std::uint32_t vertexNumber(const PlacedPiece& placed, std::uint32_t v) const {
    if (v == kNoSource) return v;
    const std::vector<std::uint32_t>& first = placed.piece->group->firstVertex;
    const std::size_t k = partAt(first, v);
    return firstVertex_[placed.group->instances[k]] + (v - first[k]);
  }
  std::uint32_t faceNumber(const PlacedPiece& placed, std::uint32_t f) const {
    const std::vector<std::uint32_t>& first = placed.piece->group->firstFace;
    const std::size_t k = partAt(first, f);
    return firstFace_[placed.group->instances[k]] + (f - first[k]);
  }

  bool appendMesh(const PlacedPiece& placed, Mesh& mesh) const {
    const Mesh& from = placed.piece->mesh;
    const auto firstVertex = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t instance = placed.group->instances[0];
    const bool mirrors = placed.isMoved && glm::determinant(placed.linear) < 0;
    for (std::size_t v = 0; v < from.positions.size(); ++v) {
      const std::uint32_t number = from.sourceVertices[v];
      mesh.sourceVertices.push_back(vertexNumber(placed, number));
      if (!placed.isMoved)
        mesh.positions.push_back(from.positions[v]);
      else if (number == kNoSource)
        mesh.positions.push_back(placed.linear * from.positions[v] + placed.translation);
      else
        mesh.positions.push_back(place(instance, polygons(instance).positions[number]));
    }
    for (const glm::vec3& n : from.normals)
      mesh.normals.push_back(placed.isMoved ? glm::vec3(glm::normalize(placed.linear * glm::dvec3(n))) : n);
    appendTextures(placed, mirrors, mesh);
    for (const std::uint32_t f : from.sourceFaces) mesh.sourceFaces.push_back(faceNumber(placed, f));
    for (glm::uvec3 t : from.triangles) {
      if (mirrors) std::swap(t.y, t.z);
      t += firstVertex;
      const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      if (placed.isMoved && (a == b || b == c || c == a)) return false;
      mesh.triangles.push_back(t);
    }
    return true;
  }

  // Appends the texture attributes that any piece has. Those of a piece without are zero, and any tangent.
  void appendTextures(const PlacedPiece& placed, bool mirrors, Mesh& mesh) const {
    const Mesh& from = placed.piece->mesh;
    const auto anyHas = [&](auto has) {
      return std::any_of(placed_.begin(), placed_.end(), [&](const PlacedPiece& p) { return has(p.piece->mesh); });
    };
    for (std::size_t set = 0; set < from.textureCoordinates.size(); ++set) {
      if (!anyHas([set](const Mesh& m) { return !m.textureCoordinates[set].empty(); })) continue;
      std::vector<glm::vec2>& to = mesh.textureCoordinates[set];
      to.insert(to.end(), from.textureCoordinates[set].begin(), from.textureCoordinates[set].end());
      to.resize(mesh.positions.size(), glm::vec2(0));
    }
    if (!anyHas([](const Mesh& m) { return !m.tangents.empty(); })) return;
    for (const glm::vec4& t : from.tangents)
      mesh.tangents.push_back(
          placed.isMoved ? glm::vec4(glm::vec3(glm::normalize(placed.linear * glm::dvec3(t))), mirrors ? -t.w : t.w)
                         : t);
    mesh.tangents.resize(mesh.positions.size(), glm::vec4(1, 0, 0, 1));
  }

  glm::dvec3 moved(const PlacedPiece& placed, const glm::dvec3& at) const {
    return placed.isMoved ? placed.linear * at + placed.translation : at;
  }

  void appendReport(const PlacedPiece& placed) {
    const Report& from = placed.piece->report;
    for (std::size_t i = 0; i < from.steps.size(); ++i) {
      // Pieces with texture coordinates have further steps at the end.
      if (i == report_.steps.size()) report_.steps.push_back({from.steps[i].name, 0, {}});
      Step& step = report_.steps[i];
      // Steps that may be incomplete state 0 or 1.
      const bool isFlag = step.name == "cleaning-not-converged" || step.name == "t-junctions-unchecked" ||
                          step.name == "faces-crossing-unchecked";
      step.count = isFlag ? std::max(step.count, from.steps[i].count) : step.count + from.steps[i].count;
      for (Finding finding : from.steps[i].findings) {
        if (step.findings.size() >= kListed) break;
        for (std::uint32_t& v : finding.vertices) v = vertexNumber(placed, v);
        for (std::uint32_t& f : finding.faces) f = faceNumber(placed, f);
        finding.at = moved(placed, finding.at);
        step.findings.push_back(std::move(finding));
      }
    }
    for (Component component : from.components) {
      component.signedVolume *= placed.scale * placed.scale * placed.scale;
      component.at = moved(placed, component.at);
      component.firstFace = faceNumber(placed, component.firstFace);
      report_.components.push_back(component);
    }
  }

  const SourceScene& scene_;
  const std::string& source_;
  const Options& options_;
  Report& report_;
  std::vector<Group> groups_;
  std::vector<std::unique_ptr<Piece>> pieces_;
  std::vector<PlacedPiece> placed_;
  std::vector<std::uint32_t> firstVertex_, firstFace_;  // of each instance, in the merged polygons of the scene
  std::uint32_t vertices_ = 0, faces_ = 0;
};

}  // namespace

Mesh prepareInstances(const SourceScene& scene, const std::string& source, const Options& options, Report& report) {
  return InstancePreparation(scene, source, options, report).run();
}

}  // namespace malus::prep

#include "bake/meshes/instances.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "bake/pack/format.h"
#include "meshprep/compress/shared_positions.h"

namespace malus::bake {

namespace {

using pack::Box;

constexpr double kGlassMargin = 0x1p-10;      // of the largest extent of a body: more than its grid's step
constexpr double kSharedTolerance = 0x1p-46;  // of the largest coordinate: 64 rounding errors of double
constexpr std::size_t kMostNeighbours = 8;    // with more, all vertices are compared

// Reasons for a separate mesh.
enum class Reason : std::uint8_t { none, condition, shared, glass };
constexpr std::size_t kReasons = 4;
constexpr std::array<const char*, kReasons> kReasonTexts = {
    "", "a transform that scales lengths by factors beyond 1:1000", "positions that other meshes share",
    "glass beside other glass"};

bool overlap(const Box& a, const Box& b) {
  return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

bool contains(const Box& box, const glm::dvec3& p) {
  return glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
}

Box widened(const Box& box, double margin) { return {box.low - margin, box.high + margin}; }

// Calls visit(point) for the vertices of a place, in world space.
template <class Visit>
void forEachPoint(const PlacedMesh& placed, Visit visit) {
  const glm::dmat3 m(placed.worldFromObject);
  const glm::dvec3 translation(placed.worldFromObject[3]);
  for (const glm::dvec3& p : placed.source->positions) visit(m * p + translation);
}

// Calls visit(i, j) for the boxes that overlap or touch; i < j in the order of their low x.
template <class Visit>
void forOverlapping(const std::vector<Box>& boxes, Visit visit) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return boxes[a].low.x < boxes[b].low.x; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].low.x <= boxes[order[i]].high.x; ++j)
      if (overlap(boxes[order[i]], boxes[order[j]])) visit(order[i], order[j]);
}

class Chooser {
 public:
  Chooser(const std::vector<PlacedMesh>& placed, const std::vector<pack::Material>& materials)
      : placed_(placed), materials_(materials), reasons_(placed.size(), Reason::none) {}

  InstanceChoice choose() {
    for (const PlacedMesh& mesh : placed_) {
      Box& box = boxes_.emplace_back();
      forEachPoint(mesh, [&](const glm::dvec3& p) { box.add(p); });
      choice_.box.add(box);
    }
    choice_.first.resize(placed_.size());
    std::iota(choice_.first.begin(), choice_.first.end(), std::size_t{0});
    const std::vector<std::vector<std::size_t>> groups = findGroups();
    if (groups.empty()) return std::move(choice_);
    std::vector<char> isCandidate(placed_.size(), 0);
    for (const std::vector<std::size_t>& group : groups)
      for (const std::size_t i : group) isCandidate[i] = 1;
    leaveOutShared(isCandidate);
    leaveOutGlass();
    for (const std::vector<std::size_t>& group : groups) chooseIn(group);
    return std::move(choice_);
  }

 private:
  std::size_t triangles(std::size_t place) const { return placed_[place].source->triangles.size(); }

  bool saves(std::size_t count, std::size_t place) const {
    return count > 1 && (count - 1) * triangles(place) >= kLeastSavedTriangles;
  }

  // Places of one mesh, for which instances save enough.
  std::vector<std::vector<std::size_t>> findGroups() const {
    std::map<std::tuple<const prep::Mesh*, std::uint32_t, bool>, std::vector<std::size_t>> byMesh;
    for (std::size_t i = 0; i < placed_.size(); ++i)
      byMesh[{placed_[i].source.get(), placed_[i].packed.material, placed_[i].packed.openSurface}].push_back(i);
    std::vector<std::vector<std::size_t>> groups;
    for (auto& [key, group] : byMesh)
      if (saves(group.size(), group.front())) groups.push_back(std::move(group));
    std::sort(groups.begin(), groups.end());  // not by address
    return groups;
  }

  // Leaves out the candidates that share positions with any other place.
  void leaveOutShared(const std::vector<char>& isCandidate) {
    const double tolerance = pack::farthestCoordinate(choice_.box) * kSharedTolerance;
    std::vector<Box> wide;
    wide.reserve(boxes_.size());
    for (const Box& box : boxes_) wide.push_back(widened(box, tolerance));
    std::vector<std::vector<std::size_t>> neighbours(placed_.size());
    forOverlapping(wide, [&](std::size_t i, std::size_t j) {
      if (isCandidate[i] == 0 && isCandidate[j] == 0) return;
      if (neighbours[i].size() <= kMostNeighbours) neighbours[i].push_back(j);
      if (neighbours[j].size() <= kMostNeighbours) neighbours[j].push_back(i);
    });

    // Compare the vertices that are in the boxes of others.
    std::vector<std::vector<glm::dvec3>> points(placed_.size());
    std::vector<compress::MeshView> views;
    views.reserve(placed_.size());
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!neighbours[i].empty())
        forEachPoint(placed_[i], [&](const glm::dvec3& p) {
          if (neighbours[i].size() > kMostNeighbours ||
              std::any_of(neighbours[i].begin(), neighbours[i].end(),
                          [&](std::size_t other) { return contains(wide[other], p); }))
            points[i].push_back(p);
        });
      views.emplace_back(points[i], std::span<const glm::vec3>(), std::span<const glm::uvec3>());
    }
    const compress::SharedPositions shared = compress::findSharedPositions(views, tolerance);
    for (std::size_t i = 0; i < placed_.size(); ++i)
      if (!shared.vertices[i].empty()) reasons_[i] = Reason::shared;
  }

  void leaveOutGlass() {
    std::vector<Box> wide;
    std::vector<std::size_t> bodies;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!pack::hasInside(materials_[placed_[i].packed.material].kind) || boxes_[i].isEmpty()) continue;
      const glm::dvec3 extent = boxes_[i].high - boxes_[i].low;
      wide.push_back(widened(boxes_[i], std::max({extent.x, extent.y, extent.z}) * kGlassMargin));
      bodies.push_back(i);
    }
    forOverlapping(wide, [&](std::size_t i, std::size_t j) {
      for (const std::size_t body : {bodies[i], bodies[j]})
        if (reasons_[body] == Reason::none) reasons_[body] = Reason::glass;
    });
  }

  void chooseIn(const std::vector<std::size_t>& group) {
    std::vector<std::size_t> kept;
    std::array<std::size_t, kReasons> leftOut{};
    for (const std::size_t i : group) {
      if (reasons_[i] == Reason::none && !kept.empty()) {
        pack::Instance instance;
        setPlace(placed_[kept.front()].worldFromObject, placed_[i].worldFromObject, glm::dvec3(0.0), instance);
        if (!(pack::measureStretch(instance.linear).condition() <= pack::kMaxInstanceCondition))
          reasons_[i] = Reason::condition;
      }
      if (reasons_[i] == Reason::none)
        kept.push_back(i);
      else
        ++leftOut[static_cast<std::size_t>(reasons_[i])];
    }
    if (!saves(kept.size(), group.front())) kept.clear();
    for (const std::size_t i : kept) choice_.first[i] = kept.front();
    addReason(group, kept.size(), leftOut);
  }

  void addReason(const std::vector<std::size_t>& group, std::size_t kept,
                 const std::array<std::size_t, kReasons>& leftOut) {
    std::vector<std::string> others;
    for (std::size_t r = 1; r < kReasons; ++r)
      if (leftOut[r] > 0) others.push_back(fmt::format("{} ({})", kReasonTexts[r], leftOut[r]));
    choice_.reasons.push_back(
        fmt::format("instances: mesh '{}' of {} triangles is placed {} times and stored {}{}{}",
                    placed_[group.front()].packed.name, triangles(group.front()), group.size(),
                    kept == group.size() ? "once" : fmt::format("{} times", group.size() - (kept > 0 ? kept - 1 : 0)),
                    others.empty() ? "" : ", because of ", fmt::join(others, ", ")));
  }

  const std::vector<PlacedMesh>& placed_;
  const std::vector<pack::Material>& materials_;
  std::vector<Box> boxes_;  // per place, in world space
  std::vector<Reason> reasons_;
  InstanceChoice choice_;
};

}  // namespace

InstanceChoice chooseInstances(const std::vector<PlacedMesh>& placed, const std::vector<pack::Material>& materials) {
  return Chooser(placed, materials).choose();
}

void setPlace(const glm::dmat4& first, const glm::dmat4& other, const glm::dvec3& origin, pack::Instance& instance) {
  const glm::dmat3 from(first), to(other);
  instance.linear = from == to ? glm::dmat3(1.0) : to * glm::inverse(from);
  // Small differences, so that places far from the origin of world space lose nothing.
  instance.translation = (glm::dvec3(other[3]) - origin) - instance.linear * (glm::dvec3(first[3]) - origin);
}

}  // namespace malus::bake

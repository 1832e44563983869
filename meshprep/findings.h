// Findings of a step of preparation: their number, and the first ones with their location.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/mesh.h"

namespace malus::prep {

// A single finding. Vertices and faces are indices in the source file, from 0.
struct Finding {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> faces;
  glm::dvec3 at{0};            // metres, in the axes of the file
  std::string what;            // description; empty if the name of the step suffices
  std::string sourceLocation;  // "FILE:LINE" or "FILE, byte N"; set by prepare() if known
};

// Returns "faces 3, 4, vertex 7 at (1, 2, 3), model.obj:17", without unknown parts.
std::string describe(const Finding& finding);

// Largest number of listed findings of a step. All are counted.
inline constexpr std::size_t kListed = 1000;

struct Findings {
  std::uint64_t count = 0;
  std::vector<Finding> first;

  // Counts a finding, and calls make() for it if it is listed.
  template <class Make>
  void add(Make make) {
    ++count;
    if (first.size() < kListed) first.push_back(make());
  }

  void append(Findings other) {
    count += other.count;
    for (Finding& finding : other.first)
      if (first.size() < kListed) first.push_back(std::move(finding));
  }
};

// Index in the source file.
inline std::uint32_t sourceVertex(const Mesh& mesh, std::size_t vertex) {
  return mesh.sourceVertices.empty() ? static_cast<std::uint32_t>(vertex) : mesh.sourceVertices[vertex];
}
inline std::uint32_t sourceFace(const Mesh& mesh, std::size_t triangle) {
  return mesh.sourceFaces.empty() ? static_cast<std::uint32_t>(triangle) : mesh.sourceFaces[triangle];
}

// Returns a finding at these triangles and vertices of the current mesh.
inline Finding findingAt(const Mesh& mesh, const glm::dvec3& at, std::initializer_list<std::size_t> triangles,
                         std::initializer_list<std::size_t> vertices = {}, std::string what = {}) {
  Finding finding;
  for (const std::size_t t : triangles) finding.faces.push_back(sourceFace(mesh, t));
  for (const std::size_t v : vertices)
    if (sourceVertex(mesh, v) != kNoSource) finding.vertices.push_back(sourceVertex(mesh, v));
  finding.at = at;
  finding.what = std::move(what);
  return finding;
}

}  // namespace malus::prep

// Report of preparation: counts before and after, the findings of each step, connected components, certificate, and
// compression with its errors. Lengths are in metres, angles in degrees.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include "meshprep/certify/certificate.h"
#include "meshprep/clean/component.h"
#include "meshprep/findings.h"

namespace malus::prep {

// Findings of one step. The names ("vertices-welded", ...) are set in prepare.cpp and are stable.
struct Step {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Finding> findings;  // at most kListed; empty for steps that only count
};

// Result of simplification.
struct Simplification {
  bool applied = false;  // requested
  std::uint64_t trianglesBefore = 0, trianglesAfter = 0;
  double maxDeviation = 0;      // metres, an upper bound of the distance between the surfaces, in both directions
  double maxNormalDegrees = 0;  // between an original triangle and the simplified surface
  std::vector<std::string> warnings;
};

struct Report {
  std::string source;
  std::vector<std::string> notes;  // of the readers (Polygons::notes)
  struct {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
  } input;
  struct {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
  } output;
  std::vector<Step> steps;
  std::vector<Component> components;
  Simplification simplification;
  Certificate certificate;

  // Set if the mesh was compressed (bytes > 0).
  struct {
    double positionMax = 0;        // metres
    double normalMaxDegrees = 0;   // degrees
    double tiltMaxDegrees = 0;     // of faces with area
    double uvMaxTexels = 0;        // of texture coordinates, if there are any
    double tangentMaxDegrees = 0;  // of tangents
    std::uint64_t tilted = 0;      // faces tilted by more than 0.1 degrees
    double tiltedArea = 0;         // their area, square metres
    std::uint64_t flipped = 0;     // faces tilted by more than 90 degrees
    std::uint64_t degenerate = 0;  // faces that lost their area
  } errors;
  struct {
    std::string method;
    std::uint64_t bytes = 0;
    std::string sequentialReason;  // reason against edgebreaker; empty if it is used
    int positionBits = 0;
    glm::dvec3 origin{0};  // position = origin + step * integer, metres
    double step = 0;
    int normalBits = 0;                 // 0 without normals
    double encodeMs = 0, decodeMs = 0;  // processor time
    std::vector<std::string> warnings;  // exceeded default bounds
  } compression;

  // Returns the count of a step, 0 if there is no such step.
  std::uint64_t count(std::string_view step) const;
};

// {source, notes[], input{vertices, faces}, output{vertices, triangles},
//  steps[{name, count, findings[{vertices, faces, at, what, sourceLocation}]}],
//  components[{triangles, closed, orientable, flipped, signedVolume, hasVolume, at, firstFace}],
//  simplification{trianglesBefore, trianglesAfter, maxDeviation, maxNormalDegrees, warnings},
//  certificate{granted, problems[{component, what, where, repair}]}, errors{positionMax, normalMaxDegrees,
//  tiltMaxDegrees, tilted, tiltedArea, flipped, degenerate, uvMaxTexels, tangentMaxDegrees}, compression{method,
//  sequentialReason, bytes, bytesPerTriangle, positionBits, origin, step, normalBits, encodeMs, decodeMs, warnings}};
//  simplification and certificate only if requested, errors and compression only if the mesh was compressed, findings
//  and their members only if they are not empty.
nlohmann::json toJson(const Report& report);

// Returns a table for a terminal, which ends with a newline. Contains the steps with findings, and the first of each.
std::string toText(const Report& report);

}  // namespace malus::prep

// What preparation did to a mesh: counts before and after, one entry for every step with what it found and where, the
// connected components, what a certificate says, and the errors that compression adds. Lengths in metres, angles in
// degrees.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "meshprep/certify/certificate.h"
#include "meshprep/clean/component.h"
#include "meshprep/findings.h"

namespace malus::prep {

// One thing that was found or done, how often, and the first of them. Names are stable: see prepare.cpp, where they
// are given.
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
  std::vector<std::string> notes;  // what the file holds and reading left out
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

  // Set where the mesh was compressed: bytes > 0.
  struct {
    double positionMax = 0;        // metres
    double normalMaxDegrees = 0;   // degrees
    double tiltMaxDegrees = 0;     // of faces that have area
    std::uint64_t flipped = 0;     // faces tilted by more than 90 degrees
    std::uint64_t degenerate = 0;  // faces that lost their area
  } errors;
  struct {
    std::string method;
    std::uint64_t bytes = 0;
    std::string sequentialReason;  // empty where the method is edgebreaker
    int positionBits = 0;
    int normalBits = 0;                 // 0 where there are no normals
    double encodeMs = 0, decodeMs = 0;  // wall clock
    std::vector<std::string> warnings;  // default bounds that are not kept
  } compression;

  // The count of a step; 0 where there was no such step.
  std::uint64_t count(std::string_view step) const;
};

// {source, notes[], input{vertices, faces}, output{vertices, triangles},
//  steps[{name, count, findings[{vertices, faces, at, what, place}]}],
//  components[{triangles, closed, orientable, flipped, signedVolume, hasVolume, at, firstFace}],
//  simplification{trianglesBefore, trianglesAfter, maxDeviation, maxNormalDegrees, warnings},
//  certificate{holds, problems[{component, what, where, repair}]}, errors{positionMax, normalMaxDegrees,
//  tiltMaxDegrees, flipped, degenerate}, compression{method, sequentialReason, bytes, bytesPerTriangle, positionBits,
//  normalBits, encodeMs, decodeMs, warnings}}; simplification and certificate only where they were requested, errors
//  and compression only
// where the mesh was compressed, findings and their parts only where there are any.
nlohmann::json toJson(const Report& report);

// A table for a terminal, ending in a line break. Steps that found nothing are left out; of the others the first
// finding is shown.
std::string toText(const Report& report);

}  // namespace malus::prep

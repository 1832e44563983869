// What preparation did to a mesh: counts before and after, one count for every step, the connected
// components and the errors that compression adds. Lengths in metres, angles in degrees.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace malus::prep {

// One thing that was found or done, and how often. Names are stable: see prepare.cpp, where they are given.
struct Step {
  std::string name;
  std::uint64_t count = 0;
};

// Triangles connected through edges that exactly two triangles share.
struct Component {
  std::uint64_t triangles = 0;
  bool closed = false;        // every edge is shared by two triangles
  bool orientable = true;     // the two sides can be told apart
  std::uint64_t flipped = 0;  // triangles that were turned over
  double signedVolume = 0;    // cubic metres after orientation; 0 unless closed and orientable
};

struct Report {
  std::string source;
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
    std::string whySequential;  // empty where the method is edgebreaker
    int positionBits = 0;
    int normalBits = 0;                 // 0 where there are no normals
    double encodeMs = 0, decodeMs = 0;  // wall clock
    std::vector<std::string> warnings;  // default bounds that are not kept
  } compression;

  // The count of a step; 0 where there was no such step.
  std::uint64_t count(std::string_view step) const;
};

// {source, input{vertices, faces}, output{vertices, triangles}, steps[{name, count}],
//  components[{triangles, closed, orientable, flipped, signedVolume}], errors{positionMax, normalMaxDegrees,
//  tiltMaxDegrees, flipped, degenerate}, compression{method, whySequential, bytes, bytesPerTriangle, positionBits,
//  normalBits, encodeMs, decodeMs, warnings}}; errors and compression only where the mesh was compressed.
nlohmann::json toJson(const Report& report);

// A table for a terminal, ending in a line break. Steps that found nothing are left out.
std::string toText(const Report& report);

}  // namespace malus::prep

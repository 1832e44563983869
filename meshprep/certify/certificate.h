// Result of the certification of a mesh as glass (glass.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace malus::prep {

// A reason to refuse the certificate.
struct Problem {
  std::uint32_t component = 0;  // index into Report::components
  std::string what;             // kind and number: "3 open edges"
  std::string where;            // location of the first one
  std::string repair;           // proposed repair
};

struct Certificate {
  bool checked = false;           // the certificate was requested
  std::vector<Problem> problems;  // reasons to refuse it; empty if it is granted
  bool isGranted() const { return checked && problems.empty(); }
};

}  // namespace malus::prep

#include "meshprep/findings.h"

#include <algorithm>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace malus::prep {

namespace {

std::string describeIndices(std::string_view one, std::string_view many, const std::vector<std::uint32_t>& ids) {
  constexpr std::size_t kShown = 4;
  const std::span<const std::uint32_t> shown = std::span(ids).first(std::min(ids.size(), kShown));
  return fmt::format("{} {}{}", ids.size() == 1 ? one : many, fmt::join(shown, ", "),
                     ids.size() > kShown ? ", ..." : "");
}

}  // namespace

std::string describe(const Finding& finding) {
  std::vector<std::string> parts;
  if (!finding.what.empty()) parts.push_back(finding.what);
  if (!finding.faces.empty()) parts.push_back(describeIndices("face", "faces", finding.faces));
  if (!finding.vertices.empty()) parts.push_back(describeIndices("vertex", "vertices", finding.vertices));
  std::string text =
      fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", fmt::join(parts, ", "), finding.at.x, finding.at.y, finding.at.z);
  if (!finding.sourceLocation.empty()) text += fmt::format(", {}", finding.sourceLocation);
  return text;
}

}  // namespace malus::prep

#include "render/backend.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "render/scene/methods.h"

namespace malus::render {

Backend backendNamed(std::string_view name) {
  for (const BackendInfo& b : kBackends)
    if (b.name == name) return b.backend;
  throw Error("--backend", fmt::format("unknown renderer '{}'{}", name, nearestClause(name, backendNames())),
              fmt::format("{}", fmt::join(backendNames(), ", ")));
}

std::vector<std::string> backendNames() {
  std::vector<std::string> names;
  names.reserve(std::size(kBackends));
  for (const BackendInfo& b : kBackends) names.emplace_back(b.name);
  return names;
}

std::vector<std::string> methodBackendNames() {
  std::vector<std::string> names;
  for (const BackendInfo& b : kBackends)
    if (b.hasMethods) names.emplace_back(b.name);
  return names;
}

std::string methodName(Backend backend, std::string_view method) {
  return std::string(backendInfo(backend).hasMethods ? method : backendInfo(backend).name);
}

bool hasStokes(Backend backend, std::string_view method, const RenderParameters& parameters) {
  return !backendInfo(backend).hasMethods || hasStokes(methodNamed(method), parameters);
}

}  // namespace malus::render

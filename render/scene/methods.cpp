#include "render/scene/methods.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "shaders/methods/methods.h"

namespace malus::render {

const std::vector<MethodInfo>& methods() {
#define MALUS_ROW(M) {f32::M::kName, sizeof(f32::M::Payload), f32::M::kHasStokes != 0, false, 0},
#define MALUS_LOOP_ROW(M) \
  {f32::M::kName, 0, f32::M::kHasStokes != 0, true, 7 * sizeof(float) + sizeof(f32::M::Throughput)},
  static const std::vector<MethodInfo> kMethods = {MALUS_FOR_EACH_METHOD(MALUS_ROW)
                                                       MALUS_FOR_EACH_ITERATIVE(MALUS_LOOP_ROW)};
#undef MALUS_LOOP_ROW
#undef MALUS_ROW
  return kMethods;
}

bool hasStokes(const MethodInfo& method, const RenderParameters& parameters) {
  return method.hasStokes && (!method.isIterative || parameters.stokes);
}

const MethodInfo& methodNamed(std::string_view name) {
  for (const MethodInfo& m : methods())
    if (m.name == name) return m;
  throw Error("--method", fmt::format("unknown method '{}'", name), fmt::format("{}", fmt::join(methodNames(), ", ")));
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.push_back(m.name);
  return names;
}

}  // namespace malus::render

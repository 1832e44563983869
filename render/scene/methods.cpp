#include "render/scene/methods.h"

#include <algorithm>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"
#include "shaders/methods/methods.h"

namespace malus::render {

namespace {

// Method structs by the formulation and file of a row.
#define MALUS_STRUCT_recursive(file) f32::Method_##file
#define MALUS_STRUCT_iterative(file) f32::Iterative_##file

// Sizes and channels, which follow from the method's own declarations.
template <class M>
MethodInfo infoFrom(CarriedPolarization polarization, Accuracy accuracy, const char* withoutLinear,
                    const char* withoutCircular, const char* alias) {
  const auto orItself = [](const char* name) { return *name == 0 ? M::kName : name; };
  MethodInfo info{M::kName,
                  0,
                  M::kHasStokes != 0,
                  false,
                  0,
                  polarization,
                  accuracy,
                  orItself(withoutLinear),
                  orItself(withoutCircular),
                  alias};
  if constexpr (requires { typename M::Payload; }) {
    static_assert(sizeof(typename M::Payload) == M::kPayloadBytes);
    info.payloadBytes = sizeof(typename M::Payload);
  } else {
    info.isIterative = true;
    info.pathBytes = 7 * sizeof(float) + sizeof(typename M::Throughput);
  }
  return info;
}

}  // namespace

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> kMethods = {
#define MALUS_METHOD_ROW(name, file, formulation, polarization, accuracy, withoutLinear, withoutCircular, alias)   \
  infoFrom<MALUS_STRUCT_##formulation(file)>(CarriedPolarization::polarization, Accuracy::accuracy, withoutLinear, \
                                             withoutCircular, alias),
#include "shaders/methods.def"
  };
  return kMethods;
}

bool hasStokes(const MethodInfo& method, const RenderParameters& parameters) {
  return method.hasStokes && (!method.isIterative || parameters.stokes);
}

std::size_t payloadBytes(const MethodInfo& method, VulkanPath path) {
  return method.isIterative && path == VulkanPath::pipeline ? kHitRecordBytes : method.payloadBytes;
}

const MethodInfo& methodNamed(std::string_view name) {
  for (const MethodInfo& m : methods())
    if (m.name == name || (!m.alias.empty() && m.alias == name)) return m;
  throw Error("--method", fmt::format("unknown method '{}'{}", name, nearestClause(name, methodNames())),
              fmt::format("{}", fmt::join(methodNames(), ", ")));
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods()) names.push_back(m.name);
  return names;
}

std::vector<std::string> methodAliases() {
  std::vector<std::string> aliases;
  for (const MethodInfo& m : methods())
    if (!m.alias.empty()) aliases.push_back(m.alias);
  return aliases;
}

const MethodInfo& baselineMethod() { return methods().front(); }

const MethodInfo& completeRecursiveMethod() {
  return *std::find_if(methods().begin(), methods().end(),
                       [](const MethodInfo& m) { return m.isComplete() && !m.isIterative; });
}
const MethodInfo& completeIterativeMethod() {
  return *std::find_if(methods().begin(), methods().end(),
                       [](const MethodInfo& m) { return m.isComplete() && m.isIterative; });
}

}  // namespace malus::render

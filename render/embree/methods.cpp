#include "render/embree/methods.h"

namespace malus::embree {

#define MALUS_METHOD_ROW(name, file, ...)                 \
  extern const Method kMethod_##file##_plain;             \
  extern const Method kMethod_##file##_lit;               \
  extern const Method kMethod_##file##_every;             \
  extern const PacketMethod kPacketMethod_##file##_plain; \
  extern const PacketMethod kPacketMethod_##file##_lit;   \
  extern const PacketMethod kPacketMethod_##file##_every;
#include "shaders/methods.def"

const std::vector<const Method*>& allMethods() {
  static const std::vector<const Method*> kMethods = {
#define MALUS_METHOD_ROW(name, file, ...) &kMethod_##file##_plain, &kMethod_##file##_lit, &kMethod_##file##_every,
#include "shaders/methods.def"
  };
  return kMethods;
}

const std::vector<const PacketMethod*>& allPacketMethods() {
  static const std::vector<const PacketMethod*> kMethods = {
#define MALUS_METHOD_ROW(name, file, ...) \
  &kPacketMethod_##file##_plain, &kPacketMethod_##file##_lit, &kPacketMethod_##file##_every,
#include "shaders/methods.def"
  };
  return kMethods;
}

}  // namespace malus::embree

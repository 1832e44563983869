// The hooks that the steps call, and the steps. No include guard.
MaterialExtra extra;  // of every material
const MaterialExtra& materialExtra(word) const { return extra; }
MeshMaps maps{};  // none
const MeshMaps& meshMaps(word) const { return maps; }
// clang-format off
#include "shaders/surfaces/steps.h"

// The only hook that the steps call, and the steps. No include guard.
MaterialExtra extra;  // of every material
const MaterialExtra& materialExtra(word) const { return extra; }
// clang-format off
#include "shaders/surfaces/steps.h"

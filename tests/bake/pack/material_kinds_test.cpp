// Traits of the kinds of material: relations that every row of material_kinds.def must satisfy, and those of the kinds
// that physics fixes.
#include "bake/pack/material_kinds.h"

#include <gtest/gtest.h>

#include <set>

namespace malus::pack {
namespace {

TEST(MaterialKinds, NamesAreUniqueAndFindTheirKind) {
  std::set<std::string_view> names;
  for (const MaterialKindInfo& info : kMaterialKinds) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(findMaterialKind(info.name), info.kind);
    EXPECT_EQ(materialKindName(info.kind), info.name);
    EXPECT_FALSE(info.summary.empty()) << info.name;
  }
  EXPECT_FALSE(findMaterialKind("velvet").has_value());
}

TEST(MaterialKinds, TraitsAreConsistent) {
  for (const MaterialKindInfo& info : kMaterialKinds) {
    SCOPED_TRACE(info.name);
    const MaterialKind kind = info.kind;
    EXPECT_FALSE(isDielectric(kind) && isConductor(kind));
    // A surface either interacts specularly, or emits, or is bare diffuse.
    EXPECT_EQ(isInterface(kind), !isEmitter(kind) && kind != MaterialKind::lambert);
    EXPECT_EQ(isInterface(kind), hasIndex(kind) || isPolarizingElement(kind));
    EXPECT_FALSE(hasIndex(kind) && isPolarizingElement(kind));
    if (hasInside(kind)) {
      EXPECT_TRUE(isClear(kind));
    }
    if (canBeRough(kind) || canHaveIndexMap(kind)) {
      EXPECT_TRUE(isOpaqueInterface(kind));
    }
    if (canBeCoated(kind)) {
      EXPECT_TRUE(hasIndex(kind));
    }
  }
}

TEST(MaterialKinds, ConductorsAndClearGlass) {
  EXPECT_TRUE(isConductor(MaterialKind::metal));
  EXPECT_TRUE(isOpaqueInterface(MaterialKind::metal));
  EXPECT_TRUE(hasInside(MaterialKind::glass));
  EXPECT_FALSE(canBeDiffuse(MaterialKind::glass));
  EXPECT_FALSE(transmits(MaterialKind::mirrorGlass));
  EXPECT_TRUE(transmits(MaterialKind::polarizer) && transmits(MaterialKind::wavePlate));
}

}  // namespace
}  // namespace malus::pack

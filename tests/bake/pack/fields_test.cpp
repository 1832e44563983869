// Descriptions of records: reading, writing, bounds, and fields that a later version of a section appends.
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include "bake/pack/field_io.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/record_fields.h"
#include "tests/bake/fixtures.h"

namespace malus::pack {
namespace {

using bake::test::contains;
using bake::test::errorMessage;

// A record whose section had one field in version 1 and two in version 2.
struct Pane {
  double thickness = 0;
  glm::dvec3 tint{1.0};
};
constexpr const char* kPane = "PANE";

template <class Visitor, class... Panes>
void visitPane(Visitor&& visit, Panes&... p) {
  visit(Field{.name = "thickness", .high = 1, .section = kPane}, p.thickness...);
  visit(Field{.name = "tint", .high = 1, .section = kPane, .since = 2}, p.tint...);
}

std::vector<std::byte> writtenBytes(const Pane& pane, std::uint32_t version) {
  ByteWriter w;
  visitPane(FieldWriter(w, {kPane, version}), pane);
  return w.take();
}

Pane read(const std::vector<std::byte>& bytes, std::uint32_t version) {
  ByteReader r(bytes, 0, "file.pack, section PANE");
  Pane pane;
  visitPane(FieldReader(r, {kPane, version}), pane);
  r.end();
  return pane;
}

TEST(Fields, LaterVersionsAppendFields) {
  const Pane pane{0.5, {0.25, 0.5, 0.75}};
  EXPECT_EQ(writtenBytes(pane, 1).size(), 8u);
  EXPECT_EQ(writtenBytes(pane, 2).size(), 32u);
  EXPECT_EQ(read(writtenBytes(pane, 2), 2).tint, pane.tint);
  const Pane old = read(writtenBytes(pane, 1), 1);  // a pack written before the field existed
  EXPECT_EQ(old.thickness, 0.5);
  EXPECT_EQ(old.tint, glm::dvec3(1.0));
  for (const std::uint32_t version : {1u, 2u}) {
    FieldSizes sizes({kPane, version});
    visitPane(sizes, pane);
    EXPECT_EQ(sizes.bytes(), writtenBytes(pane, version).size());
  }
}

TEST(Fields, ErrorsNameSectionFieldRangeAndValue) {
  const std::string error = errorMessage([] { read(writtenBytes({0.5, {0, 2.5, 0}}, 2), 2); });
  for (const char* part : {"section PANE", "tint[1]", "0 to 1", "2.5"}) EXPECT_TRUE(contains(error, part)) << error;
}

TEST(Fields, MaterialsHaveUniqueNamesAndTheBytesOfTheDocument) {
  std::set<std::string_view> names;
  const Material any;
  visitMaterial([&](const Field& field, const auto&) { EXPECT_TRUE(names.insert(field.name).second) << field.name; },
                any);
  FieldSizes materials({kMaterials}), surfaces({kSurfaces});
  visitMaterial(materials, any);
  visitMaterial(surfaces, any);
  EXPECT_EQ(materials.bytes(), 124u);
  EXPECT_EQ(surfaces.bytes(), 276u);
  EXPECT_EQ(newestSurfaceVersion(), 4u);  // layers
}

// Each field stored in SRFX requires SRFX by itself; no other field does.
TEST(Fields, PlainMaterials) {
  EXPECT_TRUE(Material().isPlain());
  Material m;
  m.transmittanceCrossed = glm::dvec3(0.5);
  m.coating.eta = glm::dvec3(1.4);
  EXPECT_TRUE(m.isPlain());
  m.coating.thicknessNm = 100;
  EXPECT_FALSE(m.isPlain());
  m = {};
  m.maps.k = 0;
  EXPECT_FALSE(m.isPlain());
  m = {};
  m.kind = MaterialKind::wavePlate;
  EXPECT_FALSE(m.isPlain());
  EXPECT_EQ(surfaceVersion(std::vector<Material>{Material(), m}), 1u);
  EXPECT_EQ(surfaceVersion(std::vector<Material>{Material()}), 0u);
}

}  // namespace
}  // namespace malus::pack

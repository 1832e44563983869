#include "bake/pack/mesh_maps.h"

#include <algorithm>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/texel_range.h"

namespace malus::pack {

namespace {

void checkMap(const ByteReader& r, const Material& m, const MapRule& rule, const MeshMap& map,
              const std::vector<TexelRange>& ranges) {
  if (!map.isUsed()) return;
  const std::string what = fmt::format("map '{}' of material '{}'", rule.name, m.name);
  if (!contains(rule.kinds, m.kind)) r.fail(what, "a type of material that can have it", materialKindName(m.kind));
  const double low = rule.name == "eta" && !isConductor(m.kind) ? kMinEta : rule.low;
  const TexelRange& range = ranges[static_cast<std::size_t>(map.texture)];
  if (range.low < static_cast<float>(low) || range.high > static_cast<float>(rule.high))
    r.fail(what, fmt::format("texels from {:g} to {:g}", low, rule.high),
           fmt::format("{:g} to {:g}", range.low, range.high));
}

}  // namespace

bool hasMeshMaps(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.meshMaps.any(); });
}

void writeMeshMaps(ByteWriter& w, const std::vector<Material>& materials) {
  w.u32(static_cast<std::uint32_t>(materials.size()));
  for (const Material& m : materials) {
    visitMeshMaps([&](const MapRule&, const MeshMap& map) { visitMeshMap(FieldWriter(w), map); }, m.meshMaps);
    visitMeshMapFactors(FieldWriter(w), m.meshMaps);
  }
}

void readMeshMaps(ByteReader r, const std::vector<Texture>& textures, std::vector<Material>& materials) {
  FieldSizes sizes;
  const MeshMaps any{};
  visitMeshMaps([&](const MapRule&, const MeshMap& map) { visitMeshMap(sizes, map); }, any);
  visitMeshMapFactors(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMaterials, "number of materials with maps");
  if (count != materials.size())
    r.fail("number of materials with maps", fmt::format("{}, the number of materials", materials.size()),
           fmt::format("{}", count));
  const std::vector<TexelRange> ranges = findTexelRanges(textures);
  FieldReader read(r);
  for (Material& m : materials) {
    read.ofMaterial(m.kind, static_cast<std::uint32_t>(textures.size()));
    visitMeshMaps(
        [&](const MapRule& rule, MeshMap& map) {
          visitMeshMap(read, map);
          checkMap(r, m, rule, map, ranges);
        },
        m.meshMaps);
    visitMeshMapFactors(read, m.meshMaps);
    if (isConductor(m.kind) && m.meshMaps.eta.isUsed() != m.meshMaps.k.isUsed())
      r.fail(fmt::format("maps of the metal '{}'", m.name), "both of eta and k or neither", "one of them");
  }
  r.end();
}

}  // namespace malus::pack

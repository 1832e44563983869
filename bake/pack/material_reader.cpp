#include "bake/pack/material_reader.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/texel_range.h"

namespace malus::pack {

namespace {

// An index of refraction within which the optics keep their signs.
void checkIndex(const ByteReader& r, const Material& m) {
  for (int c = 0; c < 3; ++c) {
    if (m.eta[c] < kMinEta && m.k[c] < kMinEta)
      r.fail(fmt::format("eta and k of material '{}' are too small", m.name),
             fmt::format("one of them {:g} or more", kMinEta), fmt::format("eta {:g}, k {:g}", m.eta[c], m.k[c]));
    if (isDielectric(m.kind) && (m.eta[c] < kMinEta || m.k[c] != 0))
      r.fail(fmt::format("index of the dielectric '{}'", m.name), fmt::format("eta {:g} or more and k = 0", kMinEta),
             fmt::format("eta {:g}, k {:g}", m.eta[c], m.k[c]));
  }
}

void checkMaps(const ByteReader& r, const Material& m, const std::vector<TexelRange>& ranges) {
  const auto check = [&](std::string_view name, std::int32_t index, double low, double high) {
    if (index < 0) return;
    const TexelRange& range = ranges[static_cast<std::size_t>(index)];
    if (range.low < static_cast<float>(low) || range.high > static_cast<float>(high))
      r.fail(fmt::format("maps.{} of material '{}' names texture {}", name, m.name, index),
             fmt::format("values from {:g} to {:g}", low, high), fmt::format("{:g} to {:g}", range.low, range.high));
  };
  check("albedo", m.maps.albedo, 0, 1);
  check("eta", m.maps.eta, isConductor(m.kind) ? 0 : kMinEta, kMaxEta);
  check("k", m.maps.k, kMinEta, kMaxEta);
  if ((m.maps.eta >= 0 && !canHaveIndexMap(m.kind)) || (m.maps.k >= 0) != (m.maps.eta >= 0 && isConductor(m.kind)))
    r.fail(fmt::format("index map of material '{}'", m.name),
           "maps.eta of an opaque interface only, together with maps.k of a metal only",
           fmt::format("maps.eta {}, maps.k {} of type {}", m.maps.eta, m.maps.k, materialKindName(m.kind)));
}

}  // namespace

void readMaterials(ByteReader r, std::vector<Material>& materials) {
  const FieldFilter filter{kMaterials};
  FieldSizes sizes(filter);
  const Material any{};
  visitMaterial(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMaterials, "number of materials");
  FieldReader read(r, filter);
  for (std::uint32_t i = 0; i < count; ++i) {
    Material& m = materials.emplace_back();
    visitMaterial(read, m);
    checkIndex(r, m);
  }
  r.end();
}

void readSurfaces(ByteReader r, std::uint32_t version, const std::vector<Texture>& textures,
                  std::vector<Material>& materials) {
  const FieldFilter filter{kSurfaces, version};
  FieldSizes sizes(filter);
  const Material any{};
  visitMaterial(sizes, any);
  const std::uint32_t count = r.count(sizes.bytes(), kMaxMaterials, "number of surfaces");
  if (count != materials.size())
    r.fail("number of surfaces", fmt::format("{}, the number of materials", materials.size()),
           fmt::format("{}", count));
  const std::vector<TexelRange> ranges = findTexelRanges(textures);
  FieldReader read(r, filter);
  for (Material& m : materials) {
    read.ofMaterial(m.kind, static_cast<std::uint32_t>(textures.size()));
    visitMaterial(read, m);
    if (isPolarizingElement(m.kind) || m.polarization > 0) r.requireUnit(m.axis, "axis");
    if (m.clearCoat.factor > 0 && m.coating.thicknessNm > 0)
      r.fail(fmt::format("clearCoat of material '{}'", m.name), "a clear coat or a coating", "both");
    checkMaps(r, m, ranges);
  }
  r.end();
}

}  // namespace malus::pack

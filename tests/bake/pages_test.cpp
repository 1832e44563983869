// The tables of bake/FORMAT.md and bake/SCENE.md equal the descriptions in the code: every field and its range is in
// the page, and every row of the page is a field. MALUS_UPDATE_PAGES=1 rewrites the tables and fails, so that no test
// run passes while updating.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "bake/pack/field_io.h"
#include "bake/pack/material_fields.h"
#include "bake/pack/mesh_maps.h"
#include "bake/pack/record_fields.h"
#include "bake/scene_file/scene_keys.h"
#include "bake/scene_file/special_keys.h"
#include "meshprep/base/atomic_file.h"
#include "render/sensor/sensor_keys.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using pack::Field;

const std::filesystem::path kSource = MALUS_SOURCE_DIR;

// Returns the kinds of a set, such as "`metal`, `paint`".
std::string kindNames(pack::KindSet kinds) {
  std::vector<std::string> names;
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds)
    if (pack::contains(kinds, info.kind)) names.push_back(fmt::format("`{}`", info.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string boundsText(double low, double high, std::string_view unit, bool excludesLow = false) {
  std::string text = low == 0 && high == 0 ? ""
                     : excludesLow         ? fmt::format("over {:.9g}, up to {:.9g}", low, high)
                     : low == -high        ? fmt::format("+-{:.9g}", high)
                                           : fmt::format("{:.9g} to {:.9g}", low, high);
  if (!unit.empty()) text += fmt::format("{}{}", text.empty() ? "" : " ", unit);
  return text;
}

// Rows of a table of bake/FORMAT.md.
struct FormatTable {
  pack::FieldFilter filter = {};
  std::string text = "| type | field | bounds | contents |\n|---|---|---|---|\n";

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (!filter.takes(field)) return;
    std::string bounds = boundsText(field.low, field.high, field.unit);
    if (field.isTexture) bounds = "0 to the count of `TEXR`";
    if (field.isZeroForOthers) bounds += fmt::format("; 0 unless {}", kindNames(field.kinds));
    text += fmt::format("| {} | `{}` | {} | {}{} |\n", pack::fieldType(value).name, field.name, bounds, field.text,
                        field.since > 1 ? fmt::format(" (from version {})", field.since) : "");
  }
};

template <class Record, class Describe>
std::string formatTable(Describe describe, pack::FieldFilter filter = {}) {
  FormatTable table{filter};
  const Record any{};
  describe(table, any);
  return table.text;
}

#define MALUS_DESCRIBED(visit) [](auto& visitor, const auto& record) { pack::visit(visitor, record); }

std::map<std::string, std::string> formatTables() {
  std::string sections = "| id | required | optional flag | contents |\n|---|---|---|---|\n";
  for (const pack::SectionInfo& s : pack::kKnownSections)
    sections += fmt::format("| `{}` | {} | {} | {} |\n", s.id, s.isRequired ? "yes" : "no",
                            (s.flags & pack::kOptional) != 0 ? "set" : "", s.contents);
  std::string kinds = "| value | name | contents |\n|---|---|---|\n";
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds)
    kinds += fmt::format("| {} | `{}` | {} |\n", static_cast<std::uint32_t>(info.kind), info.name, info.summary);
  return {{"sections", sections},
          {"kinds", kinds},
          {"META", formatTable<pack::Scene>(MALUS_DESCRIBED(visitMeta))},
          {"CAMR", formatTable<pack::Camera>(MALUS_DESCRIBED(visitCamera), {nullptr, pack::kNewestCamera})},
          {"ENVR", formatTable<pack::Environment>(MALUS_DESCRIBED(visitEnvironment))},
          {"LGHT", formatTable<pack::LightSource>(MALUS_DESCRIBED(visitLight), {nullptr, pack::kNewestLights})},
          {"MATL", formatTable<pack::Material>(MALUS_DESCRIBED(visitMaterial), {pack::kMaterials})},
          {"SRFX", formatTable<pack::Material>(MALUS_DESCRIBED(visitMaterial),
                                               {pack::kSurfaces, pack::newestSurfaceVersion()})},
          {"TEXR", formatTable<pack::Texture>(MALUS_DESCRIBED(visitTexture))},
          {"MAPS", formatTable<pack::MeshMap>(MALUS_DESCRIBED(visitMeshMap))},
          {"MAPS factors", formatTable<pack::MeshMaps>(MALUS_DESCRIBED(visitMeshMapFactors))},
          {"WAVE", formatTable<pack::Scene>(MALUS_DESCRIBED(visitWavelengths))},
          {"SKYP", formatTable<pack::Environment>(MALUS_DESCRIBED(visitSky))},
          {"MESH", formatTable<pack::MeshEntry>(MALUS_DESCRIBED(visitMeshEntry), {pack::kMeshes, pack::kNewestMeshes})},
          {"INST", formatTable<pack::Instance>(MALUS_DESCRIBED(visitInstance))},
          {"TCRD", formatTable<pack::TextureEntry>(MALUS_DESCRIBED(visitTextureEntry))},
          {"ENCD grid", formatTable<pack::SharedGrid>(MALUS_DESCRIBED(visitSharedGrid))},
          {"ENCD", formatTable<pack::MeshEncoding>(MALUS_DESCRIBED(visitMeshEncoding),
                                                   {pack::kEncodings, pack::kNewestEncodings})},
          {"EFCT", formatTable<pack::Effect>(MALUS_DESCRIBED(visitEffect))}};
}

// Rows of a table of bake/SCENE.md.
struct SceneTable {
  bool hasKinds = false;
  std::string text = {};

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (field.key == pack::Key::none) return;
    const std::string shape = shapeText(field, value),
                      bounds = boundsText(field.lowInScene(), field.highInScene(), field.unit, field.excludesLow);
    text += fmt::format("| `{}` | {}{}{}{} | {} | {}{} |\n", field.name,
                        !hasKinds                         ? ""
                        : field.kinds == pack::kEveryKind ? "all | "
                                                          : kindNames(field.kinds) + " | ",
                        shape, field.shape == pack::Shape::direction || bounds.empty() ? "" : ", ",
                        field.shape == pack::Shape::direction ? "" : bounds,
                        field.key == pack::Key::required ? "required"
                        : field.fallback                 ? fmt::format("{:g}", *field.fallback)
                                                         : defaultText(field, value),
                        field.text, field.alias.empty() ? "" : fmt::format(" (deprecated name: `{}`)", field.alias));
  }

 private:
  static std::string shapeText(const Field& field, const glm::dvec3&) {
    return field.shape == pack::Shape::direction        ? "[x, y, z]"
           : field.shape == pack::Shape::numberOrVector ? "number or three numbers"
                                                        : "three numbers";
  }
  static std::string shapeText(const Field&, bool) { return "true or false"; }
  static std::string shapeText(const Field&, const std::string&) { return "text"; }
  static std::string shapeText(const Field&, double) { return "number"; }
  template <class T>
  static std::string shapeText(const Field& field, const std::optional<T>&) {
    return shapeText(field, T());
  }
  template <class T>
  static std::string shapeText(const Field&, const T&) {
    return "integer";
  }
  static std::string defaultText(const Field& field, const glm::dvec3& v) {
    if (field.shape == pack::Shape::numberOrVector) return fmt::format("{:g}", v.x);
    return fmt::format("[{:g}, {:g}, {:g}]", v.x, v.y, v.z);
  }
  static std::string defaultText(const Field&, const std::string& text) { return fmt::format("`\"{}\"`", text); }
  static std::string defaultText(const Field&, pack::MaterialKind) { return ""; }
  template <class T>
  static std::string defaultText(const Field&, const std::optional<T>&) {
    return "none";
  }
  template <class T>
  static std::string defaultText(const Field&, const T& value) {
    return fmt::format("{}", value);
  }
};

std::string specialRows(std::span<const SpecialKey> keys, bool hasKinds) {
  std::string text;
  for (const SpecialKey& key : keys)
    text += fmt::format("| `{}` | {}{} | {} | {} |\n", key.name,
                        !hasKinds                       ? ""
                        : key.kinds == pack::kEveryKind ? "all | "
                                                        : kindNames(key.kinds) + " | ",
                        key.value, key.fallback, key.text);
  return text;
}

// special: rows before those of the record.
std::string sceneTable(std::span<const SpecialKey> special, std::string_view rows = {}, bool hasKinds = false) {
  return (hasKinds ? "| key | of | value | default | meaning |\n|---|---|---|---|---|\n"
                   : "| key | value | default | meaning |\n|---|---|---|---|\n") +
         specialRows(special, hasKinds) + std::string(rows);
}

template <class Record, class Describe>
std::string sceneTable(Describe describe, std::span<const SpecialKey> special = {}, bool hasKinds = false) {
  SceneTable table{hasKinds};
  const Record any{};
  describe(table, any);
  return sceneTable(special, table.text, hasKinds);
}

#define MALUS_KEYS(visit) [](auto& visitor, const auto& record) { visit(visitor, record); }

std::map<std::string, std::string> sceneTables() {
  std::string kinds = "| `type` | meaning |\n|---|---|\n";
  for (const pack::MaterialKindInfo& info : pack::kMaterialKinds)
    kinds += fmt::format("| `{}` | {} |\n", info.name, info.summary);
  return {{"kinds", kinds},
          {"scene", sceneTable<SceneDescription>(MALUS_KEYS(visitSceneKeys), kSceneSpecialKeys)},
          {"camera", sceneTable<SceneDescription>(MALUS_KEYS(visitCameraKeys), kCameraSpecialKeys)},
          {"field of view", sceneTable<SceneDescription>(MALUS_KEYS(visitFovKeys))},
          {"orthographic", sceneTable<SceneDescription>(MALUS_KEYS(visitOrthographicKeys))},
          {"intrinsics", sceneTable<Intrinsics>(MALUS_KEYS(visitIntrinsicsKeys))},
          {"constant", sceneTable<SceneDescription>(MALUS_KEYS(visitConstantKeys))},
          {"image", sceneTable<SceneDescription>(MALUS_KEYS(visitImageKeys), kImageSpecialKeys)},
          {"preset", sceneTable(kPresetSpecialKeys)},
          {"environment", sceneTable<SceneDescription>(MALUS_KEYS(visitEnvironmentKeys))},
          {"light", sceneTable<pack::LightSource>(MALUS_KEYS(visitLightKeys), kLightSpecialKeys)},
          {"direction", sceneTable<pack::LightSource>(MALUS_KEYS(visitDirectionKeys))},
          {"spot", sceneTable<pack::LightSource>(MALUS_KEYS(visitSpotKeys))},
          {"directional", sceneTable<pack::LightSource>(MALUS_KEYS(visitDirectionalKeys))},
          {"material", sceneTable<pack::Material>(MALUS_KEYS(pack::visitMaterial), kMaterialSpecialKeys, true)},
          {"map", sceneTable<TextureDescription>(MALUS_KEYS(visitMapKeys), kMapSpecialKeys)},
          {"projection", sceneTable<pack::Maps>(MALUS_KEYS(visitProjectionKeys))},
          {"mesh", sceneTable<MeshDescription>(MALUS_KEYS(visitMeshKeys), kMeshSpecialKeys)},
          {"cleaning", sceneTable<prep::Options>(MALUS_KEYS(visitCleaningKeys), kCleaningSpecialKeys)},
          {"import", sceneTable(kImportSpecialKeys)},
          {"transform", sceneTable<Transform>(MALUS_KEYS(visitTransformKeys))}};
}

// Returns the page with its tables replaced between the comments "<!-- fields: NAME -->" and "<!-- end -->".
std::string withTables(const std::string& page, const std::map<std::string, std::string>& tables) {
  constexpr std::string_view kStart = "<!-- fields: ", kEnd = "<!-- end -->";
  std::string result;
  std::map<std::string, int> used;
  std::size_t at = 0;
  for (std::size_t start = page.find(kStart); start != std::string::npos; start = page.find(kStart, at)) {
    const std::size_t close = page.find(" -->\n", start), end = page.find(kEnd, start);
    if (close == std::string::npos || end == std::string::npos) throw Error("page", "a table has no end");
    const std::string name = page.substr(start + kStart.size(), close - start - kStart.size());
    if (!tables.contains(name)) throw Error("page", fmt::format("unknown table '{}'", name));
    ++used[name];
    result += page.substr(at, close + 5 - at) + tables.at(name);
    at = end;
  }
  for (const auto& [name, ignored] : tables) EXPECT_EQ(used[name], 1) << "table '" << name << "' of the page";
  return result + page.substr(at);
}

void checkPage(const std::filesystem::path& path, const std::map<std::string, std::string>& tables) {
  const std::string page = readTextFile(path, std::size_t{1} << 24), expected = withTables(page, tables);
  if (page == expected) return;
  const char* update = std::getenv("MALUS_UPDATE_PAGES");
  if (update != nullptr && std::string_view(update) == "1") {
    std::ofstream stream(path, std::ios::binary);
    ASSERT_TRUE((stream << expected).flush()) << path;
    FAIL() << "wrote the tables of " << path << "; run again without MALUS_UPDATE_PAGES";
  }
  std::size_t first = 0;
  while (first < page.size() && first < expected.size() && page[first] == expected[first]) ++first;
  FAIL() << path << " differs from the description at \"" << page.substr(first, 80) << "\"; expected \""
         << expected.substr(first, 80) << "\". MALUS_UPDATE_PAGES=1 writes the tables";
}

TEST(Pages, Scene) { checkPage(kSource / "bake/SCENE.md", sceneTables()); }

TEST(Pages, Sensor) {
  checkPage(kSource / "render/sensor/SENSOR.md",
            {{"sensor", sceneTable<render::Sensor>(MALUS_KEYS(render::visitSensorKeys), render::kSensorSpecialKeys)}});
}

TEST(Pages, Format) { checkPage(kSource / "bake/FORMAT.md", formatTables()); }

}  // namespace
}  // namespace malus::bake

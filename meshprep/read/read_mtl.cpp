#include "meshprep/read/read_mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "meshprep/base/atomic_file.h"
#include "meshprep/base/error.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

constexpr double kDefaultColour = 0.8;
constexpr std::size_t kMaxMaterials = 100'000;

constexpr std::array<std::string_view, 3> kIgnored = {"Ka", "sharpness", "Km"};
constexpr std::array<std::string_view, 7> kTextures = {"bump", "disp", "decal", "refl", "norm", "Bump", "Disp"};

// Statements of one material.
struct Statements {
  std::string name;
  std::optional<glm::dvec3> kd, ks, ke, tf;
  std::optional<double> ns, ni, d, pm, pr;
  int illum = 2;
};

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }
glm::dvec3 clampToUnit(const glm::dvec3& v) { return glm::clamp(v, 0.0, 1.0); }

SourceMaterial convertMaterial(const Statements& from, std::vector<std::string>& notes) {
  SourceMaterial result;
  result.name = from.name;
  const glm::dvec3 kd = clampToUnit(from.kd.value_or(glm::dvec3(kDefaultColour))),
                   ks = clampToUnit(from.ks.value_or(glm::dvec3(0)));

  // Set metallic, base colour and roughness.
  const bool shines = largest(ks) > 0 && from.illum > 1;
  const bool metal = from.pm ? *from.pm >= 0.5 : largest(ks) > 0.5 && largest(kd) < 0.1;
  result.metallic = from.pm ? std::clamp(*from.pm, 0.0, 1.0) : metal ? 1 : 0;
  result.baseColour = metal && !from.pm ? ks : kd;
  if (from.pr) {
    result.roughness = std::clamp(*from.pr, 0.0, 1.0);
  } else if (shines || metal) {
    result.roughness = std::pow(2 / (std::max(from.ns.value_or(0), 0.0) + 2), 0.25);
  }

  // Set emission, index and transmission.
  if (from.ke) result.emissive = glm::max(*from.ke, 0.0);
  if (from.ni && *from.ni < 1) addNote(notes, "indices of refraction below 1, replaced by 1.5");
  if (from.ni && *from.ni >= 1) result.ior = *from.ni;
  const bool refracts = from.illum == 4 || from.illum == 6 || from.illum == 7 || from.illum == 9;
  if (from.d)
    result.transmission = 1 - std::clamp(*from.d, 0.0, 1.0);
  else if (refracts && from.tf)
    result.transmission = largest(clampToUnit(*from.tf));
  if (result.transmission > kTransmissive) result.metallic = 0;  // a metal is opaque
  if (from.tf) {
    result.hasVolume = true;
    result.attenuationColour = clampToUnit(*from.tf);
    result.attenuationDistance = 1;
  }
  return result;
}

// Parses one statement of a material.
void parseStatement(std::string_view keyword, std::string_view rest, const Lines& at, Statements& material,
                    std::vector<std::string>& notes) {
  const auto note = [&](std::string text) { addNote(notes, std::move(text)); };
  const auto number = [&] { return coordinate(takeWord(rest), at); };
  const auto colour = [&](std::optional<glm::dvec3>& value) {
    std::string_view ahead = rest;
    const std::string_view first = takeWord(ahead);
    if (first == "spectral" || first == "xyz") {
      note(fmt::format("colours given by {}", first));
      return;
    }
    const double r = number();
    ahead = rest;
    if (takeWord(ahead).empty()) {
      value = glm::dvec3(r);
      return;
    }
    const double g = number(), b = number();
    value = {r, g, b};
  };

  if (keyword == "Kd")
    colour(material.kd);
  else if (keyword == "Ks")
    colour(material.ks);
  else if (keyword == "Ke")
    colour(material.ke);
  else if (keyword == "Tf")
    colour(material.tf);
  else if (keyword == "Ns")
    material.ns = number();
  else if (keyword == "Ni")
    material.ni = number();
  else if (keyword == "Pm")
    material.pm = number();
  else if (keyword == "Pr")
    material.pr = number();
  else if (keyword == "Tr")
    material.d = 1 - number();
  else if (keyword == "d") {
    std::string_view ahead = rest;
    if (takeWord(ahead) == "-halo") rest = ahead;
    material.d = number();
  } else if (keyword == "illum") {
    const long long model = wholeNumber(takeWord(rest), "an integer from 0 to 10", at);
    if (model < 0 || model > 10)
      at.fail("unknown illumination model", "an integer from 0 to 10", fmt::to_string(model));
    material.illum = static_cast<int>(model);
  } else if (keyword.starts_with("map_") || std::find(kTextures.begin(), kTextures.end(), keyword) != kTextures.end()) {
    note("textures");
  } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
    note(fmt::format("statements {} of material files", quoted(keyword)));
  }
}

}  // namespace

std::vector<SourceMaterial> parseMtl(std::string text, std::string_view where, std::vector<std::string>& notes) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw Error(where, "file is UTF-16 text", "ASCII or UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<Statements> statements;
  Lines lines(text, where);
  while (lines.nextStatement('#')) {
    std::string_view rest = lines.line();
    const std::string_view keyword = takeWord(rest);
    if (keyword == "newmtl") {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      if (rest.empty()) lines.fail("material without a name", "newmtl NAME");
      if (statements.size() == kMaxMaterials)
        lines.fail("too many materials", fmt::format("at most {}", kMaxMaterials));
      statements.emplace_back();
      statements.back().name = parseName(rest, lines);
      continue;
    }
    if (statements.empty()) lines.fail("statement outside of a material", "newmtl NAME first", quoted(keyword));
    parseStatement(keyword, rest, lines, statements.back(), notes);
  }
  std::vector<SourceMaterial> materials;
  materials.reserve(statements.size());
  for (const Statements& material : statements) materials.push_back(convertMaterial(material, notes));
  return materials;
}

std::vector<SourceMaterial> readMtl(const std::filesystem::path& path, std::vector<std::string>& notes) {
  return parseMtl(readTextFile(path), path.string(), notes);
}

std::vector<std::filesystem::path> listMaterialFiles(const std::filesystem::path& obj,
                                                     const std::vector<std::string>& statements) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](std::string_view name) {
    std::filesystem::path file = obj.parent_path() / std::filesystem::path(name);
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
  };
  for (const std::string& statement : statements) {
    std::error_code ignored;
    const bool whole = std::filesystem::is_regular_file(obj.parent_path() / std::filesystem::path(statement), ignored);
    std::string_view rest = statement;
    if (whole) add(statement);
    for (std::string_view word = takeWord(rest); !whole && !word.empty(); word = takeWord(rest)) add(word);
  }
  return files;
}

void describeMaterials(SourceScene& scene, const std::filesystem::path& obj, const std::vector<std::string>& files) {
  // Read the descriptions by name.
  std::map<std::string, SourceMaterial> described;
  std::vector<std::string> missing;
  for (const std::filesystem::path& path : listMaterialFiles(obj, files)) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
      missing.push_back(path.filename().string());
      continue;
    }
    for (SourceMaterial& material : readMtl(path, scene.notes)) {
      const std::string name = material.name;
      if (!described.emplace(name, std::move(material)).second)
        addNote(scene.notes, fmt::format("a duplicate material {}", prep::quoted(name)));
    }
  }

  // Set the materials. Report missing files only if a material is missing.
  for (SourceMaterial& material : scene.materials) {
    const auto found = described.find(material.name);
    if (found != described.end()) {
      material = found->second;
      continue;
    }
    for (const std::string& file : missing)
      addNote(scene.notes, fmt::format("missing material file {}", prep::quoted(file)));
    addNote(scene.notes, fmt::format("material {} without a description", prep::quoted(material.name)));
    material.baseColour = glm::dvec3(kDefaultColour);
    material.metallic = 0;
  }
}

std::vector<std::string> listMtllibs(std::string text, std::string_view where) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<std::string> statements;
  std::set<std::string> seen;
  Lines lines(text, where);
  while (lines.nextStatement('#')) {
    lines.joinContinued();
    std::string_view rest = lines.line();
    if (takeWord(rest) != "mtllib") continue;
    std::string name = parseName(rest, lines, kMaxPathBytes);
    if (!name.empty() && seen.insert(name).second) statements.push_back(std::move(name));
  }
  return statements;
}

}  // namespace malus::prep

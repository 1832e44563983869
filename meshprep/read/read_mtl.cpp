#include "meshprep/read/read_mtl.h"

#include <algorithm>
#include <array>
#include <charconv>
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
#include "meshprep/read/invalid_parts.h"
#include "meshprep/read/scan.h"

namespace malus::prep {

namespace {

constexpr double kDefaultColour = 0.8;
constexpr std::size_t kMaxMaterials = 100'000;
constexpr double kContradiction = 1e-3;  // of d + Tr from 1: files have few decimals

constexpr std::array<std::string_view, 3> kIgnored = {"Ka", "sharpness", "Km"};
constexpr std::array<std::string_view, 6> kTextures = {"bump", "disp", "decal", "refl", "Bump", "Disp"};

// Statements of one material.
struct Statements {
  std::string name;
  std::optional<glm::dvec3> kd, ks, ke, tf;
  std::optional<double> ns, ni, d, tr, pm, pr;
  int illum = 2;
  std::string colourMap;    // file of map_Kd; empty: none
  std::string coverageMap;  // of map_d
  std::string normalMap;    // of norm
};

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }
glm::dvec3 clampToUnit(const glm::dvec3& v) { return glm::clamp(v, 0.0, 1.0); }

// Returns the file name of a map statement, after its options: words with '-' and the words that are their values.
std::string_view mapFile(std::string_view rest) {
  constexpr std::array<std::string_view, 3> kVectors = {"-o", "-s", "-t"};  // one to three numbers
  const auto isNumber = [](std::string_view word) {
    double value = 0;
    return !word.empty() &&
           std::from_chars(word.data(), word.data() + word.size(), value).ptr == word.data() + word.size();
  };
  const auto skipBlanks = [&] { rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size())); };
  skipBlanks();
  while (rest.starts_with('-')) {
    const std::string_view option = takeWord(rest);
    std::size_t values = option == "-mm" ? 2 : 1;
    if (std::find(kVectors.begin(), kVectors.end(), option) != kVectors.end()) {
      std::string_view ahead = rest;
      for (values = 0; values < 3 && isNumber(takeWord(ahead)); ++values) {
      }
    }
    for (; values > 0; --values) takeWord(rest);
    skipBlanks();
  }
  const std::size_t last = rest.find_last_not_of(" \t");
  return rest.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

SourceMaterial convertMaterial(const Statements& from, std::vector<SourceImage>& images,
                               std::vector<std::string>& notes) {
  SourceMaterial result;
  result.name = from.name;
  const bool isLamp = from.ke && largest(*from.ke) > 0;
  const glm::dvec3 kd = clampToUnit(from.kd.value_or(glm::dvec3(isLamp ? 0 : kDefaultColour))),
                   ks = clampToUnit(from.ks.value_or(glm::dvec3(0)));

  // Set metallic, base colour and roughness.
  const bool shines = largest(ks) > 0 && from.illum > 1;
  const bool metal = from.pm ? *from.pm >= 0.5 : largest(ks) > 0.5 && largest(kd) < 0.1;
  result.metallic = from.pm ? std::clamp(*from.pm, 0.0, 1.0) : metal ? 1 : 0;
  result.baseColour = metal && !from.pm ? ks : kd;
  const auto addImage = [&](const std::string& file, std::optional<std::size_t>& image) {
    image = images.size();
    images.push_back({file, file, nullptr});
  };
  if (!from.colourMap.empty() && (!metal || from.pm)) addImage(from.colourMap, result.baseColourImage);
  if (!from.normalMap.empty()) addImage(from.normalMap, result.normalImage);
  if (!from.coverageMap.empty()) {
    addImage(from.coverageMap, result.coverageImage);
    result.alphaMode = AlphaMode::mask;
  }
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
  if (from.d && from.tr && std::abs(*from.d + *from.tr - 1) > kContradiction)
    addNote(notes,
            fmt::format("Tr {} of material {}, which contradicts d {}", *from.tr, prep::quoted(from.name), *from.d));
  if (!from.d && from.tr && *from.tr > kTransmissive)
    addNote(notes, fmt::format("{}Tr of material {} without d, read as 1 - d", kAcceptedNote, prep::quoted(from.name)));
  if (from.d || from.tr)
    result.transmission = from.d ? 1 - std::clamp(*from.d, 0.0, 1.0) : std::clamp(*from.tr, 0.0, 1.0);
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

// Reports a number out of range, which convertMaterial() clamps.
void requireRange(std::string_view keyword, double value, const Lines& at, InvalidParts& invalid) {
  constexpr std::array<std::string_view, 7> kShares = {"Kd", "Ks", "Tf", "Tr", "d", "Pm", "Pr"};
  const bool isShare = std::find(kShares.begin(), kShares.end(), keyword) != kShares.end();
  const bool isPositive = keyword == "Ke" || keyword == "Ns";
  if ((!isShare && !isPositive) || (value >= 0 && (isPositive || value <= 1))) return;
  try {
    at.fail(fmt::format("{} is out of range and is clamped", keyword), isShare ? "0 to 1" : "0 or more",
            fmt::to_string(value));
  } catch (const Error& error) {
    invalid.addReplaced("values of materials", error);
  }
}

// Parses one statement of a material.
void parseStatement(std::string_view keyword, std::string_view rest, const Lines& at, Statements& material,
                    std::vector<std::string>& notes, InvalidParts& invalid) {
  const auto note = [&](std::string text) { addNote(notes, std::move(text)); };
  const auto number = [&] {
    const double value = coordinate(takeWord(rest), at);
    requireRange(keyword, value, at, invalid);
    return value;
  };
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
    material.tr = number();
  else if (keyword == "d") {
    std::string_view ahead = rest;
    if (takeWord(ahead) == "-halo") rest = ahead;
    material.d = number();
  } else if (keyword == "illum") {
    const long long model = wholeNumber(takeWord(rest), "an integer from 0 to 10", at);
    if (model < 0 || model > 10)
      at.fail("unknown illumination model", "an integer from 0 to 10", fmt::to_string(model));
    material.illum = static_cast<int>(model);
  } else if (keyword == "map_Kd") {
    material.colourMap = mapFile(rest);
  } else if (keyword == "map_d") {
    material.coverageMap = mapFile(rest);
  } else if (keyword == "norm") {
    material.normalMap = mapFile(rest);
  } else if (keyword.starts_with("map_") || std::find(kTextures.begin(), kTextures.end(), keyword) != kTextures.end()) {
    note("textures");
  } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
    note(fmt::format("statements {} of material files", quoted(keyword)));
  }
}

}  // namespace

std::vector<SourceMaterial> parseMtl(std::string text, std::string_view where, std::vector<std::string>& notes,
                                     std::vector<SourceImage>& images, bool strict) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw Error(where, "file is UTF-16 text", "ASCII or UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  const bool padded = removePadding(text);
  std::vector<Statements> statements;
  InvalidParts invalid(strict);
  bool isNamed = false;  // the current material has a name
  Lines lines(text, where);
  while (lines.nextStatement('#')) {
    std::string_view rest = lines.line();
    std::string_view keyword = takeWord(rest);
    if (keyword == "newmtl") {
      lines.cutSeparateComment('#');
      rest = lines.line().substr(keyword.size());
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      isNamed = !rest.empty();
      if (!isNamed) {
        invalid.add("materials",
                    Error(fmt::format("{}:{}", where, lines.number()), "material without a name", "newmtl NAME"));
        continue;
      }
      if (statements.size() == kMaxMaterials)
        lines.fail("too many materials", fmt::format("at most {}", kMaxMaterials));
      statements.emplace_back();
      statements.back().name = parseName(rest, lines);
      continue;
    }
    lines.cutComment('#');  // which may begin within the keyword
    rest = lines.line();
    keyword = takeWord(rest);
    try {
      if (!isNamed) lines.fail("statement outside of a material", "newmtl NAME first", quoted(keyword));
      parseStatement(keyword, rest, lines, statements.back(), notes, invalid);
    } catch (const Error& error) {
      invalid.add("statements", error);
    }
  }
  invalid.addNotes(notes);
  std::vector<SourceMaterial> materials;
  materials.reserve(statements.size());
  for (const Statements& material : statements) materials.push_back(convertMaterial(material, images, notes));
  if (lines.hasCrLineEnds()) addNote(notes, std::string(kAcceptedNote) + "CR line ends");
  if (lines.hasCutComments()) addNote(notes, std::string(kAcceptedNote) + "comments at line ends");
  if (padded) addNote(notes, std::string(kPaddingNote));
  return materials;
}

namespace {

std::string withSlashes(std::string_view name) {
  std::string result(name);
  std::replace(result.begin(), result.end(), '\\', '/');
  return result;
}

// Returns the file that a name in another one, with backslashes, in quotes or with a comment refers to, if it exists. A
// file with exactly this name comes first.
std::optional<std::filesystem::path> findMaterialFile(const std::filesystem::path& from, std::string_view name) {
  std::vector<std::string> candidates = {std::string(name), withSlashes(name)};
  const auto addWithSlashes = [&](std::string_view part) {
    candidates.emplace_back(part);
    candidates.push_back(withSlashes(part));
  };
  const auto trim = [](std::string_view text) {
    const std::size_t last = text.find_last_not_of(" \t");
    return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
  };
  const std::string_view shown = trim(name.substr(0, name.find('#')));
  addWithSlashes(shown);
  if (shown.size() > 2 && shown.front() == '"' && shown.back() == '"')
    addWithSlashes(shown.substr(1, shown.size() - 2));
  for (const std::string& candidate : candidates) {
    std::error_code ignored;
    std::filesystem::path file = from.parent_path() / std::filesystem::path(candidate);
    if (!candidate.empty() && std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return std::nullopt;
}

// Returns a name up to its first '#', without blanks before it.
std::string withoutHash(std::string_view name) {
  name = name.substr(0, name.find('#'));
  const std::size_t last = name.find_last_not_of(" \t");
  return std::string(name.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

}  // namespace

std::vector<SourceMaterial> readMtl(const std::filesystem::path& path, std::vector<std::string>& notes,
                                    std::vector<SourceImage>& images, bool strict) {
  const std::size_t first = images.size();
  std::vector<SourceMaterial> materials = parseMtl(readTextFile(path), path.string(), notes, images, strict);
  for (std::size_t i = first; i < images.size(); ++i)
    images[i].file = findMaterialFile(path, images[i].name).value_or(path.parent_path() / withSlashes(images[i].name));
  return materials;
}

std::vector<std::filesystem::path> listMaterialFiles(const std::filesystem::path& obj,
                                                     const std::vector<std::string>& statements) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](std::filesystem::path file) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
  };
  for (const std::string& statement : statements) {
    if (const auto whole = findMaterialFile(obj, statement)) {
      add(*whole);
      continue;
    }
    std::string_view rest = std::string_view(statement).substr(0, statement.find('#'));
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest))
      add(findMaterialFile(obj, word).value_or(obj.parent_path() / withSlashes(word)));
  }
  return files;
}

void describeMaterials(SourceScene& scene, const std::filesystem::path& obj, const std::vector<std::string>& files,
                       bool strict) {
  // Read the descriptions by name.
  std::map<std::string, SourceMaterial> described;
  std::vector<std::string> missing;
  for (const std::string& statement : files)
    if (statement.find('\\') != std::string::npos)
      addNote(scene.notes, fmt::format("{}backslashes in the file name {}", kAcceptedNote, prep::quoted(statement)));
  for (const std::filesystem::path& path : listMaterialFiles(obj, files)) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
      missing.push_back(path.filename().string());
      continue;
    }
    std::vector<SourceMaterial> materials;
    try {
      materials = readMtl(path, scene.notes, scene.images, strict);
    } catch (const Error& error) {
      if (strict) throw;
      addNote(scene.notes, fmt::format("a material file: {}", error.what()));
    }
    for (SourceMaterial& material : materials) {
      const std::string name = material.name;
      if (!described.emplace(name, std::move(material)).second)
        addNote(scene.notes, fmt::format("a duplicate material {}", prep::quoted(name)));
    }
  }

  // Set the materials; if a name has no description, try it without a comment. Report missing files only if a material
  // is missing.
  std::map<std::string, const SourceMaterial*> withoutComments;
  for (const auto& [name, material] : described) withoutComments.emplace(withoutHash(name), &material);
  for (SourceMaterial& material : scene.materials) {
    const auto found = described.find(material.name);
    const auto similar = withoutComments.find(withoutHash(material.name));
    if (found == described.end() && similar != withoutComments.end() && !similar->first.empty()) {
      addNote(scene.notes, fmt::format("{}material {} described as {}", kAcceptedNote, prep::quoted(material.name),
                                       prep::quoted(similar->second->name)));
      const std::string name = material.name;
      material = *similar->second;
      material.name = name;
      continue;
    }
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
  if (text.find("mtllib") == std::string::npos) return {};  // in a tenth of the time of a scan
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<std::string> statements;
  std::set<std::string> seen;
  Lines lines(text, where);
  removePadding(text);
  while (lines.nextStatement('#')) {
    // Statements as in scan_obj.cpp.
    std::string_view rest = lines.line();
    if (takeWord(rest) != "mtllib") {
      lines.joinContinued('#');
      continue;
    }
    lines.cutSeparateComment('#');
    lines.joinContinued();
    lines.cutSeparateComment('#');
    rest = lines.line();
    takeWord(rest);
    std::string name = parseName(rest, lines, kMaxPathBytes);
    if (!name.empty() && seen.insert(name).second) statements.push_back(std::move(name));
  }
  return statements;
}

}  // namespace malus::prep

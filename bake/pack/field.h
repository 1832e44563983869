// One row of the description of a record: a field of a section of the pack, a key of scene.json, or both.
//
// A record is described by one function template that calls a visitor once per field:
//
//   template <class Visitor, class... Records>
//   void visitCamera(Visitor&& visit, Records&... camera) {
//     visit(Field{.name = "verticalFovDegrees", .low = 1e-3, .high = 179, .unit = "degrees", .text = "..."},
//           camera.verticalFovDegrees...);
//   }
//
// Reader, writer, sizes, range checks, JSON and the tables of bake/FORMAT.md and bake/SCENE.md are visitors of it, so
// that a new field is one row. The order of the rows is the order of the bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "bake/pack/material_kinds.h"

namespace malus::pack {

// A set of kinds of material, one bit per kind.
using KindSet = std::uint32_t;
inline constexpr KindSet kEveryKind = (KindSet{1} << kMaterialKindCount) - 1;

constexpr KindSet only(MaterialKind kind) { return KindSet{1} << static_cast<std::uint32_t>(kind); }
constexpr bool contains(KindSet set, MaterialKind kind) { return (set & only(kind)) != 0; }
// All kinds for which the predicate of material_kinds.h is true.
consteval KindSet kindsWhere(bool (*predicate)(MaterialKind)) {
  KindSet set = 0;
  for (const MaterialKindInfo& info : kMaterialKinds) set |= predicate(info.kind) ? only(info.kind) : 0;
  return set;
}

// JSON that a vector of scene.json accepts: three numbers, one number or three, or a direction of any length.
enum class Shape { vector, numberOrVector, direction };

// A field is read from scene.json or not; a required key has no default.
enum class Key { none, required, optional };

struct Field {
  std::string_view name;          // in JSON and errors; "coating.eta" is the key "eta" of the object "coating"
  double low = 0, high = 0;       // bounds of a number, or of each component of a vector; inclusive
  std::string_view unit = {};     //
  std::string_view text = {};     // one line for the page
  const char* section = nullptr;  // of a material, which two sections describe
  std::uint32_t since = 1;        // version of the section that appended the field to its records
  bool isTexture = false;         // index of a texture, stored as 1 + index; 0: none
  bool isFeature = false;         // of a material: a value other than the default needs the section
  KindSet kinds = kEveryKind;     // kinds of material that have the field
  bool isZeroForOthers = false;   // materials of other kinds must have 0

  Key key = Key::none;                  // scene.json
  Shape shape = Shape::vector;          //
  std::string_view alias = {};          // deprecated name of the key
  std::optional<double> fallback = {};  // default of the key, if it is not that of the record
  double keyLow = 0, keyHigh = 0;       // bounds of the key if narrower than those of the pack; equal: the same
  bool excludesLow = false;             // of a key: its lower bound itself is out of range

  constexpr double lowInScene() const { return keyLow == keyHigh ? low : keyLow; }
  constexpr double highInScene() const { return keyLow == keyHigh ? high : keyHigh; }
};

// A visitor that finds the newest version of a section from the fields of its record.
struct NewestVersion {
  std::uint32_t version = 1;
  template <class T>
  void operator()(const Field& field, const T&) {
    if (field.since > version) version = field.since;
  }
};

}  // namespace malus::pack
